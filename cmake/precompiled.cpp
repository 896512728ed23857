// A precompiled header needs a target to belong to: palpate_programs, for what is not position-independent.

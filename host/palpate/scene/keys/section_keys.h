// The tables that a scene file may hold, one function each; everything there is to say about a key is said there.
#pragma once

#include "palpate/scene/keys/key_section.h"

namespace palpate::scene {

// What is touched: body_keys.cpp.
Section bodySection();
Section breathingSection();
Section stiffnessSection();
Section dysfunctionSection();
Section ellipsesSection();

// How it is felt: touch_keys.cpp.
Section frictionSection();
Section contactSection();
Section partitionSection();
Section tissueSection();
Section safetySection();

// How it gives way: deformation_keys.cpp.
Section deformationSection();
Section profileSection();
Section strainSection();

// How pictures look: view_keys.cpp.
Section viewSection();

// Who touches it: finger_keys.cpp.
Section fingerSection();
Section deviceSection();

/// `fidelity = "literal"`, or `fidelity.E14 = "literal"` for single errata; fidelity.all comes before the single ones.
/// fidelity_key.cpp.
Key<Scene> fidelityKey();

}  // namespace palpate::scene

#pragma once
// Bars on absolute time. A machine that also compiles, or has another processor, misses them without a fault of the
// code, so they are judged only where the machine was left alone for it: PALPATE_TIMED=1 (tools/check-speed sets it).
#include <cstdlib>

namespace palpate::support {

inline bool timesAreJudged() { return std::getenv("PALPATE_TIMED") != nullptr; }

}  // namespace palpate::support

// How large a hidden dysfunction is, and in which words: a *change* d in (0, 1], declared as one of stiffness or of
// compliance, and the factor k'/k that it means. Nothing is shown or stored as a change without its meaning.
//
// Based on: Howell et al., BMC Medical Education 8:14, 2008 (levels 50, 40, 28, 20, 14, 10, 7 % of compliance).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "palpate/base/words.h"

namespace palpate::training {

enum class ChangeMeaning : std::uint8_t {
  compliance,  ///< the place is less compliant by d: k'/k = 1 / (1 - d), d < 1
  stiffness,   ///< the place is stiffer by d: k'/k = 1 + d
  cue,         ///< a lump's C, how plainly it is felt (lumps/lump_observer.h); no hidden place has it
};

/// The factor on the stiffness at the centre of the place; d in (0, kMaxChange of the meaning].
double stiffnessRatio(double change, ChangeMeaning meaning);
/// The other way round.
double changeFromRatio(double stiffness_ratio, ChangeMeaning meaning);

/// The levels of the Virtual Haptic Back, falling.
inline constexpr std::array<double, 7> kVhbLevels = {0.50, 0.40, 0.28, 0.20, 0.14, 0.10, 0.07};

/// A place without any compliance cannot be rendered: 0.8 is five times as stiff, 1.5 N/mm on a base of 0.3, what
/// desktop devices render well.
inline constexpr double kMaxComplianceChange = 0.8;

/// Levels of an adaptive test, rising, some 10 % apart: 33 from 4 % to 100 %; of compliance to 80 %.
std::vector<double> adaptiveLevels(ChangeMeaning meaning);

}  // namespace palpate::training

template <>
struct palpate::WordsOf<palpate::training::ChangeMeaning> {
  using V = palpate::training::ChangeMeaning;
  static constexpr std::array kAll = {Word{"compliance", V::compliance}, Word{"stiffness", V::stiffness},
                                      Word{"cue", V::cue}};
};

// Natural variation of the stiffness map: no two places of a body are quite as stiff as each other.
//
// Real tissue's force scatters by 11 to 60 % between places 3 to 25 mm apart, where layers and bones explain none of
// it. Here it is a smooth random field over space, a factor on the map: a log-normal one, so that it is never zero, of
// mean 1. It is a function of the place and of a seed, so two meshes of one body have the same field, and so have two
// machines to rounding. Off by default: a map of bones and dysfunctions only is the better lesson.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::maps {

inline constexpr double kMaxVariation = 0.5;

struct NaturalVariation {
  double variation = 0.0;  ///< standard deviation over mean, 0 to kMaxVariation; 0: none
  /// Two places this far apart share 37 % of what they deviate by (the correlation is exp(-(r / length)^2)). 12 mm: the
  /// middle of the 3 to 25 mm over which the scatter was seen.
  double length_mm = 12.0;
  std::uint32_t seed = 1;
  friend bool operator==(const NaturalVariation&, const NaturalVariation&) = default;
};

/// The factors at places of the body, each > 0; ones without variation.
std::vector<double> variationAt(std::span<const Vec3> places_mm, const NaturalVariation& variation);

/// Multiplies them into a stiffness per place; changes no bit without variation.
void applyVariation(std::span<const Vec3> positions, const NaturalVariation& variation,
                    std::span<double> stiffness_n_per_mm);

}  // namespace palpate::maps

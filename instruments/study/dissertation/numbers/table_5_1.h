// The example of Table 5.1: three equal circles on the y axis over a smaller basic circle (Figures 5.8 to 5.10).
#pragma once

#include <array>
#include <vector>

#include "palpate/maps/key_points.h"

namespace palpate::study {

inline constexpr double kTable51HalfMajor = 120.0;  ///< mm
inline constexpr double kTable51Basic = 90.0;       ///< mm
inline constexpr double kTable51Diameter = 400.0;   ///< mm; the text calls it a radius (E28)
inline constexpr double kTable51Square = 500.0;     ///< mm, side of the area
inline constexpr double kTable51Half = 0.5 * kTable51Square;
inline constexpr std::array<double, 3> kTable51Y{150.0, 60.0, -30.0};  ///< mm

std::vector<maps::KeyPoint> table51Keys();

/// (5.7) at a place: misses the keys.
double naiveHalfMajor(const Vec2& place, double effect_radius_mm);
/// (5.16), by the engine's Gaussian radial interpolation: exact at the keys.
double exactHalfMajor(const Vec2& place, double effect_radius_mm);

}  // namespace palpate::study

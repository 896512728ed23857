// The numbers of the built-in skin: spline coefficients and the outline of the trimmed back.
//
// Data only, written by tools/fit_skin.py (provenance in skin_numbers.txt); read by skin_surface and skin_outline.
// A man of kTableStatureMm; the surface is a radius r(angle, y) about the axis x = 0, z = kSkinAxisZ, angle = atan2(x,
// z - axis).
#pragma once

#include <span>

namespace palpate::body {

inline constexpr double kSkinAxisZ = -60.0;       // mm; the patch is cut at z = 0, so it spans up to atan(175 / 60)
inline constexpr double kSkinHalfAngle = 1.2405;  // rad, the spline covers [-half, half]
inline constexpr double kSkinLow = -292.0;        // mm, below the spine of L5
inline constexpr double kSkinHigh = 200.0;        // mm, at the neck
inline constexpr double kPatchLow = -200.0;       // mm, lower edge of the patch (the torso goes down to kSkinLow)

inline constexpr int kSkinAcross = 20;
inline constexpr int kSkinAcrossStored = 10;  // the other half is its mirror image
inline constexpr int kSkinAlong = 24;

/// Coefficients in mm of a row from kSkinLow up; row 0 is the border at -half angle (and, mirrored, at +half angle).
std::span<const float> skinRadii(int row);

/// A point of the outline: the border of the trimmed skin on the right side, the left mirrors it.
struct OutlinePoint {
  double angle_deg;
  double y_mm;
};
/// From kSkinLow up to the armpit, where the skin is cut at z = 0.
std::span<const OutlinePoint> outlineFlank();
/// From the armpit up to the tip of the shoulder, where the arm is cut at x = 175.
std::span<const OutlinePoint> outlineArm();
/// From the tip of the shoulder along its crest to the neck at kSkinHigh.
std::span<const OutlinePoint> outlineRidge();

}  // namespace palpate::body

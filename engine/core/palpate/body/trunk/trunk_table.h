// The fitted coefficients of the trunk's skin, as tools/fit_trunk.py writes them (trunk_numbers.txt): their layout;
// trunk_field.h has their meaning.
#pragma once

namespace palpate::body {

/// Coefficients (x, y, z) of a cubic B-spline over a lattice, mirrored at x = 0; z runs fastest, then y. Millimetre of
/// a man of 1750 mm, body frame.
inline constexpr int kTrunkTableX = 21;
inline constexpr int kTrunkTableY = 53;
inline constexpr int kTrunkTableZ = 22;
inline constexpr double kTrunkTableStepMm = 18.0;
/// Place of coefficient (0, 1, 1): the outermost ones are a step outside, as a cubic needs them.
inline constexpr double kTrunkTableLowY = -580.0;
inline constexpr double kTrunkTableLowZ = -150.0;

/// A coefficient is two digits of base 87, the higher first, in units of kTrunkTableUnitMm from the middle of their
/// range; the digits are the characters from '#' to '}' but the signs, the question mark and the backslash. Far from
/// the skin a single sign replaces a coefficient: '+' outside the body, '-' inside.
inline constexpr int kTrunkTableBase = 87;
inline constexpr double kTrunkTableUnitMm = 0.025;

}  // namespace palpate::body

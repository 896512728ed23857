// The border of the skin of the back: the flank at z = 0, the cut of the arm at x = 175, the crest of the shoulder, the
// neck.
//
// In the flat plane of the mesher: p = kFlatRadius x angle, q = y, both mm of a man of 1750 mm.
#pragma once

#include "palpate/body/outline_mesher.h"
#include "palpate/body/skin_surface.h"

namespace palpate::body {

/// Unrolls the angle; about the mean radius of the back, so that lengths in the plane are close to those on the skin.
inline constexpr double kFlatRadius = 170.0;  // mm

enum class SkinExtent {
  patch,  ///< down to y = -200: 350 x 400 x 120 mm
  torso,  ///< down to y = -292: covers L5
};

FlatOutline skinOutline(SkinExtent extent);

/// The angle (rad) of the right border at a height of the table's man.
double borderAngle(double y);

inline SkinAngle placeOfFlat(const Vec2& flat) { return {flat.x() / kFlatRadius, flat.y()}; }

}  // namespace palpate::body

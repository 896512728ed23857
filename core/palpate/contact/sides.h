// Inside and outside of the body as a whole: asked before a finger is let go that its proxy still holds, and before one
// is held that may be inside already.
#pragma once

#include "palpate/contact/finger_state.h"
#include "palpate/contact/surface.h"

namespace palpate::contact {

/// Whether a tip whose proxy is `lag` mm away, too deep to be felt, is out of the body. A closed surface tells by its
/// winding number, of parts that overlap too. Of a body with holes, or a sheet, that tells less: there the tip has to
/// be in front of the nearest place besides, and that must not be the border. About 1 us (tree/triangle_tree.h).
bool isOutside(const Surface& surface, const Vec3& tip, double lag) noexcept;

/// Whether a tip that is held at `place` is in free air with nothing between: it is out of the body, and the straight
/// way to the place meets no skin. False within rounding of the place.
bool isInAir(const Surface& surface, const Vec3& place, const Vec3& tip) noexcept;

/// Whether that has to be asked of a proxy on the skin: only where the body touches itself. At the edge of two boxes
/// that share it the skin bounds two empty sectors, and the proxy may be in the one while the tip came out into the
/// other. Everywhere else the side of the place's normal is exact and says the same.
inline bool boundsTwoSectors(const Surface& surface, const SurfacePoint& place) noexcept {
  return surface.geometry->touches_itself && place.feature != tree::Feature::face;
}

/// Whether a tip that is about to be let go is inside a closed body. False for an open sheet.
bool isInside(const Surface& surface, const Vec3& tip) noexcept;

/// Whether a place in front of one sheet is inside a body: sheets that pierce each other are buried in part, and a tip
/// that starts a session inside must not be held by them. False for all other surfaces, and on the surface itself
/// mostly; who has been outside knows better and does not ask.
bool isBuried(const Surface& surface, const Vec3& place) noexcept;

}  // namespace palpate::contact

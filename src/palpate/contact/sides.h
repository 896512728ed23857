// Inside and outside of the body as a whole: asked before a finger is let go that its proxy still holds, and before one
// is held that may be inside already.
#pragma once

#include "palpate/contact/surface.h"

namespace palpate::contact {

/// Whether a tip whose proxy is `lag` mm away, too deep to be felt, is out of the body. A closed surface tells by its
/// winding number, of parts that overlap too. Of a body with holes, or a sheet, that tells less: there the tip has to
/// be in front of the nearest place besides, and that must not be the border. About 1 us (tree/winding_number.h).
bool isOutside(const Surface& surface, const Vec3& tip, double lag) noexcept;

/// Whether a tip that is about to be let go is inside a closed body. False for an open sheet.
bool isInside(const Surface& surface, const Vec3& tip) noexcept;

/// Whether a place in front of one sheet is inside a body: sheets that pierce each other are buried in part, and a tip
/// that starts a session inside must not be held by them. False for all other surfaces, and on the surface itself
/// mostly; who has been outside knows better and does not ask.
bool isBuried(const Surface& surface, const Vec3& place) noexcept;

}  // namespace palpate::contact

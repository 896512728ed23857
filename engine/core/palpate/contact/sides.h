// Inside and outside of the body as a whole: queried before a finger is released that its proxy still holds, and before
// one is held that may be inside already.
#pragma once

#include "palpate/contact/finger_state.h"
#include "palpate/contact/surface.h"

namespace palpate::contact {

/// Whether a tip is out of the body, whose finger stands on skin nearer than `reach` to it. A closed surface decides by
/// its winding number, of parts that overlap too. Of a body with holes, or a sheet, that decides less: there the tip
/// has to be in front of the nearest place besides, and that must not be the border. Where that place is next to sheets
/// that pierce each other, it may be the back of a fold: then the winding number alone, where every border is farther
/// than `reach`. About 1 us (tree/triangle_tree.h), at a fold some more.
bool isOutside(const Surface& surface, const Vec3& tip, double reach) noexcept;

/// Whether a tip that is held at `place` is in free air with nothing between: it is out of the body, and the straight
/// way to the place meets no skin. False within rounding of the place. `reach`: as isOutside has it. `beside`:
/// where the way probably meets the skin, which saves time and changes nothing.
bool isInAir(const Surface& surface, const Vec3& place, const Vec3& tip, double reach,
             const SurfacePoint& beside) noexcept;

/// Whether that has to be asked of a proxy on the skin: only where the body touches itself. At the edge of two boxes
/// that share it the skin bounds two empty sectors, and the proxy may be in the one while the tip came out into the
/// other. Everywhere else the side of the place's normal is exact and says the same.
inline bool boundsTwoSectors(const Surface& surface, const SurfacePoint& place) noexcept {
  return surface.geometry->touches_itself && place.feature != tree::Feature::face;
}

/// Whether a tip that is about to be released is inside the body and must not be: of an open one only where the finger
/// came from outside and every border is farther than `reach` from the tip, or from `held`, where the finger was when
/// the tick began, so that it cannot have come in by an opening.
bool isInside(const Surface& surface, const FingerState& state, const Vec3& held, const Vec3& tip,
              double reach) noexcept;

/// Whether a place in front of one sheet is inside a body: sheets that pierce each other are buried in part, and a tip
/// that starts a session inside must not be held by them. False for all other surfaces, open ones among them, and on
/// the surface itself mostly; who has been outside knows better and does not ask.
bool isBuried(const Surface& surface, const Vec3& place) noexcept;

/// Whether a tip is inside an open body, or in the plane of its opening. False for closed ones: they have no way in.
bool isPastAnOpening(const Surface& surface, const Vec3& tip) noexcept;

/// Before a free finger lands on an open body: whether it is inside, where it came in by an opening or began. Then it
/// may be free inside after the contact as well. A closed body has no way in.
void noteWhereItComesFrom(const Surface& surface, FingerState& state) noexcept;

/// In every tick of a finger that is held: once its tip is out, one that came from inside has come out. Sheets that
/// pierce each other may hold it all the way, and it must not be released inside when it comes back.
void noteThatItCameOut(const Surface& surface, const Vec3& tip, FingerState& state) noexcept;

}  // namespace palpate::contact

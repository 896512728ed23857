// Where a sphere stands on the skin: the local minima of the distance from its centre, its feet.
//
// A sheet is felt from its front only, so a place seen from behind is no foot. At a border the sheet counts as going on
// flat: a sphere there keeps its height instead of rolling round the edge and under the sheet (the force fades,
// border.h).
#pragma once

#include <array>

#include "palpate/contact/finger.h"
#include "palpate/contact/half_spaces.h"

namespace palpate::contact {

struct Foot {
  SurfacePoint at;
  Vec3 normal = Vec3::Zero();  ///< unit: from the foot to the centre; at a border the sheet's
  double height = 0.0;         ///< of the centre above the foot along `normal`, mm: where it fits, at least the radius
};

/// The lowest feet; when there are more than kMost, the highest are left out. A copy copies those that are there: a
/// few, where the array is 2.5 kB.
struct Feet {
  static constexpr int kMost = 32;
  std::array<Foot, kMost> feet;
  int count = 0;

  Feet() = default;
  Feet(const Feet& other) { *this = other; }
  Feet& operator=(const Feet& other);

  /// Index of the one with the smallest height; only if count > 0.
  int lowest() const;
};

/// What a place of the skin is to a sphere. False when the centre is behind it; a centre on the skin, to rounding,
/// counts as in front, as it does in the crossing test.
bool standsOn(const Surface& surface, const SurfacePoint& place, const Vec3& centre, Foot& foot) noexcept;

/// Fills `feet` with those nearer to the centre than `reach`.
void findFeet(const Surface& surface, const Vec3& centre, double reach, Feet& feet) noexcept;

/// Moves a foot on the skin to the local minimum for a centre nearby. False when the centre is behind the skin there.
bool followFoot(const Surface& surface, const Vec3& centre, Foot& foot) noexcept;

/// Whether the sphere sinks into the skin: any foot lower than `height`. Stops at the first.
bool anyFootLower(const Surface& surface, const Vec3& centre, double height) noexcept;

/// The nearest place of the skin with the centre in front, nearer than `reach`; triangle kNoIndex when there is none.
SurfacePoint nearestFront(const Surface& surface, const Vec3& centre, double reach) noexcept;

/// The half-space that keeps the centre of a sphere of this radius off the foot.
HalfSpace keepOff(const Foot& foot, double radius) noexcept;

}  // namespace palpate::contact

// Where a sphere stands on the skin: the local minima of the distance from its centre, its feet.
#pragma once

#include <array>

#include "palpate/contact/finger.h"
#include "palpate/contact/half_spaces.h"

namespace palpate::contact {

struct Foot {
  SurfacePoint at;
  Vec3 normal = Vec3::Zero();  ///< unit, from the foot to the centre
  double distance = 0.0;       ///< from the centre, mm
};

/// The nearest feet; when there are more than kMost, the farthest are left out.
struct Feet {
  static constexpr int kMost = 32;
  std::array<Foot, kMost> feet;
  int count = 0;

  /// The nearest one; only if count > 0.
  const Foot& nearest() const;
  /// Distance of the nearest, infinite without feet.
  double nearestDistance() const;
};

/// Fills `feet` with those nearer than `reach` on whose front side the centre is. A place of the skin seen from behind
/// is no foot: a sheet is felt from its front only.
void findFeet(const Surface& surface, const Vec3& centre, double reach, Feet& feet) noexcept;

/// Whether any front side is nearer to the centre than `distance`. Stops at the first.
bool anyFrontNearer(const Surface& surface, const Vec3& centre, double distance) noexcept;

/// The nearest front side nearer than `reach`; triangle kNoIndex when there is none.
partition::NearestPoint nearestFront(const Surface& surface, const Vec3& centre, double reach) noexcept;

/// The half-space that keeps the centre of a sphere of this radius off the foot.
HalfSpace keepOff(const Foot& foot, double radius) noexcept;

}  // namespace palpate::contact

// Where a sphere stands on the skin: the local minima of the distance from its centre, its feet.
//
// A sheet is felt from its front only, so a place seen from behind cannot be a foot. At a border the sheet counts as
// going on flat: a sphere there keeps its height instead of rolling round the edge and under the sheet (the force
// fades, border.h).
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "palpate/contact/finger_state.h"
#include "palpate/contact/half_spaces.h"
#include "palpate/contact/nearby_skin.h"
#include "palpate/contact/surface.h"

namespace palpate::contact {

struct Foot {
  SurfacePoint at;
  Vec3 normal = Vec3::Zero();  ///< unit: from the foot to the centre; at a border the sheet's
  double height = 0.0;         ///< of the centre above the foot along `normal`, mm: where it fits, at least the radius
};

/// The lowest feet; when there are more than kMax, the highest are left out. Making and copying one touches those that
/// are there: a few, where the array is 2.5 kB.
struct Feet {
  static constexpr int kMax = 32;
  union {
    std::array<Foot, kMax> feet;  ///< only the first `count` are there
  };
  int count = 0;

  Feet() {}
  Feet(const Feet& other) { *this = other; }
  Feet& operator=(const Feet& other);

  /// One more, to be filled in; only if count < kMax.
  Foot& add() { return *std::construct_at(&feet[static_cast<std::size_t>(count++)]); }

  /// Index of the one with the smallest height; only if count > 0.
  int lowest() const;
};

/// Fills `foot` for a sphere over a place of the skin. False when the centre is behind it; a centre on the skin, to
/// rounding, counts as in front, as it does in the crossing test.
bool standsOn(const Surface& surface, const SurfacePoint& place, const Vec3& centre, Foot& foot) noexcept;

/// Fills `feet` with those nearer to the centre than `reach`. `nearby`, here and below: what is near, gathered before,
/// or null; it saves time and changes nothing.
void findFeet(const Surface& surface, const Vec3& centre, double reach, Feet& feet,
              const NearbySkin* nearby = nullptr) noexcept;

/// Moves a foot on the skin to the local minimum for a centre nearby. False when the centre is behind the skin there.
bool followFoot(const Surface& surface, const Vec3& centre, Foot& foot) noexcept;

/// Whether the sphere sinks into the skin: any foot lower than `height`. Stops at the first.
bool hasLowerFoot(const Surface& surface, const Vec3& centre, double height,
                  const NearbySkin* nearby = nullptr) noexcept;

/// The same, asked of the listed triangles alone.
bool hasLowerFootAmong(const Surface& surface, const SkinList& list, const Vec3& centre, double height) noexcept;

/// The nearest place of the skin with the centre in front, nearer than `reach`; triangle kNoIndex when there is none.
SurfacePoint nearestFront(const Surface& surface, const Vec3& centre, double reach) noexcept;

/// The half-space that keeps the centre of a sphere of this radius off the foot.
HalfSpace offsetHalfSpace(const Foot& foot, double radius) noexcept;

}  // namespace palpate::contact

// What of the skin lies under the cursor: always on the surface at rest, because a finger picked on its own dent would
// slide into the hole it makes.
#pragma once

#include <optional>

#include "palpate/contact/surface.h"
#include "palpate/view/camera.h"

namespace palpate::view {

struct SkinPlace {
  Vec3 point = Vec3::Zero();    ///< on the skin at rest, mm
  Vec3 normal = Vec3::UnitZ();  ///< unit, smoothed over a fingertip
  Index triangle = kNoIndex;    ///< record of the surface's tree
};

/// The normal is the mean of the skin within this of the point, mm: about a fingertip, so that a single facet or bump
/// does not tilt the finger.
inline constexpr double kNormalRadiusMm = 8.0;

/// Where the ray first meets the front of the skin. Any thread; allocates nothing.
std::optional<SkinPlace> skinAlong(const contact::Surface& surface, const Ray& ray) noexcept;

/// The place of the skin nearest to a point, if there is any within `reach_mm`.
std::optional<SkinPlace> skinNear(const contact::Surface& surface, const Vec3& point, double reach_mm) noexcept;

/// Unit; the area-weighted mean of the triangles near the point that face the same way as `triangle`.
Vec3 smoothedNormal(const contact::Surface& surface, const Vec3& point, Index triangle, double radius_mm) noexcept;

}  // namespace palpate::view

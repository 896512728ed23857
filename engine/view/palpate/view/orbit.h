// Turning, shifting and zooming a camera so that the grabbed place stays under the cursor. Pure.
#pragma once

#include <optional>

#include "palpate/base/skin_place.h"
#include "palpate/contact/surface.h"
#include "palpate/view/camera.h"

namespace palpate::view {

/// A drag over the whole height of the picture turns by this much.
inline constexpr double kTurnPerHeightRad = 3.14159265358979;
/// The camera stays this far from straight up and down, where left and right would be undefined.
inline constexpr double kSteepestRad = 1.55;
inline constexpr double kZoomPerNotch = 0.9;  ///< factor on the distance
inline constexpr double kNearestMm = 30.0;
inline constexpr double kFarthestMm = 1e6;

/// Turned by a drag of `by` pixels in a picture `height` pixels high; `pivot` keeps its place on the screen.
Camera orbited(const Camera& camera, const Vec3& pivot, const Vec2& by, double height);

/// Shifted so that a point at the depth of `pivot` follows the cursor.
Camera panned(const Camera& camera, const Vec3& pivot, const Vec2& by, double height);

/// Nearer (notches > 0) to `pivot`, which keeps its place on the screen.
Camera zoomed(const Camera& camera, const Vec3& pivot, double notches);

/// Turns about `place` from now on, and looks straight at it.
Camera centredOn(const Camera& camera, const Vec3& place);

/// Between two cameras, share in [0, 1]: for flights.
Camera between(const Camera& from, const Camera& to, double share);

/// The normal is the mean of the skin within this of the point, mm: about a fingertip, so that a single facet or bump
/// does not tilt the finger.
inline constexpr double kNormalRadiusMm = 8.0;

/// Picks the skin under the cursor: always on the surface at rest, because a finger picked on its own dent would slide
/// into the hole it makes. The first hit of the ray on the front of the skin. Any thread; allocates nothing.
std::optional<SkinPlace> skinAlong(const contact::Surface& surface, const Ray& ray) noexcept;

/// The place of the skin nearest to a point, if there is any within `reach_mm`.
std::optional<SkinPlace> skinNear(const contact::Surface& surface, const Vec3& point, double reach_mm) noexcept;

/// Unit; the area-weighted mean of the triangles near the point that face the same way as `triangle`.
Vec3 smoothedNormal(const contact::Surface& surface, const Vec3& point, Index triangle, double radius_mm) noexcept;

}  // namespace palpate::view

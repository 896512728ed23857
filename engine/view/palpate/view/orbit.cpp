// A drag becomes a camera, a pixel's ray a place of the skin. Turning and zooming move the centre as rigidly as the eye
// about the pivot, so the grabbed place stays under the cursor; flights are smooth in the logarithm of the distance.
// Picking uses the tree of the skin at rest.
#include "palpate/view/orbit.h"

#include <algorithm>
#include <cmath>

namespace palpate::view {

Camera orbited(const Camera& camera, const Vec3& pivot, const Vec2& by, double height) {
  Camera turned = camera;
  const double radians = kTurnPerHeightRad / std::max(1.0, height);
  const Vec2 level = Eigen::Rotation2Dd(-camera.roll_rad) * by;  // as a camera that is not rolled would see it
  turned.yaw_rad = std::remainder(camera.yaw_rad - radians * level.x(), 2.0 * kTurnPerHeightRad);
  turned.pitch_rad = std::clamp(camera.pitch_rad + radians * level.y(), -kSteepestRad, kSteepestRad);
  turned.centre = pivot + turned.axes() * (camera.axes().transpose() * (camera.centre - pivot));
  return turned;
}

Camera panned(const Camera& camera, const Vec3& pivot, const Vec2& by, double height) {
  const double depth = std::max(kNearestMm, (camera.eye() - pivot).dot(camera.backward()));
  const double mm_per_pixel = 2.0 * depth * std::tan(0.5 * camera.height_rad) / std::max(1.0, height);
  Camera shifted = camera;
  shifted.centre += mm_per_pixel * (by.y() * camera.up() - by.x() * camera.right());
  return shifted;
}

Camera zoomed(const Camera& camera, const Vec3& pivot, double notches) {
  Camera nearer = camera;
  nearer.distance_mm = std::clamp(camera.distance_mm * std::pow(kZoomPerNotch, notches), kNearestMm, kFarthestMm);
  const double factor = nearer.distance_mm / camera.distance_mm;
  nearer.centre = pivot + factor * (camera.centre - pivot);
  return nearer;
}

Camera centredOn(const Camera& camera, const Vec3& place) {
  Camera centred = camera;
  centred.distance_mm = std::clamp((camera.eye() - place).dot(camera.backward()), kNearestMm, kFarthestMm);
  centred.centre = place;
  return centred;
}

Camera between(const Camera& from, const Camera& to, double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const double eased = s * s * (3.0 - 2.0 * s);
  const auto mix = [&](double a, double b) { return a + eased * (b - a); };
  Camera camera = to;
  camera.centre = from.centre + eased * (to.centre - from.centre);
  camera.yaw_rad = from.yaw_rad + eased * std::remainder(to.yaw_rad - from.yaw_rad, 2.0 * kTurnPerHeightRad);
  camera.pitch_rad = mix(from.pitch_rad, to.pitch_rad);
  camera.roll_rad = mix(from.roll_rad, to.roll_rad);
  camera.height_rad = mix(from.height_rad, to.height_rad);
  camera.distance_mm = std::exp(mix(std::log(from.distance_mm), std::log(to.distance_mm)));
  return camera;
}

namespace {

/// Twice the area times the unit normal.
Vec3 areaNormal(const tree::TriangleRecord& record) noexcept {
  return (record.corners[1] - record.corners[0]).cross(record.corners[2] - record.corners[0]);
}

SkinPlace placeAt(const contact::Surface& surface, const Vec3& point, Index triangle) noexcept {
  return {point, smoothedNormal(surface, point, triangle, kNormalRadiusMm), triangle};
}

}  // namespace

Vec3 smoothedNormal(const contact::Surface& surface, const Vec3& point, Index triangle, double radius_mm) noexcept {
  const Vec3 own = areaNormal(surface.geometry->tree.records[triangle]);
  const double limit = radius_mm * radius_mm;
  Vec3 sum = own;
  tree::visitNearTriangles(surface.geometry->tree, point, limit, [&](Index t, const tree::ClosestOnTriangle& closest) {
    const Vec3 normal = areaNormal(surface.geometry->tree.records[t]);
    // Near triangles count more, and fade out at the radius: the normal changes without jumps as the point moves.
    if (normal.dot(own) > 0.0) sum += (1.0 - closest.squared_distance / limit) * normal;
    return limit;
  });
  const double length = sum.norm();
  return length > 0.0 ? Vec3(sum / length) : Vec3::UnitZ();
}

std::optional<SkinPlace> skinAlong(const contact::Surface& surface, const Ray& ray) noexcept {
  const double reach = (ray.origin - surface.geometry->tree.center).norm() + surface.geometry->tree.diagonal;
  const tree::Crossing hit =
      tree::firstFrontCrossing(surface.geometry->tree, ray.origin, ray.origin + reach * ray.direction);
  if (hit.triangle == kNoIndex) return std::nullopt;
  return placeAt(surface, hit.point, hit.triangle);
}

std::optional<SkinPlace> skinNear(const contact::Surface& surface, const Vec3& point, double reach_mm) noexcept {
  const tree::NearestPoint nearest = tree::nearestPoint(surface.geometry->tree, point, reach_mm);
  if (nearest.triangle == kNoIndex) return std::nullopt;
  return placeAt(surface, nearest.closest.point, nearest.triangle);
}

}  // namespace palpate::view

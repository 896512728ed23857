#include "palpate/view/picking.h"

namespace palpate::view {

namespace {

/// Twice the area times the unit normal.
Vec3 areaNormal(const partition::TriangleRecord& record) noexcept {
  return (record.corners[1] - record.corners[0]).cross(record.corners[2] - record.corners[0]);
}

SkinPlace placeAt(const contact::Surface& surface, const Vec3& point, Index triangle) noexcept {
  return {point, smoothedNormal(surface, point, triangle, kNormalRadiusMm), triangle};
}

}  // namespace

Vec3 smoothedNormal(const contact::Surface& surface, const Vec3& point, Index triangle, double radius_mm) noexcept {
  const Vec3 own = areaNormal(surface.tree.records[triangle]);
  const double limit = radius_mm * radius_mm;
  Vec3 sum = own;
  partition::visitNearTriangles(surface.tree, point, limit, [&](Index t, const partition::ClosestOnTriangle& closest) {
    const Vec3 normal = areaNormal(surface.tree.records[t]);
    // Near triangles count more, and fade out at the radius: the normal changes without jumps as the point moves.
    if (normal.dot(own) > 0.0) sum += (1.0 - closest.squared_distance / limit) * normal;
    return limit;
  });
  const double length = sum.norm();
  return length > 0.0 ? Vec3(sum / length) : Vec3::UnitZ();
}

std::optional<SkinPlace> skinAlong(const contact::Surface& surface, const Ray& ray) noexcept {
  const double reach = (ray.origin - surface.tree.center).norm() + surface.tree.diagonal;
  const partition::Crossing hit =
      partition::firstFrontCrossing(surface.tree, ray.origin, ray.origin + reach * ray.direction);
  if (hit.triangle == kNoIndex) return std::nullopt;
  return placeAt(surface, hit.point, hit.triangle);
}

std::optional<SkinPlace> skinNear(const contact::Surface& surface, const Vec3& point, double reach_mm) noexcept {
  const partition::NearestPoint nearest = partition::nearestPoint(surface.tree, point, reach_mm);
  if (nearest.triangle == kNoIndex) return std::nullopt;
  return placeAt(surface, nearest.closest.point, nearest.triangle);
}

}  // namespace palpate::view

// Words -> a point over or under the skin (body/places.h) -> the skin above or below it, on the side of the body that
// the landmark is on. Cold.
#include "palpate/engine/skin_place.h"

#include "palpate/body/places.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::engine {

namespace {

SkinPlace placeIn(const scene::World& world, Index record, const Vec3& point) {
  const auto& corners = world.surface.geometry->tree.records[record].corners;
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  return {point, normal, world.surface.geometry->tree.source_triangle[record]};
}

}  // namespace

SkinPlace nearestOnSkin(const scene::World& world, const Vec3& point) {
  const auto& tree = world.surface.geometry->tree;
  const auto nearest = tree::nearestPoint(tree, point, 2.0 * tree.diagonal + (point - tree.center).norm());
  return nearest.triangle == kNoIndex ? SkinPlace{point, Vec3::UnitZ()}
                                      : placeIn(world, nearest.triangle, nearest.closest.point);
}

SkinPlace skinPlace(const scene::World& world, std::string_view words) {
  const body::NamedPlace place = body::placeNamed(world.body->anatomy.landmarks, words);
  const SkinPlace nearest = nearestOnSkin(world, place.point);
  if (!place.moved) return nearest;
  const double far =
      nearest.normal.z() < 0.0 ? -world.surface.geometry->tree.diagonal : world.surface.geometry->tree.diagonal;
  const Vec3 out(0.0, 0.0, far);
  const auto crossing = tree::firstFrontCrossing(world.surface.geometry->tree, place.point + out, place.point - out);
  return crossing.triangle == kNoIndex ? nearest : placeIn(world, crossing.triangle, crossing.point);
}

}  // namespace palpate::engine

// A vertex cannot come nearer to bone than its distance at rest less its displacement: most need not be asked. One
// whose way from rest passes the front of a bone is inside it.
#include "palpate/engine/bone_cover.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/body/places.h"

namespace palpate::engine {

BoneCoverMeter::BoneCoverMeter(const scene::World& world) : world_(world) {
  mesh::TriangleMesh joined;
  for (Index bone = 0; bone < world.body->anatomy.bones.size(); ++bone) {
    mesh::append(world.body->anatomy.bones[bone].mesh, joined);
    bone_of_triangle_.resize(joined.triangles.size(), bone);
  }
  if (!joined.triangles.empty() && !world.body->anatomy.depth_mm.empty()) bones_ = tree::buildTriangleTree(joined);
}

std::optional<BoneCover> BoneCoverMeter::of(const deform::DeformedSurface& surface) const {
  if (!bones_) return std::nullopt;
  std::optional<BoneCover> cover;
  for (Index v = 0; v < surface.vertices(); ++v) {
    const double moved = static_cast<double>(surface.displacementAt(v).norm());
    if (!(moved > 0.0)) continue;
    const double least = cover ? cover->least_mm : std::numeric_limits<double>::infinity();
    const double at_least = world_.body->anatomy.depth_mm[v] - moved;
    if (!(at_least < least)) continue;
    const Vec3 now = surface.placeAt(v);
    const tree::NearestPoint nearest = tree::nearestPoint(*bones_, now, world_.body->anatomy.depth_mm[v] + moved + 1.0);
    if (nearest.triangle == kNoIndex) continue;
    const bool inside = tree::firstFrontCrossing(*bones_, world_.body->skin.positions[v], now).triangle != kNoIndex;
    const double distance = std::sqrt(nearest.closest.squared_distance) * (inside ? -1.0 : 1.0);
    if (distance < least) cover = {distance, now, bone_of_triangle_[bones_->source_triangle[nearest.triangle]]};
  }
  return cover;
}

std::string describe(const BoneCover& cover, const scene::World& world) {
  return fmt::format("{:.1f} mm of tissue left over {}", cover.least_mm,
                     body::spokenName(world.body->anatomy.bones[cover.bone].name));
}

}  // namespace palpate::engine

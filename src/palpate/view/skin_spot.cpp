#include "palpate/view/skin_spot.h"

#include "palpate/partition/triangle_tree.h"

namespace palpate::view {

std::optional<SkinSpot> spotBetween(const contact::Surface& surface, const Vec3& from, const Vec3& to) {
  const auto crossing = partition::firstFrontCrossing(surface.tree, from, to);
  if (crossing.triangle == kNoIndex) return std::nullopt;
  const partition::TriangleRecord& record = surface.tree.records[crossing.triangle];
  return SkinSpot{record.vertices, partition::barycentricWeights(record.corners, crossing.point).cast<float>()};
}

}  // namespace palpate::view

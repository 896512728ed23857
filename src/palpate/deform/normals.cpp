#include "palpate/deform/normals.h"

namespace palpate::deform {

Vec3f areaWeightedNormal(const Skin& skin, const PositionStreams& positions, Index vertex) noexcept {
  Vec3 sum = Vec3::Zero();
  for (const Index t : skin.triangles_of_vertex[vertex]) {
    const auto& [a, b, c] = skin.triangles[t];
    sum += mesh::areaVector2(positions.at(a), positions.at(b), positions.at(c));
  }
  sum.stableNormalize();
  return sum.cast<float>();
}

}  // namespace palpate::deform

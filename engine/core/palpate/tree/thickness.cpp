// One short segment a vertex, searched from its far end: the triangle it enters there is the far side of the part.
// Data flow: tree and vertices of a body at load -> here -> deform::Skin::thickness_mm.
#include <cmath>
#include <limits>

#include "palpate/base/background.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::tree {

namespace {

/// Sides of other parts that one segment may meet before the own far side; what is left then is taken for it.
constexpr int kMaxSides = 8;
/// The segment ends this share of it before the vertex, so that the vertex's own triangles are not met.
constexpr double kBeforeTheVertex = 1e-3;
/// To ask for as many takes 1 ms.
constexpr std::size_t kSharedVertices = 4096;

}  // namespace

// The crossing nearest to the place, of those into the body on the way to it.
double wayThrough(const TriangleTree& tree, const Vec3& at, const Vec3& inwards, double most_mm) noexcept {
  const Vec3 end = at + kBeforeTheVertex * most_mm * inwards;
  Vec3 from = at + most_mm * inwards;
  double way = std::numeric_limits<double>::infinity();
  for (int side = 0; side < kMaxSides; ++side) {
    const Crossing crossing = firstFrontCrossing(tree, from, end);
    if (crossing.triangle == kNoIndex) break;
    way = (crossing.point - at).norm();
    from = crossing.point - kBeforeTheVertex * most_mm * inwards;
    if ((from - at).dot(inwards) <= kBeforeTheVertex * most_mm) break;
  }
  return way;
}

std::vector<float> thicknessUpTo(const TriangleTree& tree, const std::vector<Vec3>& positions,
                                 const std::vector<Vec3>& normals, double most_mm) {
  std::vector<float> thickness(positions.size(), std::numeric_limits<float>::infinity());
  shareOut(positions.size(), kSharedVertices, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (!positions[v].allFinite() || !(normals[v].squaredNorm() > 0.5)) continue;
      thickness[v] = static_cast<float>(wayThrough(tree, positions[v], -normals[v], most_mm));
    }
  });
  return thickness;
}

}  // namespace palpate::tree

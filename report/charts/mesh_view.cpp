// Corners of a box are numbered by bits, one an axis: an edge changes one bit.
#include "report/charts/mesh_view.h"

namespace palpate::figures {

std::vector<std::array<Vec3, 2>> boxEdges(const Eigen::AlignedBox3d& box) {
  const auto corner = [&box](int i) { return box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)); };
  std::vector<std::array<Vec3, 2>> edges;
  for (int i = 0; i < 8; ++i) {
    for (const int axis : {1, 2, 4}) {  // corners are numbered by bits: x, y, z
      if ((i & axis) == 0) edges.push_back({corner(i), corner(i | axis)});
    }
  }
  return edges;
}

}  // namespace palpate::figures

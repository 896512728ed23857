#include "palpate/mesh/reorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "lab/workloads/workload_meshes.h"
#include "support/mesh_zoo.h"

namespace palpate::mesh {

std::vector<Index> upTo(std::size_t n) {
  std::vector<Index> order(n);
  std::iota(order.begin(), order.end(), Index{0});
  return order;
}

/// Mean diagonal of the boxes of runs of so many points.
double meanBox(const std::vector<Vec3>& points, const std::vector<Index>& order, std::size_t run) {
  double sum = 0.0;
  for (std::size_t first = 0; first < order.size(); first += run) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = first; i < std::min(first + run, order.size()); ++i) box.extend(points[order[i]]);
    sum += box.sizes().norm();
  }
  return sum / (static_cast<double>(order.size()) / static_cast<double>(run));
}

TEST(CompactGroups, NamesEveryPointOnce) {
  const auto mesh = zoo::wavyGrid(77, 100.0);
  auto order = inCompactGroups(mesh.positions, upTo(mesh.positions.size()));
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, upTo(mesh.positions.size()));
}

// 256 x 256 vertices a millimetre apart: 64 of them fit into 7 x 7 mm, 4,096 into 63 x 63 mm.
TEST(CompactGroups, HasSmallBoxesAtBothSizes) {
  const auto mesh = zoo::grid(255, 255.0);
  const auto order = inCompactGroups(mesh.positions, upTo(mesh.positions.size()));
  EXPECT_LT(meanBox(mesh.positions, order, 64), 1.1 * 7 * std::sqrt(2.0));
  EXPECT_LT(meanBox(mesh.positions, order, 4096), 1.1 * 63 * std::sqrt(2.0));
}

// A curve through space leaves a surface that is not aligned with it, and comes back elsewhere.
TEST(CompactGroups, HasSmallerBoxesOnABackThanMortonsCurve) {
  const auto back = lab::backMesh(41582);
  const auto order = inCompactGroups(back.positions, upTo(back.positions.size()));
  EXPECT_LT(meanBox(back.positions, order, 64), 0.7 * meanBox(back.positions, mortonOrder(back.positions), 64));
}

TEST(CompactGroups, TellsEqualPointsApartByTheirPlace) {
  const std::vector<Vec3> same(200, Vec3(1, 2, 3));
  EXPECT_EQ(inCompactGroups(same, upTo(200)), upTo(200));
}

TEST(CompactGroups, TakesWhatIsNotFiniteForZero) {
  std::vector<Vec3> points(200, Vec3::Zero());
  points[50].x() = std::numeric_limits<double>::quiet_NaN();
  points[60].y() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(inCompactGroups(points, upTo(200)), upTo(200));
  EXPECT_TRUE(inCompactGroups({}, {}).empty());
}

}  // namespace palpate::mesh

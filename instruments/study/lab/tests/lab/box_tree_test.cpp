// The judge's tree beside a look at every triangle.
#include "lab/judges/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "lab/judges/surface_side.h"
#include "lab/workloads/hunted_bodies.h"
#include "palpate/base/random.h"

namespace palpate::lab {
namespace {

std::array<Vec3, 3> cornersOf(const mesh::TriangleMesh& mesh, const Triangle& t) {
  return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

TEST(BoxTree, FindsWhatALookAtEveryTriangleFinds) {
  const mesh::TriangleMesh mesh = huntedBody("leaf", 4);
  const BoxTree tree(mesh);
  const Box3 box = mesh::boundingBox(mesh);
  Random random(6);
  std::vector<Index> within;
  for (int i = 0; i < 50; ++i) {
    const Vec3 share = random.uniform3(-0.2, 1.2);
    const Vec3 place = box.min() + share.cwiseProduct(box.diagonal());
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t count = 0;
    for (const Triangle& t : mesh.triangles) {
      const double distance = (nearestOnTriangle(cornersOf(mesh, t), place) - place).norm();
      nearest = std::min(nearest, distance);
      count += distance <= 9.0 ? 1 : 0;
    }
    EXPECT_DOUBLE_EQ(tree.nearest(place, 1e6).distance, nearest);
    EXPECT_EQ(tree.nearest(place, 0.9 * nearest).triangle, kNoIndex) << "nothing within the bound";
    tree.collectWithin(place, 9.0, within);
    EXPECT_EQ(within.size(), count);
  }
}

TEST(BoxTree, CountsCrossingsByTheirWay) {
  const mesh::TriangleMesh plate = huntedBody("thin_plate", 1);  // in z from 0 on
  const BoxTree tree(plate);
  const double top = mesh::boundingBox(plate).max().z();
  const auto in = tree.crossing({31.1, 40.3, top + 1}, {31.1, 40.3, 0.5 * top});
  EXPECT_EQ(in.inwards, 1);
  EXPECT_NEAR(in.entry->z(), top, 1e-12);
  EXPECT_EQ(tree.crossing({31.1, 40.3, 0.5 * top}, {31.1, 40.3, top + 1}).inwards, -1);
  EXPECT_EQ(tree.crossing({31.1, 40.3, top + 1}, {31.1, 40.3, -1}).inwards, 0) << "in and out again";
  EXPECT_FALSE(tree.crossing({31.1, 40.3, top + 1}, {31.1, 41.3, top + 1}).entry);
}

}  // namespace
}  // namespace palpate::lab

#include "palpate/hdb/copying_growth.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/tests/hdb/partition_judges.h"
#include "palpate/hdb/partition.h"
#include "support/golden.h"

namespace palpate::hdb {

namespace {

double areaOf(const Pieces& pieces) {
  double area = 0.0;
  for (int i = 0; i < pieces.count; ++i) {
    const auto& [a, b, c] = pieces.triangles[i];
    area += 0.5 * mesh::areaVector2(a, b, c).norm();
  }
  return area;
}

Piece cornersOf(const nlohmann::json& rows) {
  return {palpate::test::vec3(rows.at(0)), palpate::test::vec3(rows.at(1)), palpate::test::vec3(rows.at(2))};
}

/// A mesh of this triangle and corners of a frame so large and symmetric that its centre is the origin: so the first
/// plane of the tree is the golden one.
mesh::TriangleMesh framed(const Piece& corners) {
  constexpr double kFar = 8.0;
  mesh::TriangleMesh mesh;
  mesh.positions.assign(corners.begin(), corners.end());
  mesh.triangles.push_back({0, 1, 2});
  for (const double s : {-kFar, kFar}) {
    const auto first = static_cast<Index>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{s, s, s}, {s * 0.9, s, s}, {s, s * 0.9, s}});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// The slots of the root's children that hold triangle 0.
std::vector<int> slotsOf(const Partition& partition) {
  std::vector<int> slots;
  const Node& root = partition.nodes[0];
  for (Index c = root.first_child; c < root.first_child + root.child_count; ++c) {
    const auto triangles = trianglesOf(partition, partition.nodes[c]);
    if (std::find(triangles.begin(), triangles.end(), 0u) != triangles.end()) slots.push_back(partition.nodes[c].slot);
  }
  return slots;
}

/// The golden plane is z = 0; the tree's first plane cuts x, so the axes are turned round.
Piece zToX(const Piece& corners) {
  Piece turned;
  for (int i = 0; i < 3; ++i) turned[i] = {corners[i].z(), corners[i].x(), corners[i].y()};
  return turned;
}

std::vector<int> bspSides(const Piece& corners, Assignment assignment) {
  std::vector<int> sides = slotsOf(buildPartition(framed(zToX(corners)), {TreeKind::Bsp, assignment, 2}));
  for (int& side : sides) side = side == 1 ? 1 : -1;
  std::sort(sides.rbegin(), sides.rend());
  return sides;
}

}  // namespace

TEST(Cut, AgreesWithTheGoldenPieces) {
  for (const nlohmann::json& row : palpate::test::goldenRows("triangle_assignment", "bsp")) {
    ASSERT_EQ(palpate::test::vec3(row.at("plane_N")), Vec3(0, 0, 1));
    const AxisPlane plane{2, -row.at("plane_d").get<double>()};
    SCOPED_TRACE(row.at("tri").dump());
    const Pieces positive = clip(cornersOf(row.at("tri")), plane, true);
    const Pieces negative = clip(cornersOf(row.at("tri")), plane, false);
    EXPECT_EQ(positive.count, row.at("A_pos_count").get<int>());
    EXPECT_EQ(negative.count, row.at("A_neg_count").get<int>());
    EXPECT_NEAR(areaOf(positive), row.at("A_pos_area").get<double>(), 1e-15);
    EXPECT_NEAR(areaOf(negative), row.at("A_neg_area").get<double>(), 1e-15);
  }
}

TEST(Assignment, AgreesWithTheGoldenSides) {
  for (const nlohmann::json& row : palpate::test::goldenRows("triangle_assignment", "bsp")) {
    SCOPED_TRACE(row.at("tri").dump());
    const Piece corners = cornersOf(row.at("tri"));
    EXPECT_EQ(bspSides(corners, Assignment::BothSides), row.at("B").get<std::vector<int>>());
    EXPECT_EQ(bspSides(corners, Assignment::Majority), std::vector<int>{row.at("C").get<int>()});
  }
}

TEST(Assignment, ThreeCaseCTestsInARowAgreeWithTheGoldenOctants) {  // E6
  for (const nlohmann::json& row : palpate::test::goldenRows("triangle_assignment", "octree")) {
    SCOPED_TRACE(row.at("tri").dump());
    const Partition partition =
        buildPartition(framed(cornersOf(row.at("tri"))), {TreeKind::Octree, Assignment::Majority, 2});
    EXPECT_EQ(slotsOf(partition), std::vector<int>{row.at("majority").get<int>()});
  }
}

TEST(Cut, BothPartsTogetherAreTheTriangleAndKeepItsWinding) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    Piece triangle;
    for (Vec3& corner : triangle) corner = random.uniform3(-1, 1);
    const AxisPlane plane{static_cast<int>(random.below(3)), random.uniform(-0.5, 0.5)};
    const Vec3 whole = mesh::areaVector2(triangle[0], triangle[1], triangle[2]);
    Vec3 sum = Vec3::Zero();
    for (const bool positive : {false, true}) {
      const Pieces pieces = clip(triangle, plane, positive);
      for (int p = 0; p < pieces.count; ++p) {
        const auto& [a, b, c] = pieces.triangles[p];
        const Vec3 part = mesh::areaVector2(a, b, c);
        ASSERT_GE(part.dot(whole), 0.0);
        sum += part;
        for (const Vec3& corner : pieces.triangles[p]) {
          ASSERT_TRUE(positive ? corner[plane.axis] >= plane.at : corner[plane.axis] <= plane.at);
        }
      }
    }
    ASSERT_NEAR((sum - whole).norm(), 0.0, 1e-14);
  }
}

TEST(Cut, NeighboursMeetInTheSamePoint) {
  const Vec3 low(0.1, 0.2, -0.3), high(0.7, 0.5, 0.9);
  const AxisPlane plane{2, 0.1};
  const Pieces left = clip({low, high, Vec3(0, 1, -1)}, plane, true);
  const Pieces right = clip({high, low, Vec3(1, 0, -1)}, plane, false);
  int shared = 0;
  for (const Vec3& a : left.triangles[0]) {
    for (int p = 0; p < right.count; ++p) {
      for (const Vec3& b : right.triangles[p]) shared += a == b && a[2] == plane.at ? 1 : 0;
    }
  }
  EXPECT_GT(shared, 0);
}

}  // namespace palpate::hdb

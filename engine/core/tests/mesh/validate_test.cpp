#include "palpate/mesh/validate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "lab/workloads/workload_meshes.h"
#include "support/mesh_zoo.h"

namespace palpate::mesh {

TEST(Validate, ASoundMeshHasNoTraits) {
  for (const auto& mesh : {zoo::cube(), zoo::sphere(), zoo::torus()}) {
    const auto report = validate(mesh);
    EXPECT_TRUE(report.fit());
    EXPECT_TRUE(report.closed);
    EXPECT_TRUE(report.self_intersections_checked);
    EXPECT_TRUE(describe(report).empty());
  }
}

/// A cylinder whose caps are fans round their middles: every box of a cap overlaps the others.
TriangleMesh cylinderWithFans(Index sides) {
  TriangleMesh mesh;
  for (Index i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    for (const double z : {0.0, 400.0}) mesh.positions.emplace_back(60.0 * std::cos(angle), 60.0 * std::sin(angle), z);
  }
  mesh.positions.emplace_back(0, 0, 0);
  mesh.positions.emplace_back(0, 0, 400);
  for (Index i = 0; i < sides; ++i) {
    const Index low = 2 * i, next = 2 * ((i + 1) % sides);
    mesh.triangles.push_back({low, next, next + 1});
    mesh.triangles.push_back({low, next + 1, low + 1});
    mesh.triangles.push_back({2 * sides, next, low});
    mesh.triangles.push_back({2 * sides + 1, low + 1, next + 1});
  }
  return mesh;
}

TEST(Validate, FansAreSearchedForSelfIntersectionsToTheEnd) {
  for (const Index sides : {180u, 240u, 1000u}) {
    const auto report = validate(cylinderWithFans(sides));
    EXPECT_TRUE(report.self_intersections_checked) << sides;
    EXPECT_TRUE(report.fit()) << sides;
    EXPECT_EQ(report.self_intersections.count, 0u) << sides;
  }
}

TEST(Validate, MeasuresBoxAreaAndVolume) {
  const auto cube = validate(zoo::cube(10, {1, 2, 3}));
  EXPECT_NEAR(cube.area_mm2, 600.0, 1e-9);
  EXPECT_NEAR(cube.volume_mm3, 1000.0, 1e-9);
  EXPECT_EQ(cube.box.max(), Vec3(11, 12, 13));
  const auto sphere = validate(zoo::sphere(20, 5));
  EXPECT_NEAR(sphere.volume_mm3, 4.0 / 3.0 * std::numbers::pi * 8000.0, 60.0);
  EXPECT_LT(validate(zoo::insideOut()).volume_mm3, 0.0);
}

TEST(Validate, NamesVerticesThatCannotBeUsed) {
  const auto report = validate(zoo::cubeWithNonFiniteVertices());
  EXPECT_EQ(report.non_finite_vertices.count, 2u);
  EXPECT_EQ(report.non_finite_vertices.first, (std::vector<Index>{8, 9}));
  EXPECT_NEAR(report.volume_mm3, 1000.0, 1e-9);  // the rest is measured all the same
  const auto unused = validate(zoo::cubeWithUnusedVertices());
  EXPECT_EQ(unused.unused_vertices.first, (std::vector<Index>{4, 9, 10}));
  EXPECT_EQ(unused.box.max(), Vec3(10, 10, 10));
}

TEST(Validate, NamesWrongIndices) {
  const auto report = validate(zoo::cubeWithWrongIndices());
  EXPECT_EQ(report.wrong_indices.first, (std::vector<Index>{12, 13}));
  EXPECT_TRUE(report.closed);
}

TEST(Validate, CountsTwins) {
  EXPECT_EQ(validate(zoo::cubeWithDuplicates()).duplicate_triangles.first, (std::vector<Index>{12, 13, 14}));
  const auto fin = validate(zoo::cubeWithFin());
  EXPECT_EQ(fin.opposite_triangles.first, (std::vector<Index>{13, 15}));
  EXPECT_EQ(fin.duplicate_triangles.count, 0u);
}

TEST(Validate, FindsTrianglesWithoutArea) {
  EXPECT_EQ(validate(zoo::cubeWithCap()).zero_area_triangles.first, (std::vector<Index>{13}));
  EXPECT_EQ(validate(zoo::cubeWithNeedles()).zero_area_triangles.count, 2u);
  EXPECT_EQ(validate(zoo::plateWithFoldedSliver()).zero_area_triangles.first, (std::vector<Index>{3}));
}

TEST(Validate, FindsNonManifoldEdgesAndVertices) {
  const auto edge = validate(zoo::cubesSharingAnEdge());
  EXPECT_EQ(edge.non_manifold_edges.count, 1u);
  EXPECT_EQ(edge.non_manifold_vertices.count, 0u);
  EXPECT_TRUE(edge.closed);
  const auto vertex = validate(zoo::cubesSharingAVertex());
  EXPECT_EQ(vertex.non_manifold_edges.count, 0u);
  EXPECT_EQ(vertex.non_manifold_vertices.first, (std::vector<Index>{7}));
  EXPECT_EQ(validate(zoo::book()).non_manifold_edges.count, 1u);
}

TEST(Validate, KnowsOneSidedFromMerelyMixed) {
  EXPECT_TRUE(validate(zoo::moebius()).one_sided);
  EXPECT_TRUE(validate(zoo::kleinBottle()).one_sided);
  const auto mixed = validate(zoo::mixedWinding());
  EXPECT_GT(mixed.inconsistent_edges.count, 100u);
  EXPECT_FALSE(mixed.one_sided);
  EXPECT_FALSE(mixed.closed);
}

TEST(Validate, CountsBordersAndParts) {
  const auto tube = validate(zoo::openTube(10, 40, 24, 8));
  EXPECT_EQ(tube.border_edges.count, 48u);
  EXPECT_EQ(tube.border_loops, 2u);
  EXPECT_EQ(validate(zoo::grid()).border_loops, 1u);
  EXPECT_EQ(validate(zoo::moebius()).border_loops, 1u);
  EXPECT_EQ(validate(zoo::coincidentTriangles()).components, 2u);
  EXPECT_EQ(validate(zoo::soup(zoo::cube())).components, 12u);
}

/// Enough triangles that several threads share the search.
TEST(Validate, CountsTheEdgesOfALargeSheetThatAPlaneCuts) {
  TriangleMesh mesh = lab::backMesh(40000);
  constexpr double kCut = 175.1234;
  std::set<std::pair<Index, Index>> cut;
  for (const Triangle& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
      if ((mesh.positions[low].x() < kCut) != (mesh.positions[high].x() < kCut)) cut.insert({low, high});
    }
  }
  const auto first = static_cast<Index>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {{kCut, -1e4, -1e3}, {kCut, 1e4, -1e3}, {kCut, 200.0, 1e4}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  EXPECT_EQ(validate(mesh).self_intersections.count, cut.size());
}

/// Edges that cross the mesh, through the inside of a triangle or not.
std::size_t crossingEdges(const TriangleMesh& mesh) {
  const auto report = validate(mesh);
  return report.self_intersections.count + report.touching_edges.count;
}

TEST(Validate, FindsSelfIntersections) {
  EXPECT_GT(crossingEdges(zoo::overlappingSpheres()), 20u);
  EXPECT_GT(crossingEdges(zoo::kleinBottle()), 10u);
  const auto beside = zoo::joined(zoo::cube(), zoo::cube(10, {10, 0, 0}));
  EXPECT_EQ(crossingEdges(beside), 0u);
  EXPECT_EQ(crossingEdges(zoo::hollowSphere()), 0u);
}

TEST(Validate, CountsEdgesThatPierceAndEdgesThatTouchApart) {
  // One edge through the inside of a square's triangle, one through the diagonal of the square, one ends on it.
  TriangleMesh mesh = zoo::grid(1, 10);
  const auto add_post = [&](double x, double y, double bottom) {
    const auto first = static_cast<Index>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{x, y, bottom}, {x, y, 10}, {x, y + 0.5, 0}});
    mesh.triangles.push_back({first, first + 1, first + 2});
  };
  add_post(7, 2, -1);
  add_post(5, 5, -1);
  add_post(2, 7, 0);
  const auto report = validate(mesh);
  EXPECT_EQ(report.self_intersections.count, 1u);
  EXPECT_EQ(report.self_intersections.first.size(), 1u);
  EXPECT_EQ(report.touching_edges.count, 2u) << "the post's and the diagonal";
  EXPECT_EQ(report.touching_edges.first, (std::vector<Index>{0, 1, 3}));
  // Cubes that meet exactly on diagonals only touch; repair takes them for intersecting all the same.
  const auto cubes = validate(zoo::joined(zoo::cube(), zoo::cube(10, {5, 5, 5})));
  EXPECT_EQ(cubes.self_intersections.count, 0u);
  EXPECT_GT(cubes.touching_edges.count, 0u);
}

TEST(Validate, CountsVerticesAtThePlaceOfOthers) {
  EXPECT_EQ(validate(zoo::soup(zoo::cube())).coincident_vertices.count, 28u);
  EXPECT_EQ(validate(zoo::coincidentTriangles()).coincident_vertices.first, (std::vector<Index>{3, 4, 5}));
  EXPECT_EQ(validate(zoo::cube()).coincident_vertices.count, 0u);
}

TEST(Validate, NamesNoTriangleTwice) {
  const auto report = validate(zoo::soup(zoo::cube()));
  EXPECT_EQ(report.border_edges.count, 36u);
  EXPECT_EQ(report.border_edges.first, (std::vector<Index>{0, 1, 2, 3, 4}));
}

TEST(Validate, TellsClosedNearlyClosedAndOpenApart) {
  EXPECT_EQ(validate(zoo::sphere()).closure, Closure::closed);
  EXPECT_EQ(validate(zoo::cubesSharingAnEdge()).closure, Closure::closed);
  EXPECT_EQ(validate(zoo::grid()).closure, Closure::open);
  TriangleMesh torn = zoo::sphere(20, 3);
  torn.triangles.pop_back();
  const auto report = validate(torn);
  EXPECT_EQ(report.closure, Closure::nearly_closed);
  EXPECT_FALSE(report.closed);
  EXPECT_EQ(report.fillable_holes, 1u);
  EXPECT_TRUE(report.sound());
  EXPECT_FALSE(report.fit()) << "repair would fill its hole";
}

TEST(Validate, DoubtsBodiesOfNoBodysSize) {
  EXPECT_TRUE(hasDoubtfulSize(validate(zoo::cube(0.2)).box));
  EXPECT_FALSE(hasDoubtfulSize(validate(zoo::cube(10)).box));
  EXPECT_TRUE(hasDoubtfulSize(validate(zoo::cube(30000)).box));
  EXPECT_FALSE(hasDoubtfulSize(validate(zoo::empty()).box));
}

TEST(Validate, SaysWhatItFindsInPlainWords) {
  const auto sentences = describe(validate(zoo::cubeWithDuplicates()));
  ASSERT_FALSE(sentences.empty());
  EXPECT_EQ(sentences[0], "3 duplicate triangles (first: 12, 13, 14)");
}

TEST(Validate, NothingIsNotFit) {
  const auto report = validate(zoo::empty());
  EXPECT_FALSE(report.fit());
  EXPECT_FALSE(report.closed);
}

}  // namespace palpate::mesh

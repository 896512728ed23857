// Triangles over the same vertices cancel with their sign; what is watertight stays watertight.
#include "palpate/mesh/doubled_triangles.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/repair.h"
#include "palpate/mesh/winding.h"
#include "support/mesh_zoo.h"
#include "support/places.h"

namespace palpate::mesh {

namespace {

Triangle opposite(const Triangle& t) { return {t[0], t[2], t[1]}; }

/// Every edge is used as often one way as the other. Written without topology.h.
bool isWatertight(const TriangleMesh& mesh) {
  std::map<std::pair<Index, Index>, int> signed_uses;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i];
      const Index b = t[(i + 1) % 3];
      signed_uses[std::minmax(a, b)] += a == b ? 0 : a < b ? 1 : -1;
    }
  }
  for (const auto& [edge, uses] : signed_uses) {
    if (uses != 0) return false;
  }
  return !mesh.triangles.empty();
}

void expectWatertight(const RepairResult& result, const char* what) {
  EXPECT_TRUE(result.closed) << what;
  EXPECT_TRUE(isWatertight(result.mesh)) << what;
  EXPECT_EQ(result.after.border_edges, 0u) << what;
  EXPECT_TRUE(result.warnings.empty()) << what;
}

/// A fin of two triangles that stands on an edge of triangle `t`, `t` itself three times, once of them turned round.
TriangleMesh cubeWithTripledTriangleAndFin() {
  TriangleMesh mesh = zoo::cube();
  const Triangle t = mesh.triangles[0];
  mesh.triangles.insert(mesh.triangles.end(), {t, opposite(t)});
  const auto tip = static_cast<Index>(mesh.positions.size());
  mesh.positions.emplace_back(mesh.positions[t[0]] + Vec3(-5, -5, -5));
  mesh.triangles.push_back({t[0], t[1], tip});
  mesh.triangles.push_back({t[1], t[0], tip});
  return mesh;
}

/// A tetrahedron on the edge from (0, 0, 0) to (10, 0, 0) of the cube, inside it.
TriangleMesh cubeWithTetrahedronOnAnEdge(bool facing_in) {
  TriangleMesh mesh = zoo::cube();
  const auto place = [&](const Vec3& at) {
    for (Index v = 0; v < 8; ++v) {
      if (mesh.positions[v] == at) return v;
    }
    return kNoIndex;
  };
  const Index a = place({0, 0, 0});
  const Index b = place({10, 0, 0});
  const auto c = static_cast<Index>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {{5, 4, 2}, {5, 2, 4}});
  for (const Triangle& t : {Triangle{a, c, b}, {a, b, c + 1}, {a, c + 1, c}, {b, c, c + 1}}) {
    mesh.triangles.push_back(facing_in ? opposite(t) : t);
  }
  return mesh;
}

}  // namespace

TEST(Doubled, TwoOneWayAndOneTheOtherAreOne) {
  TriangleMesh mesh = load(support::testData() / "mesh/tripled_dragon.obj");
  const DoubledRemoved removed = removeDoubled(mesh);
  EXPECT_EQ(removed.cancelled, 3u);
  EXPECT_EQ(removed.duplicates + removed.opposite_pairs + removed.sides, 0u);
  std::set<Triangle> left;
  for (Triangle t : mesh.triangles) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    left.insert(t);
  }
  EXPECT_EQ(left, (std::set<Triangle>{{0, 1, 2}, {1, 4, 2}, {2, 4, 3}, {5, 7, 6}}));
}

TEST(Doubled, ACubeWithTripledTrianglesIsThatCube) {
  const auto result = repair(load(support::testData() / "mesh/tripled_cube.obj"));
  expectWatertight(result, "cube");
  EXPECT_EQ(result.mesh.triangles.size(), 12u);
  EXPECT_NEAR(signedVolume(result.mesh), 1e6, 1e-6);
}

TEST(Doubled, AFinTakesNoTripledTriangleWithIt) {
  const auto result = repair(cubeWithTripledTriangleAndFin());
  expectWatertight(result, "cube");
  EXPECT_EQ(result.mesh.triangles.size(), 12u);
  EXPECT_NEAR(signedVolume(result.mesh), 1000.0, 1e-9);
}

TEST(Doubled, ABodyWoundTwiceBecomesOne) {
  TriangleMesh twice = zoo::sphere(20, 1);
  const auto once = twice.triangles;
  twice.triangles.insert(twice.triangles.end(), once.begin(), once.end());
  const auto result = repair(twice);
  expectWatertight(result, "sphere");
  EXPECT_EQ(result.mesh.triangles, once);
}

TEST(Doubled, BodiesThatShareAPartOfTheirSkinStayClosed) {
  // A tetrahedron whose floor is a triangle of the cube's: wound twice there, and once everywhere else.
  TriangleMesh mesh = zoo::cube();
  const Triangle floor = mesh.triangles[0];
  const Vec3 middle = centreOf(mesh, floor);
  const auto tip = static_cast<Index>(mesh.positions.size());
  mesh.positions.emplace_back(middle + 0.3 * (Vec3(5, 5, 5) - middle));
  mesh.triangles.push_back(floor);
  for (std::size_t i = 0; i < 3; ++i) mesh.triangles.push_back({floor[(i + 1) % 3], floor[i], tip});
  ASSERT_TRUE(isWatertight(mesh));
  expectWatertight(repair(mesh), "cube and tetrahedron");
}

TEST(Doubled, BodiesWithinBodiesThatShareAnEdgeStayClosed) {
  const TriangleMesh nested = cubeWithTetrahedronOnAnEdge(false);
  ASSERT_TRUE(isWatertight(nested));
  const auto result = repair(nested);
  expectWatertight(result, "nested");
  EXPECT_EQ(result.before.non_manifold_edges, 1u);
  EXPECT_EQ(result.after.non_manifold_edges, 0u);
}

TEST(Doubled, AHollowThatTouchesTheSkinInAnEdgeStaysAHollow) {
  const TriangleMesh hollow = cubeWithTetrahedronOnAnEdge(true);
  const double volume = signedVolume(hollow);
  ASSERT_LT(volume, 999.0);
  const auto result = repair(hollow);
  expectWatertight(result, "hollow");
  EXPECT_NEAR(signedVolume(result.mesh), volume, 1e-9);
}

TEST(Doubled, PatchesThatOnlyTogetherAreClosedAreTurnedTogether) {
  // Four pyramids without floors over one square: the walls of a bowl that hangs over a bowl. Each of them is open.
  TriangleMesh mesh{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 2}, {0, 0, 1}, {0, 0, -1}, {0, 0, -2}}, {}};
  for (const auto& [tip, up] : {std::pair<Index, bool>{4, true}, {5, false}, {6, true}, {7, false}}) {
    for (Index i = 0; i < 4; ++i) {
      const Triangle t = {i, (i + 1) % 4, tip};
      mesh.triangles.push_back(up ? t : opposite(t));
    }
  }
  const double volume = signedVolume(mesh);
  ASSERT_GT(volume, 0.1);
  const auto sound = repair(mesh);
  expectWatertight(sound, "bowls");
  EXPECT_NEAR(signedVolume(sound.mesh), volume, 1e-12);
  const auto turned = repair(zoo::flipped(mesh));
  expectWatertight(turned, "bowls inside out");
  EXPECT_NEAR(signedVolume(turned.mesh), volume, 1e-12);
}

TEST(Doubled, ASheetGivenFromBothSidesOpensAndSaysSo) {
  const auto result = repair(zoo::doubleSidedGrid(4));
  EXPECT_EQ(result.before.closure, Closure::closed);
  EXPECT_EQ(result.after.closure, Closure::open);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("was closed and is open now"), std::string::npos);
}

/// Sums of closed bodies over the same few vertices: triangles many times, edges of many triangles, nested and
/// crossing.
RC_GTEST_PROP(DoubledProperty, WhatIsWatertightStaysWatertight, ()) {
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const auto bodies = *rc::gen::inRange<int>(1, 12);
  TriangleMesh mesh;
  for (int v = 0; v < 9; ++v) mesh.positions.emplace_back(random.below(50), random.below(50), random.below(50));
  for (int i = 0; i < bodies; ++i) {
    const auto corner = [&] { return static_cast<Index>(random.below(9)); };
    const auto [a, b, c, d] = std::array{corner(), corner(), corner(), corner()};
    for (const Triangle& t : {Triangle{a, b, c}, {a, c, d}, {a, d, b}, {b, d, c}}) mesh.triangles.push_back(t);
  }
  TriangleMesh cancelled = mesh;
  std::erase_if(cancelled.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  RC_PRE(!cancelled.triangles.empty());
  RC_ASSERT(isWatertight(cancelled));
  const bool all_opposite = [&] {
    TriangleMesh rest = cancelled;
    const DoubledRemoved removed = removeDoubled(rest);
    return removed.sides > 0 || rest.triangles.empty();
  }();
  RC_PRE(!all_opposite);  // sheets from both sides and nothing else: one side stays, which has a border
  try {
    const auto result = repair(mesh);
    RC_ASSERT(result.closed);
    RC_ASSERT(isWatertight(result.mesh));
  } catch (const Error&) {
    // Nothing was left to feel.
  }
}

}  // namespace palpate::mesh

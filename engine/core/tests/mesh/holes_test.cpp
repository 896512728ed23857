// Small holes of nearly closed bodies are filled; what is open on purpose stays as it is.
#include "palpate/mesh/holes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "palpate/mesh/repair.h"
#include "palpate/mesh/validate.h"
#include "palpate/mesh/winding.h"
#include "support/mesh_zoo.h"

namespace palpate::mesh {

namespace {

/// A ball of 1,280 triangles.
TriangleMesh ball() { return zoo::sphere(20, 3); }

TriangleMesh without(TriangleMesh mesh, std::vector<Index> triangles) {
  std::sort(triangles.rbegin(), triangles.rend());
  for (const Index t : triangles) mesh.triangles.erase(mesh.triangles.begin() + t);
  return mesh;
}

/// Triangle `t` gets `parts` vertices more on each of its edges, `off` mm away from them, of which its neighbours know
/// nothing; then it is cut up as a fan from its middle.
TriangleMesh withTJunctions(TriangleMesh mesh, Index t, int parts, double off = 0.0) {
  const Triangle old = mesh.triangles[t];
  std::vector<Index> ring;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 from = mesh.positions[old[i]];
    const Vec3 to = mesh.positions[old[(i + 1) % 3]];
    ring.push_back(old[i]);
    for (int k = 1; k <= parts; ++k) {
      const double s = static_cast<double>(k) / (parts + 1);
      ring.push_back(static_cast<Index>(mesh.positions.size()));
      const Vec3 away(std::sin(k), std::cos(3.0 * k), std::sin(5.0 * k));
      mesh.positions.emplace_back(from + s * (to - from) + off * away);
    }
  }
  const auto middle = static_cast<Index>(mesh.positions.size());
  mesh.positions.push_back(centreOf(mesh, old));
  mesh.triangles.erase(mesh.triangles.begin() + t);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    mesh.triangles.push_back({ring[i], ring[(i + 1) % ring.size()], middle});
  }
  return mesh;
}

/// The two triangles at an edge of triangle 0: they share it.
std::vector<Index> pairOfTriangles(const TriangleMesh& mesh) { return {0, neighboursOfTriangles(mesh)[0][0]}; }

void expectClosed(const RepairResult& result, const char* what) {
  EXPECT_EQ(result.before.closure, Closure::nearly_closed) << what;
  EXPECT_EQ(result.after.closure, Closure::closed) << what;
  EXPECT_TRUE(result.closed) << what;
  EXPECT_FALSE(result.self_intersecting) << what;
  EXPECT_TRUE(result.warnings.empty()) << what;
  EXPECT_TRUE(validate(result.mesh).fit()) << what;
}

void expectUntouched(const TriangleMesh& mesh, const char* what) {
  const auto result = repair(mesh);
  EXPECT_EQ(result.mesh.triangles, mesh.triangles) << what;
  EXPECT_EQ(result.mesh.positions, mesh.positions) << what;
  EXPECT_EQ(result.before.closure, Closure::open) << what;
  EXPECT_EQ(result.after.closure, Closure::open) << what;
}

}  // namespace

TEST(Holes, LostTrianglesComeBack) {
  const TriangleMesh whole = ball();
  for (const auto& lost : {std::vector<Index>{7}, pairOfTriangles(whole), std::vector<Index>{3, 400, 900}}) {
    const auto result = repair(without(whole, lost));
    expectClosed(result, "ball");
    EXPECT_EQ(result.mesh.triangles.size(), whole.triangles.size());
    EXPECT_EQ(result.mesh.positions, whole.positions);
    EXPECT_NEAR(signedVolume(result.mesh), signedVolume(whole), 1e-3 * signedVolume(whole));
  }
}

TEST(Holes, TwoThatTouchInAVertexAreTwo) {
  TriangleMesh mesh = ball();
  const Index vertex = mesh.triangles[0][0];
  std::vector<Index> around;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    if (std::count(mesh.triangles[t].begin(), mesh.triangles[t].end(), vertex) > 0) around.push_back(t);
  }
  const auto shares = [&](Index a, Index b) {
    return std::count_if(mesh.triangles[a].begin(), mesh.triangles[a].end(), [&](Index v) {
             return std::count(mesh.triangles[b].begin(), mesh.triangles[b].end(), v) > 0;
           }) > 1;
  };
  const auto other = *std::find_if(around.begin() + 1, around.end(), [&](Index t) { return !shares(t, around[0]); });
  const TriangleMesh torn = without(mesh, {around[0], other});
  EXPECT_EQ(validate(torn).fillable_holes, 2u);
  const auto result = repair(torn);
  expectClosed(result, "ball");
  EXPECT_EQ(result.mesh.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(result.mesh.positions.size(), mesh.positions.size());
}

TEST(Holes, CracksAlongTJunctionsAreSewnUpWithoutANewVertexOrASliver) {
  const TriangleMesh whole = ball();
  for (const int parts : {1, 2, 5, 20}) {
    const TriangleMesh cracked = withTJunctions(whole, 5, parts);
    const auto result = repair(cracked);
    const std::string what = std::to_string(parts) + " vertices on each edge";
    expectClosed(result, what.c_str());
    EXPECT_EQ(result.mesh.positions, cracked.positions) << what;
    EXPECT_NEAR(signedVolume(result.mesh), signedVolume(whole), 1e-9 * signedVolume(whole)) << what;
    // Each vertex cuts the fan and the neighbour across, and the middle cuts the triangle into three.
    EXPECT_EQ(result.mesh.triangles.size(), whole.triangles.size() + 2u + 6u * static_cast<unsigned>(parts)) << what;
  }
}

TEST(Holes, CracksOnSeveralSidesOfATriangleAreSewnUp) {
  for (const std::size_t sides : {2u, 3u}) {
    auto around = neighboursOfTriangles(ball())[5];
    std::sort(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(sides), std::greater<>());
    TriangleMesh cracked = ball();
    for (std::size_t i = 0; i < sides; ++i) cracked = withTJunctions(cracked, around[i], 2);
    const auto result = repair(cracked);
    expectClosed(result, sides == 2 ? "two sides" : "three sides");
    EXPECT_EQ(result.mesh.positions, cracked.positions);
    EXPECT_NEAR(signedVolume(result.mesh), signedVolume(ball()), 1e-6);
  }
}

TEST(Holes, CracksMayBeLongerThanWhatIsFilled) {
  const auto result = repair(withTJunctions(ball(), 5, 300), {.find_self_intersections = false});
  EXPECT_TRUE(result.closed);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(result.mesh.triangles.size(), ball().triangles.size() + 2u + 1800u);
}

TEST(Holes, CracksAsWideAsRoundingAreSewnUpToo) {
  // Positions in single precision: off the line by 1e-7 of the diagonal.
  const auto result = repair(withTJunctions(ball(), 5, 3, 3e-6));
  expectClosed(result, "ball");
  const auto report = validate(result.mesh);
  EXPECT_EQ(report.zero_area_triangles.count, 0u);
  EXPECT_EQ(result.mesh.triangles.size(), ball().triangles.size() + 2u + 18u);
}

TEST(Holes, AWideCrackIsFilled) {
  TriangleMesh cracked = withTJunctions(ball(), 5, 3);
  const std::size_t first = ball().positions.size();
  const Vec3 middle = cracked.positions.back();
  for (std::size_t v = first; v + 1 < cracked.positions.size(); ++v) {
    cracked.positions[v] += 0.05 * (middle - cracked.positions[v]);
  }
  const auto result = repair(cracked);
  expectClosed(result, "ball");
  EXPECT_EQ(result.mesh.positions, cracked.positions);
}

TEST(Holes, WhatLapsOverTheSurfaceBesideItStays) {
  const auto result = repair(withTJunctions(ball(), 5, 3, 0.3));
  EXPECT_EQ(result.after.closure, Closure::nearly_closed);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("would overlap"), std::string::npos);
}

TEST(Holes, ABodyThatFacesInwardsIsTurnedWhenItIsClosed) {
  const auto result = repair(zoo::flipped(without(ball(), {7})));
  expectClosed(result, "ball");
  EXPECT_GT(signedVolume(result.mesh), 0.0);
}

TEST(Holes, CanBeKept) {
  const TriangleMesh mesh = without(ball(), {7});
  const auto result = repair(mesh, {.fill_holes = false});
  EXPECT_EQ(result.mesh.triangles, mesh.triangles);
  EXPECT_EQ(result.after.closure, Closure::nearly_closed);
  EXPECT_EQ(result.after.border_edges, 3u);
}

TEST(Holes, OfSheetsAndOfBodiesThatWereCutStay) {
  expectUntouched(zoo::grid(), "grid");
  expectUntouched(without(zoo::grid(), {20, 21, 50}), "grid with holes");
  expectUntouched(zoo::openTube(), "tube");
  expectUntouched(zoo::oneTriangle(), "triangle");
  TriangleMesh cup = ball();
  std::erase_if(cup.triangles, [&](const Triangle& t) { return centreOf(cup, t).z() > 15.0; });
  std::vector<Index> used = repair(cup, {.weld = false}).source_vertex;
  TriangleMesh cut;
  for (const Index v : used) cut.positions.push_back(cup.positions[v]);
  cut.triangles = repair(cup, {.weld = false}).mesh.triangles;
  expectUntouched(cut, "ball without its cap");
}

TEST(Holes, WhereSomethingSticksThroughStaysAndIsNamed) {
  TriangleMesh mesh = ball();
  const Vec3 centre = centreOf(mesh, mesh.triangles[7]);
  // A thin wedge from inside the ball through the hole.
  const TriangleMesh thorn{
      {0.8 * centre, 0.8 * centre + Vec3(0.1, 0, 0), 0.8 * centre + Vec3(0, 0.1, 0.1), 1.2 * centre},
      {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
  const auto result = repair(zoo::joined(without(mesh, {7}), thorn));
  EXPECT_EQ(result.after.border_edges, 3u);
  EXPECT_EQ(result.after.closure, Closure::nearly_closed);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("would overlap"), std::string::npos);
}

TEST(Holes, LongBordersStayAndAreNamed) {
  TriangleMesh mesh = withTJunctions(ball(), 5, 70);
  mesh.triangles.resize(mesh.triangles.size() - 213);
  // The neighbours take over the vertices instead, as fans, so that the hole has 213 edges.
  const Triangle lost = ball().triangles[5];
  for (std::size_t i = 0; i < 3; ++i) {
    const Index from = lost[i];
    const Index to = lost[(i + 1) % 3];
    const auto across = std::find_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (t[k] == to && t[(k + 1) % 3] == from) return true;
      }
      return false;
    });
    ASSERT_NE(across, mesh.triangles.end());
    Index third = kNoIndex;
    for (const Index v : *across) third = v != from && v != to ? v : third;
    mesh.triangles.erase(across);
    const auto first = static_cast<Index>(ball().positions.size() + 70 * i);
    Index last = from;
    for (Index k = 0; k <= 70; ++k) {
      const Index next = k < 70 ? first + k : to;
      mesh.triangles.push_back({next, last, third});
      last = next;
    }
  }
  const auto result = repair(mesh);
  EXPECT_EQ(result.after.border_edges, 213u);
  EXPECT_EQ(result.after.closure, Closure::nearly_closed);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("more than 200 border edges"), std::string::npos);
}

TEST(Holes, OpenPartsBesideAClosedBodyStay) {
  TriangleMesh plate = zoo::grid();
  for (Vec3& place : plate.positions) place += Vec3(100, 0, 0);
  const auto result = repair(zoo::joined(without(ball(), {7}), plate));
  EXPECT_EQ(result.after.border_edges, validate(plate).border_edges.count);
  EXPECT_EQ(result.after.closure, Closure::open);
}

// --- the filling of one loop ---

TEST(LoopTriangulation, CoversAPolygonOnce) {
  const std::vector<Vec3> arrow = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}};
  const auto filling = triangulateLoop(arrow, [](Index, Index) { return true; });
  ASSERT_TRUE(filling);
  EXPECT_EQ(filling->triangles.size(), 3u);
  EXPECT_NEAR(filling->area, 10.0, 1e-12);
  for (const auto& [a, b, c] : filling->triangles) EXPECT_GT(areaVector2(arrow[a], arrow[b], arrow[c]).z(), 0.0);
}

TEST(LoopTriangulation, LeadsStraightAcrossASlit) {
  std::vector<Vec3> slit;
  for (int i = 0; i <= 10; ++i) slit.emplace_back(i, 0, 0);
  for (int i = 10; i >= 0; --i) slit.emplace_back(i, 0.001, 0);
  const auto filling = triangulateLoop(slit, [](Index, Index) { return true; });
  ASSERT_TRUE(filling);
  EXPECT_NEAR(filling->area, 0.01, 1e-12);
  for (const auto& [a, b, c] : filling->triangles) {
    for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}}) EXPECT_LT((slit[p] - slit[q]).norm(), 1.5);
  }
}

TEST(LoopTriangulation, TakesNoForbiddenDiagonal) {
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto filling = triangulateLoop(square, [](Index i, Index j) { return i == 1 && j == 3; });
  ASSERT_TRUE(filling);
  for (const Triangle& t : filling->triangles) {
    EXPECT_FALSE(std::count(t.begin(), t.end(), 0u) > 0 && std::count(t.begin(), t.end(), 2u) > 0);
  }
  EXPECT_FALSE(triangulateLoop(square, [](Index, Index) { return false; }));
}

}  // namespace palpate::mesh

#include "palpate/mesh/repair.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/mesh/validate.h"
#include "palpate/mesh/winding.h"
#include "support/mesh_zoo.h"

namespace palpate::mesh {

// --- the judge: written without topology.h ---

using Edge = std::pair<Index, Index>;

/// Every undirected edge has one triangle, or two that run along it in opposite directions.
bool everyEdgeHasAtMostOneNeighbour(const TriangleMesh& mesh) {
  std::map<Edge, int> directed;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (++directed[{t[i], t[(i + 1) % 3]}] > 1) return false;
    }
  }
  return true;  // no directed edge twice: at most one triangle each way
}

/// Walking from triangle to triangle across the edges at a vertex reaches all of its triangles.
bool everyVertexHasOneFan(const TriangleMesh& mesh) {
  std::map<Index, std::vector<Triangle>> around;
  for (const Triangle& t : mesh.triangles) {
    for (Index v : t) around[v].push_back(t);
  }
  for (const auto& entry : around) {
    const std::vector<Triangle>& triangles = entry.second;
    std::set<std::size_t> reached = {0};
    for (bool grew = true; grew;) {
      grew = false;
      for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (reached.contains(i)) continue;
        for (std::size_t j : std::set<std::size_t>(reached)) {
          const auto shared = std::count_if(triangles[i].begin(), triangles[i].end(), [&, j](Index v) {
            return std::count(triangles[j].begin(), triangles[j].end(), v) > 0;
          });
          if (shared >= 2) grew |= reached.insert(i).second;
        }
      }
    }
    if (reached.size() != triangles.size()) return false;
  }
  return true;
}

void expectFit(const RepairResult& result, const std::string& name) {
  const TriangleMesh& mesh = result.mesh;
  EXPECT_TRUE(everyEdgeHasAtMostOneNeighbour(mesh)) << name;
  EXPECT_TRUE(everyVertexHasOneFan(mesh)) << name;
  EXPECT_EQ(result.source_vertex.size(), mesh.positions.size()) << name;
  std::set<Index> used;
  for (const Triangle& t : mesh.triangles) used.insert(t.begin(), t.end());
  EXPECT_EQ(used.size(), mesh.positions.size()) << name << ": unused vertices";
  const auto report = validate(mesh);
  EXPECT_TRUE(report.fit()) << name << ": " << (describe(report).empty() ? "" : describe(report)[0]);
  EXPECT_EQ(report.closed, result.closed) << name;
  EXPECT_EQ(report.components, result.components) << name;
}

std::size_t actionCount(const RepairResult& result, const std::string& words) {
  for (const auto& action : result.actions) {
    if (action.what.find(words) != std::string::npos) return action.count;
  }
  return 0;
}

// --- the zoo ---

TEST(Repair, MakesEverySpecimenFit) {
  for (const auto& [name, mesh] : zoo::specimens()) expectFit(repair(mesh), name);
}

TEST(Repair, ChangesNothingTheSecondTime) {
  for (const auto& [name, mesh] : zoo::specimens()) {
    const auto once = repair(mesh, {.weld = false});
    const auto twice = repair(once.mesh, {.weld = false});
    EXPECT_EQ(twice.mesh.triangles, once.mesh.triangles) << name;
    EXPECT_EQ(twice.mesh.positions, once.mesh.positions) << name;
    EXPECT_TRUE(twice.actions.empty()) << name << ": " << twice.actions[0].what;
  }
}

TEST(Repair, LeavesASoundMeshAlone) {
  for (const auto& mesh :
       {zoo::cube(), zoo::sphere(), zoo::torus(), zoo::grid(), zoo::openTube(), zoo::hollowSphere()}) {
    const auto result = repair(mesh);
    EXPECT_TRUE(result.actions.empty());
    EXPECT_EQ(result.mesh.triangles, mesh.triangles);
    EXPECT_EQ(result.mesh.positions, mesh.positions);
    for (Index v = 0; v < result.source_vertex.size(); ++v) EXPECT_EQ(result.source_vertex[v], v);
  }
}

TEST(Repair, SourceVerticesLieWhereTheirCopiesAre) {
  for (const auto& mesh : {zoo::cubesSharingAVertex(), zoo::cubeWithUnusedVertices(), zoo::soup(zoo::cube()),
                           zoo::cubeWithNonFiniteVertices()}) {
    const auto result = repair(mesh);
    for (std::size_t v = 0; v < result.source_vertex.size(); ++v) {
      EXPECT_EQ(result.mesh.positions[v], mesh.positions[result.source_vertex[v]]);
    }
  }
}

TEST(Repair, ThrowsWhenNothingIsLeftToFeel) {
  EXPECT_THROW(repair(zoo::empty()), Error);
  EXPECT_THROW(repair({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}), Error);
  EXPECT_THROW(repair({{{0, 0, 0}}, {{0, 0, 0}, {0, 1, 2}}}), Error);
}

// --- trait by trait ---

TEST(Repair, CubesSharingAnEdgeAreJoinedOnTheirFrontSides) {
  const auto result = repair(zoo::cubesSharingAnEdge());
  EXPECT_EQ(actionCount(result, "more than two triangles"), 1u);
  // The empty sectors lie between the cubes, so the surface leads from one cube to the other through the edge, twice.
  EXPECT_EQ(result.components, 1u);
  EXPECT_TRUE(result.closed);
  EXPECT_NEAR(signedVolume(result.mesh), 2000.0, 1e-9);
  // Both ways use the same two vertices: one of them gets a middle, which cuts its two triangles.
  EXPECT_EQ(actionCount(result, "split in the middle"), 1u);
  EXPECT_EQ(result.mesh.triangles.size(), 26u);
  EXPECT_EQ(result.mesh.positions.back(), Vec3(10, 10, 5));
}

TEST(Repair, CubesSharingAnEdgeAreJoinedWhereverTheyLieAndHoweverManyThereAre) {
  TriangleMesh both = zoo::cubesSharingAnEdge();
  TriangleMesh far = both;
  for (Vec3& place : far.positions) place += Vec3(700, -300, 900);
  append(far, both);
  const auto result = repair(both);
  EXPECT_EQ(actionCount(result, "split in the middle"), 2u);
  EXPECT_EQ(result.components, 2u);
  EXPECT_TRUE(result.closed);
  EXPECT_NEAR(signedVolume(result.mesh), 4000.0, 1e-6);
  EXPECT_EQ(result.mesh.triangles.size(), 52u);
}

TEST(Repair, CubesSharingAVertexGetOneEach) {
  const auto result = repair(zoo::cubesSharingAVertex());
  EXPECT_EQ(result.mesh.positions.size(), 16u);
  EXPECT_EQ(result.components, 2u);
  EXPECT_TRUE(result.closed);
}

TEST(Repair, AMoebiusStripIsCutOpenAlongASeam) {
  const auto result = repair(zoo::moebius());
  EXPECT_EQ(result.components, 1u);
  EXPECT_GE(actionCount(result, "seam"), 1u);
  EXPECT_EQ(result.mesh.triangles.size(), zoo::moebius().triangles.size());
}

TEST(Repair, FlatSliversAreSewnWithoutASlit) {
  const auto result = repair(zoo::cubeWithCap());
  EXPECT_TRUE(result.closed);
  EXPECT_EQ(actionCount(result, "sewn"), 1u);
  EXPECT_EQ(result.mesh.triangles.size(), 14u);
  const auto folded = repair(zoo::plateWithFoldedSliver());
  EXPECT_EQ(validate(folded.mesh).border_edges.count, 4u);
  for (const Triangle& t : folded.mesh.triangles) {
    const auto& p = folded.mesh.positions;
    EXPECT_GT(areaVector2(p[t[0]], p[t[1]], p[t[2]]).z(), 1.0);
  }
}

TEST(Repair, NeedlesCollapseWithoutASlit) {
  const auto result = repair(zoo::cubeWithNeedles(), {.weld = false});
  EXPECT_TRUE(result.closed);
  EXPECT_EQ(actionCount(result, "collapsed"), 2u);
  EXPECT_EQ(result.mesh.positions.size(), 8u);
}

TEST(Repair, FinsGoAndTheBodyStays) {
  const auto result = repair(zoo::cubeWithFin());
  EXPECT_EQ(actionCount(result, "fins"), 2u);
  EXPECT_EQ(result.mesh.triangles.size(), 12u);
  EXPECT_TRUE(result.closed);
}

TEST(Repair, ASheetGivenFromBothSidesKeepsOne) {
  const auto result = repair(zoo::doubleSidedGrid(4));
  EXPECT_EQ(result.mesh.triangles.size(), 32u);
  EXPECT_EQ(actionCount(result, "one side kept"), 32u);
}

TEST(Repair, APatchGivenFromBothSidesStillFillsItsHole) {
  auto mesh = zoo::sphere(20, 2);
  for (std::size_t t : {0u, 1u, 40u}) {
    const Triangle twin = mesh.triangles[t];
    mesh.triangles.push_back({twin[0], twin[2], twin[1]});
  }
  const auto result = repair(mesh);
  EXPECT_TRUE(result.closed);
  EXPECT_EQ(result.mesh.triangles.size(), 320u);
}

TEST(Repair, DuplicatesGo) {
  const auto result = repair(zoo::cubeWithDuplicates());
  EXPECT_EQ(actionCount(result, "duplicate"), 3u);
  EXPECT_TRUE(result.closed);
}

TEST(Repair, WindingFollowsTheMajorityAndClosedPartsFaceOutwards) {
  const auto mixed = repair(zoo::mixedWinding());
  EXPECT_GT(actionCount(mixed, "flipped"), 100u);
  EXPECT_GT(signedVolume(mixed.mesh), 0.0);
  const auto inside_out = repair(zoo::insideOut());
  EXPECT_EQ(actionCount(inside_out, "outside out"), 1u);
  EXPECT_GT(signedVolume(inside_out.mesh), 0.0);
}

/// The sphere of 20 mm without what lies above `height` mm; inside out.
TriangleMesh insideOutBowl(double height) {
  TriangleMesh mesh = zoo::sphere(20.0, 4);
  std::erase_if(mesh.triangles, [&](const Triangle& t) { return centreOf(mesh, t).z() > height; });
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TEST(Repair, OpenBodiesFaceOutwardsToo) {
  const auto result = repair(insideOutBowl(14.0));
  EXPECT_EQ(actionCount(result, "open parts turned outside out"), 1u);
  EXPECT_FALSE(result.closed);
  EXPECT_GT(signedVolume(result.mesh), 0.0);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_TRUE(repair(result.mesh).actions.empty()) << "once is enough";
  EXPECT_TRUE(repair(insideOutBowl(14.0), {.orient_outwards = false}).actions.size() <= 1);
  EXPECT_FALSE(validate(insideOutBowl(14.0)).fit());
}

TEST(Repair, ABowlThatMayBeInsideOutIsReportedAndASheetIsNot) {
  const auto bowl = repair(insideOutBowl(0.0));
  EXPECT_EQ(actionCount(bowl, "turned outside out"), 0u);
  ASSERT_EQ(bowl.warnings.size(), 1u);
  EXPECT_NE(bowl.warnings[0].find("may be inside out"), std::string::npos);
  EXPECT_EQ(validate(insideOutBowl(0.0)).doubtful_parts.count, 1u);
  TriangleMesh sheet = zoo::wavyGrid(20, 100.0, 12.0);
  for (int side = 0; side < 2; ++side) {
    const auto result = repair(sheet);
    EXPECT_EQ(actionCount(result, "turned outside out"), 0u);
    EXPECT_TRUE(result.warnings.empty());
    for (Triangle& t : sheet.triangles) std::swap(t[1], t[2]);
  }
}

TEST(Repair, WhatMayBeInsideOutIsTurnedWhereThatIsAsked) {
  const auto bowl = repair(insideOutBowl(0.0), {.turn_over = TurnOver::doubtful});
  EXPECT_EQ(actionCount(bowl, "turned over as asked"), 1u);
  EXPECT_TRUE(bowl.warnings.empty());
  EXPECT_EQ(validate(bowl.mesh).doubtful_parts.count, 0u);
  EXPECT_EQ(actionCount(repair(bowl.mesh, {.turn_over = TurnOver::doubtful}), "turned over as asked"), 0u)
      << "once is enough";
  const TriangleMesh sheet = zoo::wavyGrid(20, 100.0, 12.0);
  EXPECT_EQ(actionCount(repair(sheet, {.turn_over = TurnOver::doubtful}), "turned over as asked"), 0u)
      << "a sheet is as given";
  const auto turned = repair(sheet, {.turn_over = TurnOver::open});
  ASSERT_EQ(actionCount(turned, "turned over as asked"), 1u);
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    EXPECT_LT(areaVector2(turned.mesh.positions[turned.mesh.triangles[t][0]],
                          turned.mesh.positions[turned.mesh.triangles[t][1]],
                          turned.mesh.positions[turned.mesh.triangles[t][2]])
                  .z(),
              0.0);
  }
}

TEST(Repair, APartAmongOthersThatIsInsideOutIsTold) {
  TriangleMesh mesh = zoo::sphere(20.0, 3);
  TriangleMesh other = zoo::insideOut();
  for (Vec3& position : other.positions) position.x() += 60.0;
  const std::size_t first = mesh.triangles.size();
  append(other, mesh);
  EXPECT_EQ(validate(mesh).inside_out_parts.count, 1u) << "the whole encloses more than nothing all the same";
  EXPECT_EQ(validate(mesh).inside_out_parts.first.at(0), first);
  EXPECT_FALSE(validate(mesh).sound());
  EXPECT_EQ(validate(repair(mesh).mesh).inside_out_parts.count, 0u);
  TriangleMesh hollow = zoo::sphere(40.0, 3);
  append(zoo::insideOut(), hollow);
  EXPECT_EQ(validate(hollow).inside_out_parts.count, 0u) << "the wall of a hollow";
}

TEST(Repair, TheOpenWallOfAHollowKeepsFacingIn) {
  TriangleMesh mesh = zoo::sphere(40.0, 3);
  append(insideOutBowl(14.0), mesh);
  EXPECT_EQ(actionCount(repair(mesh), "turned outside out"), 0u);
}

/// Two cubes of 10 mm beside each other, `gap_mm` apart.
TriangleMesh cubesBesideEachOther(double gap_mm) {
  TriangleMesh mesh = zoo::cube(10.0, {0, 0, 0});
  append(zoo::cube(10.0, {10.0 + gap_mm, 0, 0}), mesh);
  return mesh;
}

TEST(Repair, PartsBesideEachOtherBecomeOneAcrossAHairline) {
  for (const double gap_mm : {0.0, 1e-9, 1e-6, 1e-3}) {
    TriangleMesh mesh = cubesBesideEachOther(0.0);
    for (std::size_t v = 8; v < mesh.positions.size(); ++v) mesh.positions[v].x() += gap_mm;
    const auto result = repair(mesh);
    EXPECT_TRUE(result.closed) << gap_mm;
    EXPECT_EQ(result.components, 1u) << gap_mm;
    EXPECT_EQ(result.mesh.triangles.size(), 20u) << gap_mm << ": the two walls between them are gone";
    EXPECT_NEAR(signedVolume(result.mesh), 2000.0, 0.2) << gap_mm;
  }
  TriangleMesh cut_otherwise = cubesBesideEachOther(1e-3);  // the wall at x = 10 along its other diagonal
  std::vector<Triangle*> wall;
  for (Triangle& t : cut_otherwise.triangles) {
    if (std::all_of(t.begin(), t.end(), [&](Index v) { return cut_otherwise.positions[v].x() == 10.0; }))
      wall.push_back(&t);
  }
  ASSERT_EQ(wall.size(), 2u);
  const Triangle one = *wall[0], other = *wall[1];  // (a, b, c), (a, c, d)
  *wall[0] = {one[0], one[1], other[2]};
  *wall[1] = {one[1], one[2], other[2]};
  EXPECT_EQ(repair(cut_otherwise).mesh.triangles.size(), 20u);
  EXPECT_TRUE(repair(cut_otherwise).closed);
  const auto apart = repair(cubesBesideEachOther(0.01));
  EXPECT_EQ(apart.components, 2u) << "5e-4 of the diagonal is a gap";
  EXPECT_EQ(apart.mesh.triangles.size(), 24u);
}

TEST(Repair, TheWallOfAHollowKeepsFacingIn) {
  const auto result = repair(zoo::hollowSphere());
  EXPECT_TRUE(result.actions.empty());
  EXPECT_EQ(result.components, 2u);
  EXPECT_NEAR(signedVolume(result.mesh), signedVolume(zoo::sphere(20, 2)) - signedVolume(zoo::sphere(12, 2)), 1e-6);
}

TEST(Repair, SelfIntersectionIsFlaggedAndLeft) {
  const auto result = repair(zoo::overlappingSpheres());
  EXPECT_TRUE(result.self_intersecting);
  EXPECT_EQ(result.mesh.triangles, zoo::overlappingSpheres().triangles);
  EXPECT_FALSE(repair(zoo::sphere()).self_intersecting);
}

TEST(Repair, WeldingJoinsASoupAndCanReachAcrossGaps) {
  auto soup = zoo::soup(zoo::cube());
  EXPECT_EQ(repair(soup).mesh.positions.size(), 8u);
  EXPECT_FALSE(repair(soup, {.weld = false}).closed);
  for (Index v = 0; v < soup.positions.size(); ++v) soup.positions[v].x() += 1e-4 * (v % 3);
  EXPECT_FALSE(repair(soup).closed);
  EXPECT_TRUE(repair(soup, {.weld_distance_mm = 0.01}).closed);
}

// --- any triangles at all ---

RC_GTEST_PROP(RepairProperty, AnyTrianglesBecomeFit, ()) {
  const auto vertices = *rc::gen::inRange<std::size_t>(3, 12);
  const auto count = *rc::gen::inRange<std::size_t>(1, 40);
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  TriangleMesh mesh;
  // Coordinates on a small lattice: equal vertices, flat triangles and crossing faces are frequent.
  for (std::size_t v = 0; v < vertices; ++v) {
    mesh.positions.emplace_back(random.below(4), random.below(4), random.below(4));
  }
  for (std::size_t t = 0; t < count; ++t) {
    const auto corner = [&] { return static_cast<Index>(random.below(vertices)); };
    mesh.triangles.push_back({corner(), corner(), corner()});
  }
  try {
    const auto result = repair(mesh);
    RC_ASSERT(everyEdgeHasAtMostOneNeighbour(result.mesh));
    RC_ASSERT(everyVertexHasOneFan(result.mesh));
    const auto report = validate(result.mesh);
    RC_ASSERT(report.zero_area_triangles.count == 0u);
    RC_ASSERT(report.inconsistent_edges.count == 0u);
    RC_ASSERT(report.non_manifold_vertices.count == 0u);
  } catch (const Error&) {
    // Nothing was left to feel.
  }
}

}  // namespace palpate::mesh

// The bounds of the tree's plates, against brute force: what they leave out must hold nothing.
#include "palpate/tree/triangle_tree.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <set>

#include "lab/workloads/heldout_meshes.h"
#include "lab/workloads/workload_meshes.h"
#include "palpate/base/random.h"
#include "support/mesh_zoo.h"

namespace palpate::tree {

namespace {

/// Smooth and faceted, convex and hollow, closed and open, flat, folded, and some that no repair has touched.
std::vector<mesh::TriangleMesh> judgedMeshes() {
  return {lab::backMesh(2962),
          lab::grooveMesh(60.0),
          lab::pitMesh(),
          zoo::cube(),
          zoo::sphere(),
          zoo::hollowSphere(),
          zoo::torus(),
          zoo::wavyGrid(),
          zoo::openTube(),
          zoo::moebius(),
          zoo::cubeWithNeedles(),
          zoo::plateWithFoldedSliver(),
          zoo::coincidentTriangles(),
          zoo::doubleSidedGrid(),
          zoo::mixedWinding(),
          lab::heldoutMesh("ball")};
}

const std::vector<TriangleTree>& judgedTrees() {
  static const std::vector<TriangleTree> trees = [] {
    std::vector<TriangleTree> all;
    for (const mesh::TriangleMesh& mesh : judgedMeshes()) all.push_back(buildTriangleTree(mesh));
    return all;
  }();
  return trees;
}

/// Records at each vertex.
std::vector<std::vector<Index>> trianglesOfVertices(const TriangleTree& tree) {
  std::vector<std::vector<Index>> triangles;
  for (Index t = 0; t < tree.records.size(); ++t) {
    for (const Index v : tree.records[t].vertices) {
      if (v >= triangles.size()) triangles.resize(v + 1);
      triangles[v].push_back(t);
    }
  }
  return triangles;
}

/// Whether no triangle that has the place leads nearer to the point, and all of them have the point in front.
bool isMinimumInFront(const TriangleTree& tree, const std::vector<std::vector<Index>>& triangles_of, Index triangle,
                      const ClosestOnTriangle& place, const Vec3& point) {
  for (const Index v : tree.records[triangle].vertices) {
    for (const Index t : triangles_of[v]) {
      const auto& corners = tree.records[t].corners;
      const double rounding = 1e-12 * tree.diagonal;
      const bool has_place = closestOnTriangle(corners, place.point).squared_distance <= rounding * rounding;
      if (!has_place) continue;
      if (closestOnTriangle(corners, point).squared_distance < place.squared_distance * (1.0 - 1e-12)) return false;
      const Vec3 normal = mesh::areaVector2(corners[0], corners[1], corners[2]);
      if (normal.dot(point - place.point) < 0.0) return false;
    }
  }
  return true;
}

/// Mostly near the surface, at all distances; sometimes far away.
Vec3 randomPlace(const TriangleTree& tree, Random& random) {
  const TriangleRecord& record = tree.records[random.below(tree.records.size())];
  const double reach = tree.diagonal * std::pow(10.0, random.uniform(-5.0, random.uniform() < 0.1 ? 3.0 : 0.0));
  const Vec3 away = random.uniform3(-1, 1);
  return record.corners[random.below(3)] + reach * away;
}

}  // namespace

RC_GTEST_PROP(NodePlates, NearestPointIsThatOfAllTriangles, ()) {
  const TriangleTree& tree = judgedTrees()[*rc::gen::inRange<std::size_t>(0, judgedTrees().size())];
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const Vec3 point = randomPlace(tree, random);
  double best = INFINITY;
  for (const TriangleRecord& record : tree.records) {
    best = std::min(best, closestOnTriangle(record.corners, point).squared_distance);
  }
  RC_ASSERT(nearestPoint(tree, point, 1e4 * tree.diagonal).closest.squared_distance == best);
}

RC_GTEST_PROP(NodePlates, NoMinimumInFrontIsLeftOut, ()) {
  const TriangleTree& tree = judgedTrees()[*rc::gen::inRange<std::size_t>(0, judgedTrees().size())];
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const auto triangles_of = trianglesOfVertices(tree);
  const Vec3 point = randomPlace(tree, random);
  const double limit = std::pow((point - tree.center).norm() + tree.diagonal, 2) * random.uniform();
  std::set<Index> visited;
  visitNearMinima(tree, point, limit, [&](Index t, const ClosestOnTriangle&) {
    visited.insert(t);
    return limit;
  });
  for (Index t = 0; t < tree.records.size(); ++t) {
    const ClosestOnTriangle closest = closestOnTriangle(tree.records[t].corners, point);
    if (!(closest.squared_distance < limit) || !(closest.squared_distance > 0.0)) continue;
    if (isMinimumInFront(tree, triangles_of, t, closest, point)) RC_ASSERT(visited.count(t) == 1);
  }
}

// What they are for: over a dense smooth skin only a handful of triangles is as near as the nearest.
TEST(NodePlates, LeaveFewTrianglesOfASmoothSkin) {
  const TriangleTree tree = buildTriangleTree(lab::backMesh(200000));
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const double x = random.uniform(60, 290), y = random.uniform(60, 340);
    const Vec3 point(x, y, lab::backHeight(x, y) + 8.0);
    const double distance = std::sqrt(nearestPoint(tree, point, 20.0).closest.squared_distance);
    int tested = 0, minima = 0;
    const double limit = std::pow(distance * 1.02, 2);
    detail::visitNearestFirst(tree, point, limit, squaredDistanceBounds, [&](Index, const auto&) {
      ++tested;
      return limit;
    });
    visitNearMinima(tree, point, limit, [&](Index, const auto&) {
      ++minima;
      return limit;
    });
    EXPECT_GE(minima, 1);
    EXPECT_LE(minima, tested);
    EXPECT_LE(minima, 120) << tested;
  }
}

TEST(NodePlates, DoNotExcludeAnythingAtABorder) {
  const TriangleTree tree = buildTriangleTree(zoo::oneTriangle());
  const Vec3 aside = tree.records[0].corners[0] + Vec3(-1.0, -2.0, 0.5);
  int visited = 0;
  visitNearMinima(tree, aside, 1e6, [&](Index, const auto&) {
    ++visited;
    return 1e6;
  });
  EXPECT_EQ(visited, 1);
}

}  // namespace palpate::tree

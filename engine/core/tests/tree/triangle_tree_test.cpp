#include "palpate/tree/triangle_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

#include "lab/workloads/workload_meshes.h"
#include "palpate/base/environment.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/tree/exact_predicates.h"
#include "support/mesh_zoo.h"

namespace palpate::tree {

namespace {

Vec3 randomPoint(Random& random, double reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

/// Triangles of all sizes and shapes without any order, slivers and points among them.
mesh::TriangleMesh soup(std::uint64_t seed, int triangles) {
  Random random(seed);
  mesh::TriangleMesh mesh;
  for (int t = 0; t < triangles; ++t) {
    const Vec3 place = randomPoint(random, 100.0);
    const double size = std::pow(10.0, random.uniform(-3.0, 1.5));
    for (int i = 0; i < 3; ++i) mesh.positions.push_back(place + randomPoint(random, size));
    const auto first = static_cast<Index>(3 * t);
    if (t % 17 == 0) mesh.positions[first + 2] = 0.5 * (mesh.positions[first] + mesh.positions[first + 1]);
    if (t % 31 == 0) mesh.positions[first + 1] = mesh.positions[first + 2] = mesh.positions[first];
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

double bruteDistance2(const mesh::TriangleMesh& mesh, const Vec3& point) {
  double best = INFINITY;
  for (const auto& [a, b, c] : mesh.triangles) {
    best = std::min(
        best, closestOnTriangle({mesh.positions[a], mesh.positions[b], mesh.positions[c]}, point).squared_distance);
  }
  return best;
}

void scale(mesh::TriangleMesh& mesh, double factor, const Vec3& shift) {
  for (Vec3& p : mesh.positions) p = p * factor + shift;
}

TriangleTree builtBy(const mesh::TriangleMesh& mesh, std::size_t (*threads)()) {
  const Environment before = environment();
  Environment own = before;
  own.processors = threads;
  useEnvironment(own);
  TriangleTree tree = buildTriangleTree(mesh);
  useEnvironment(before);
  return tree;
}

template <class Items>
bool sameBytes(const Items& a, const Items& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

}  // namespace

TEST(ClosestOnTriangle, AgreesWithFineSampling) {
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const std::array<Vec3, 3> corners = {randomPoint(random, 1), randomPoint(random, 1), randomPoint(random, 1)};
    const Vec3 point = randomPoint(random, 2);
    const ClosestOnTriangle closest = closestOnTriangle(corners, point);
    const Vec3 weights = barycentricWeights(corners, closest.point);
    EXPECT_NEAR((weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2] - closest.point).norm(), 0,
                1e-9);
    constexpr int kSteps = 60;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        const double v = static_cast<double>(i) / kSteps, w = static_cast<double>(j) / kSteps;
        const Vec3 sample = corners[0] + v * (corners[1] - corners[0]) + w * (corners[2] - corners[0]);
        ASSERT_GE((sample - point).squaredNorm(), closest.squared_distance - 1e-12);
      }
    }
  }
}

TEST(ClosestOnTriangle, NamesTheFeature) {
  const std::array<Vec3, 3> corners = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  EXPECT_EQ(closestOnTriangle(corners, {1, 1, 3}).feature, Feature::face);
  EXPECT_EQ(closestOnTriangle(corners, {2, -1, 1}).feature, Feature::edge0);
  EXPECT_EQ(closestOnTriangle(corners, {3, 3, 1}).feature, Feature::edge1);
  EXPECT_EQ(closestOnTriangle(corners, {-1, 2, 1}).feature, Feature::edge2);
  EXPECT_EQ(closestOnTriangle(corners, {-1, -1, 1}).feature, Feature::corner0);
  EXPECT_EQ(closestOnTriangle(corners, {6, -1, 1}).feature, Feature::corner1);
  EXPECT_EQ(closestOnTriangle(corners, {-1, 6, 1}).feature, Feature::corner2);
}

TEST(ClosestOnTriangle, ServesTrianglesWithoutArea) {
  const std::array<Vec3, 3> line = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0)};
  EXPECT_NEAR((closestOnTriangle(line, {2, 1, 0}).point - Vec3(2, 0, 0)).norm(), 0, 1e-15);
  const std::array<Vec3, 3> dot = {Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)};
  EXPECT_EQ(closestOnTriangle(dot, {2, 1, 0}).point, Vec3(1, 1, 1));
  EXPECT_NEAR(barycentricWeights(dot, {1, 1, 1}).sum(), 1.0, 1e-15);
}

TEST(TriangleTree, HoldsEveryTriangleOnce) {
  const auto mesh = soup(5, 3000);
  const TriangleTree tree = buildTriangleTree(mesh);
  const std::set<Index> all(tree.source_triangle.begin(), tree.source_triangle.end());
  EXPECT_EQ(all.size(), mesh.triangles.size());
  for (Index r = 0; r < tree.records.size(); ++r) {
    EXPECT_EQ(tree.records[r].vertices, mesh.triangles[tree.source_triangle[r]]);
  }
}

TEST(TriangleTree, NearestPointAgreesWithBruteForceAtEveryScaleAndPlace) {
  for (const double factor : {1e-3, 1.0, 1e3, 1e-20, 1e20}) {
    auto mesh = soup(6, 700);
    const Vec3 shift = factor * Vec3(5000.0, -3000.0, 1000.0);
    scale(mesh, factor, shift);
    const TriangleTree tree = buildTriangleTree(mesh);
    Random random(7);
    for (int i = 0; i < 300; ++i) {
      const Vec3 point = factor * randomPoint(random, 150.0) + shift;
      const NearestPoint nearest = nearestPoint(tree, point, 1e4 * factor);
      ASSERT_NE(nearest.triangle, kNoIndex);
      EXPECT_EQ(nearest.closest.squared_distance, bruteDistance2(mesh, point));
    }
  }
}

TEST(TriangleTree, NearestPointKeepsToTheMaximumDistance) {
  const auto mesh = soup(8, 500);
  const TriangleTree tree = buildTriangleTree(mesh);
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    const Vec3 point = randomPoint(random, 120.0);
    const double distance = std::sqrt(bruteDistance2(mesh, point));
    EXPECT_EQ(nearestPoint(tree, point, distance * 0.999).triangle, kNoIndex);
    EXPECT_NE(nearestPoint(tree, point, distance * 1.001).triangle, kNoIndex);
  }
}

TEST(TriangleTree, VisitsEveryTriangleWithinTheRadius) {
  const auto mesh = soup(10, 2000);
  const TriangleTree tree = buildTriangleTree(mesh);
  Random random(11);
  for (int i = 0; i < 100; ++i) {
    const Vec3 point = randomPoint(random, 100.0);
    const double radius = random.uniform(1.0, 60.0);
    std::set<Index> visited, expected;
    visitNearTriangles(tree, point, radius * radius, [&](Index record, const ClosestOnTriangle&) {
      visited.insert(tree.source_triangle[record]);
      return radius * radius;
    });
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const double d2 =
          closestOnTriangle({mesh.positions[a], mesh.positions[b], mesh.positions[c]}, point).squared_distance;
      if (d2 < radius * radius) expected.insert(t);
    }
    EXPECT_EQ(visited, expected);
  }
}

TEST(TriangleTree, FirstCrossingAgreesWithBruteForce) {
  for (const double factor : {1e-3, 1.0, 1e3}) {
    auto mesh = soup(12, 3000);
    scale(mesh, factor, Vec3::Zero());
    const TriangleTree tree = buildTriangleTree(mesh);
    Random random(13);
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec3 from = factor * randomPoint(random, 120.0);
      const Vec3 to =
          i % 2 == 0 ? Vec3(factor * randomPoint(random, 120.0)) : Vec3(from + factor * randomPoint(random, 20.0));
      const Crossing crossing = firstFrontCrossing(tree, from, to);
      bool any = false;
      double first = 2.0;
      for (Index t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const Vec3 &pa = mesh.positions[a], &pb = mesh.positions[b], &pc = mesh.positions[c];
        if (!crossesFrontToBack(pa, pb, pc, from, to)) continue;
        any = true;
        const Vec3 n = (pb - pa).cross(pc - pa);
        first = std::min(first, n.dot(from - pa) / n.dot(from - to));
      }
      ASSERT_EQ(crossing.triangle != kNoIndex, any);
      if (any) {
        EXPECT_NEAR(crossing.fraction, first, 1e-9);
        ++hits;
      }
    }
    EXPECT_GT(hits, 30);
  }
}

TEST(TriangleTree, CoincidentTrianglesDoNotNestWithoutEnd) {
  mesh::TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
  mesh.triangles.assign(5000, {0, 1, 2});
  const TriangleTree tree = buildTriangleTree(mesh);
  EXPECT_NEAR(std::sqrt(nearestPoint(tree, {0.2, 0.2, 3.0}, 10.0).closest.squared_distance), 3.0, 1e-15);
  EXPECT_EQ(firstFrontCrossing(tree, {0.2, 0.2, 1}, {0.2, 0.2, -1}).triangle, 0u) << "the lowest record wins";
}

TEST(TriangleTree, OneTriangleAndOnePointWork) {
  const mesh::TriangleMesh one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(nearestPoint(buildTriangleTree(one), {0.2, 0.2, 1}, 2.0).closest.point, Vec3(0.2, 0.2, 0));
  const mesh::TriangleMesh dot{{{3, 0, 0}}, {{0, 0, 0}}};
  EXPECT_EQ(nearestPoint(buildTriangleTree(dot), {4, 0, 0}, 2.0).closest.point, Vec3(3, 0, 0));
}

TEST(TriangleTree, IsTheSameHoweverManyThreadsBuildIt) {
  const mesh::TriangleMesh back = lab::backMesh(100'000);
  const TriangleTree by_one = builtBy(back, [] { return std::size_t{1}; });
  const TriangleTree by_five = builtBy(back, [] { return std::size_t{5}; });
  EXPECT_TRUE(sameBytes(by_one.nodes, by_five.nodes));
  EXPECT_TRUE(sameBytes(by_one.records, by_five.records));
  EXPECT_TRUE(sameBytes(by_one.source_triangle, by_five.source_triangle));
  EXPECT_TRUE(sameBytes(by_one.far_plates, by_five.far_plates));
  EXPECT_EQ(by_one.first_far_plate, by_five.first_far_plate);
}

TEST(TriangleTree, RefusesWhatItCannotHold) {
  EXPECT_THROW(buildTriangleTree({}), Error);
  EXPECT_THROW(buildTriangleTree({{{0, 0, 0}}, {{0, 0, 1}}}), Error);
  EXPECT_THROW(buildTriangleTree({{{0, 0, 0}, {1, 0, NAN}, {0, 1, 0}}, {{0, 1, 2}}}), Error);
}

TEST(TriangleTree, FitsItsMemoryBudget) {
  const TriangleTree tree = buildTriangleTree(lab::backMesh(41582));
  const double bytes =
      static_cast<double>(tree.nodes.capacity() * sizeof(WideNode) + tree.records.capacity() * sizeof(TriangleRecord) +
                          tree.source_triangle.capacity() * sizeof(Index));
  EXPECT_LE(bytes / static_cast<double>(tree.records.size()), 130.0);
}

// Segments of +-1 mm aimed exactly at vertices and at points on edges, from random directions: not one may slip
// through, nor one that stops exactly on the surface and then goes on.
TEST(TriangleTree, SegmentsAimedAtVerticesAndEdgesNeverMiss) {
  for (const double factor : {1e-3, 1.0, 1e3}) {
    mesh::TriangleMesh mesh = lab::backMesh(41582);
    scale(mesh, factor, Vec3::Zero());
    const TriangleTree tree = buildTriangleTree(mesh);
    Random random(14);
    int aimed = 0, misses = 0, misses_after_stop = 0;
    for (int i = 0; i < 70000; ++i) {
      const TriangleRecord& record = tree.records[random.below(tree.records.size())];
      if (record.neighbours[0] == kNoIndex || record.neighbours[1] == kNoIndex || record.neighbours[2] == kNoIndex) {
        continue;  // the border may be missed rightly
      }
      Vec3 aim = record.corners[0];
      if (i % 2 == 0) aim += random.uniform() * (record.corners[1] - record.corners[0]);
      const Vec3 direction = factor * (Vec3(0, 0, 1) + randomPoint(random, 0.2));
      if (aim.x() < 5 * factor || aim.x() > 345 * factor || aim.y() < 5 * factor || aim.y() > 395 * factor) continue;
      ++aimed;
      misses += firstFrontCrossing(tree, aim + direction, aim - direction).triangle == kNoIndex ? 1 : 0;
      const bool in_two_moves = firstFrontCrossing(tree, aim + direction, aim).triangle != kNoIndex ||
                                firstFrontCrossing(tree, aim, aim - direction).triangle != kNoIndex;
      misses_after_stop += in_two_moves ? 0 : 1;
    }
    EXPECT_GT(aimed, 60000);
    EXPECT_EQ(misses, 0) << "scale " << factor;
    EXPECT_EQ(misses_after_stop, 0) << "scale " << factor;
  }
}

}  // namespace palpate::tree

// A million triangles: everything stays linear, and the times are printed to be seen.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "palpate/base/stopwatch.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/reorder.h"
#include "palpate/mesh/repair.h"
#include "palpate/mesh/topology.h"
#include "palpate/mesh/validate.h"
#include "support/mesh_bytes.h"
#include "support/mesh_zoo.h"

namespace palpate::mesh {

/// Wide enough for a slow and busy machine, a hundred times too narrow for anything quadratic.
constexpr double kPatienceSeconds = 60.0;

template <class Action>
auto timed(const char* what, const Action& action) {
  const auto start = Clock::now();
  auto result = action();
  const double seconds = secondsSince(start);
  std::printf("  %-24s %6.2f s\n", what, seconds);
  EXPECT_LT(seconds, kPatienceSeconds) << what;
  return result;
}

TEST(Size, AMillionTriangles) {
  const TriangleMesh grid = zoo::hugeGrid(1'000'000);
  const std::string stl = support::binaryStlBytes(grid);
  const auto mesh = timed("load and weld STL", [&] { return loadFromMemory(stl, Format::stl, "huge.stl"); });
  EXPECT_EQ(mesh.positions.size(), grid.positions.size());
  timed("adjacency", [&] { return neighboursOfTriangles(mesh); });
  const auto report = timed("validate", [&] { return validate(mesh); });
  EXPECT_TRUE(report.fit());
  EXPECT_TRUE(report.self_intersections_checked);
  EXPECT_EQ(report.border_loops, 1u);
  EXPECT_TRUE(timed("repair", [&] { return repair(mesh); }).actions.empty());
  TriangleMesh ordered = mesh;
  timed("reorder", [&] { return reorderSpatially(ordered); });
}

TEST(Size, ACloudWhereEverythingOverlapsIsGivenUpInTime) {
  // 20,000 long triangles through one point: two hundred million pairs.
  TriangleMesh star;
  for (int i = 0; i < 20'000; ++i) {
    const double a = 0.001 * i;
    const auto first = static_cast<Index>(star.positions.size());
    star.positions.emplace_back(std::cos(a), std::sin(a), std::sin(7 * a));
    star.positions.emplace_back(-std::cos(a), -std::sin(3 * a), std::cos(a));
    star.positions.emplace_back(std::sin(5 * a), std::cos(2 * a), -std::sin(a));
    star.triangles.push_back({first, first + 1, first + 2});
  }
  const auto report = timed("validate a knot", [&] { return validate(star); });
  EXPECT_GT(report.self_intersections.count, 1000u);
  EXPECT_TRUE(repair(star).self_intersecting);
}

}  // namespace palpate::mesh

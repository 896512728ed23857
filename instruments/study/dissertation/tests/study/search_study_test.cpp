// The octree finds what everybody finds, and more than hangs together; models have the counts of Appendix A.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "dissertation/search/search_measurement.h"
#include "lab/measured/model_meshes.h"
#include "palpate/mesh/topology.h"
#include "report/tests/report/says.h"

namespace palpate::study {

TEST(OpenHand, HasTheCountsOfAppendixA) {
  for (const auto& [vertices, triangles, border] : {std::array<std::size_t, 3>{1418, 2818, 16}, {1401, 2786, 14}}) {
    const mesh::TriangleMesh hand = openHandModel(triangles);
    EXPECT_EQ(hand.positions.size(), vertices);
    EXPECT_EQ(hand.triangles.size(), triangles);
    std::size_t open = 0;
    for (const auto& neighbours : mesh::neighboursOfTriangles(hand)) {
      open += static_cast<std::size_t>(std::count(neighbours.begin(), neighbours.end(), kNoIndex));
    }
    EXPECT_EQ(open, border);
    const mesh::IndexRows fans = mesh::trianglesOfVertices(hand);
    for (Index v = 0; v < hand.positions.size(); ++v) EXPECT_FALSE(fans[v].empty()) << v;
  }
}

TEST(SearchStudy, OctreeFindsTheTouchPointAndMissesNoVertex) {
  const SearchMeasurement found = measureSearches(searchPlan(true), {});
  ASSERT_EQ(found.rows.size(), 6u);
  for (const SearchRow& row : found.rows) {
    EXPECT_EQ(row.touch_wrong, 0) << row.model;
    EXPECT_EQ(row.region_missed, 0) << row.model;
    EXPECT_GT(row.region_vertices, 0.0);
    EXPECT_GE(row.region_stray, 0.0);
    if (row.model == "hand") {
      EXPECT_GT(row.region_stray, 0.1 * row.region_vertices) << "other fingers and the far side";
    }
  }
  EXPECT_LT(found.rows[1].touch_tested, found.rows[0].touch_tested) << "smaller leaves, fewer triangles";
}

TEST(SearchVerdicts, FollowTheirNumbers) {
  SearchMeasurement found{.plan = {.backs = {2962}, .thresholds = {16}, .places = 1, .runs = 1}, .rows = {}};
  found.rows.push_back({.model = "back", .threshold = 16});
  found.rows.push_back({.model = "hand", .threshold = 16});
  for (SearchRow& row : found.rows) {
    row.touch_all_us = row.region_all_us = 100.0;
    row.touch_octree_us = row.region_octree_us = 10.0;
    row.touch_ours_us = row.region_rings_us = 5.0;
    row.region_vertices = 50.0;
  }
  EXPECT_TRUE(says(searchFindings(found), "It finds the same point everywhere."));
  EXPECT_TRUE(says(searchFindings(found), "on the hand 0 %. It misses none of ours."));
  EXPECT_TRUE(says(searchFindings(found), "10 to 10 times as fast as testing every triangle"));
  found.rows[0].touch_wrong = 3;
  found.rows[0].touch_octree_us = 20.0;
  found.rows[1].region_stray = 25.0;
  found.rows[1].region_missed = 2;
  EXPECT_TRUE(says(searchFindings(found), "It finds another point at 3 places."));
  EXPECT_TRUE(says(searchFindings(found), "5.0 to 10 times as fast as testing every triangle"));
  EXPECT_TRUE(says(searchFindings(found), "on the hand 50 % (other fingers and the far side"));
  EXPECT_TRUE(says(searchFindings(found), "It misses 2 of ours."));
}

}  // namespace palpate::study

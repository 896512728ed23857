#include "dissertation/cost/complexity.h"

#include <gtest/gtest.h>

#include <iterator>

#include "support/golden.h"

namespace palpate::study {

namespace {

void expectTable(const std::string& key, int arity, const int* heights, const double* printed, std::size_t columns) {
  const nlohmann::json rows = palpate::test::goldenRows("tree_tables", key);
  ASSERT_EQ(rows.size(), columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const nlohmann::json& row = rows[i];
    const WorstSearch search = worstSearch(arity, heights[i]);
    EXPECT_EQ(search.height, row.at("height").get<int>());
    EXPECT_EQ(search.leaves, row.at("leaves").get<double>());
    EXPECT_EQ(search.nodes, row.at("nodes").get<double>());
    EXPECT_EQ(search.visited, row.at("path").get<double>());
    EXPECT_DOUBLE_EQ(search.leaf_ratio, row.at("r").get<double>());
    EXPECT_DOUBLE_EQ(search.visit_ratio, row.at("r_tree").get<double>());
    EXPECT_DOUBLE_EQ(search.w, row.at("w").get<double>());
    EXPECT_EQ(printed[i], row.at("printed_w").get<double>());
    EXPECT_NEAR(heightOfCompleteTree(arity, search.leaves), search.height, 1e-12);
  }
}

}  // namespace

TEST(Complexity, AgreesWithTheGoldenTables) {
  expectTable("bsp", kBspArity, kTable33Heights, kTable33PrintedW, std::size(kTable33Heights));
  expectTable("octree", kOctreeArity, kTable34Heights, kTable34PrintedW, std::size(kTable34Heights));
}

TEST(Complexity, GivesThePrintedCostPerLeaf) {
  const nlohmann::json golden = palpate::test::golden("tree_tables");
  EXPECT_NEAR(visitedPerLeaf(kBspArity, kWorstLeafRatio, 4.02), golden.at("c_bin_over_n").get<double>(), 1e-12);
  EXPECT_NEAR(visitedPerLeaf(kOctreeArity, kWorstLeafRatio, 3.5), golden.at("c_oct_over_n").get<double>(), 1e-12);
}

TEST(Complexity, KnowsTheTrueWorstCase) {
  for (const nlohmann::json& row : palpate::test::goldenRows("tree_tables", "true_worst_union")) {
    const int arity = row.at("k").get<int>(), height = row.at("h").get<int>();
    EXPECT_EQ(leavesOfCompleteTree(arity, height), row.at("n").get<std::uint64_t>());
    EXPECT_EQ(mostNodesOnPaths(arity, height, row.at("m").get<std::uint64_t>()),
              row.at("visited").get<std::uint64_t>());
  }
}

TEST(Complexity, TheWorstCaseIsThatOfAllWaysToChooseLeaves) {
  // Brute force: every set of leaves of a binary tree of height 3.
  for (std::uint64_t found = 0; found <= 8; ++found) {
    std::uint64_t most = 0, most_tested = 1;
    for (unsigned chosen = 0; chosen < 256; ++chosen) {
      if (static_cast<std::uint64_t>(__builtin_popcount(chosen)) != found) continue;
      std::uint64_t nodes = 0, tested = 1;
      for (unsigned width = 8; width >= 1; width /= 2) {
        for (unsigned first = 0; first < 8; first += width) {
          const bool on_path = ((chosen >> first) & ((1u << width) - 1)) != 0;
          nodes += on_path ? 1 : 0;
          tested += on_path && width > 1 ? 2 : 0;
        }
      }
      most = std::max(most, nodes);
      most_tested = std::max(most_tested, tested);
    }
    EXPECT_EQ(mostNodesOnPaths(2, 3, found), most) << found;
    EXPECT_EQ(mostNodesTested(2, 3, found), most_tested) << found;
  }
}

}  // namespace palpate::study

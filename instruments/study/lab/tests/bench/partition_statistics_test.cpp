#include "lab/runs/partition_statistics.h"

#include <gtest/gtest.h>

#include "core/tests/hdb/partition_judges.h"

namespace palpate::hdb {

using bench::LeafSizeBin;
using bench::PartitionStatistics;
using bench::statisticsOf;

TEST(PartitionStatistics, CountASingleLeaf) {
  const PartitionStatistics s = statisticsOf(buildPartition(zoo::cube(), {}));
  EXPECT_EQ(s.height, 0);
  EXPECT_EQ(s.nodes, 1u);
  EXPECT_EQ(s.leaves, 1u);
  EXPECT_EQ(s.empty_nodes, 0u);
  EXPECT_EQ(s.leaf_sizes.least, 12u);
  EXPECT_EQ(s.leaf_sizes.most, 12u);
  EXPECT_EQ(s.leaf_sizes.mean, 12.0);
  EXPECT_EQ(s.entries_per_triangle, 1.0);
  EXPECT_EQ(s.leaves_per_point, 1.0);
}

TEST(PartitionStatistics, AreAllZeroForAnEmptyMesh) {
  const PartitionStatistics s = statisticsOf(buildPartition(zoo::empty(), {}));
  EXPECT_EQ(s.nodes, 0u);
  EXPECT_EQ(s.leaves, 0u);
  EXPECT_EQ(s.bytes, 0u);
  EXPECT_EQ(s.leaves_per_point, 0.0);
  EXPECT_TRUE(s.leaf_sizes.histogram.empty());
}

TEST(PartitionStatistics, CountTheOctantsThatAFlatSheetLeavesEmpty) {
  // A flat sheet lies on the middle plane and so on its positive side: four octants of each node are empty.
  const PartitionStatistics s = statisticsOf(buildPartition(zoo::grid(8), {.threshold = 40}));
  EXPECT_EQ(s.height, 1);
  EXPECT_EQ(s.nodes, 5u);
  EXPECT_EQ(s.empty_nodes, 4u);
}

TEST(PartitionStatistics, TheHistogramCountsEveryLeaf) {
  for (const TreeKind tree : test::kTrees) {
    const Partition partition = buildPartition(test::goldenBack(), {.tree = tree, .threshold = 64});
    const PartitionStatistics s = statisticsOf(partition);
    std::size_t leaves = 0;
    for (const LeafSizeBin& bin : s.leaf_sizes.histogram) {
      leaves += bin.leaves;
      for (const Index leaf : partition.leaves) {
        EXPECT_LE(partition.nodes[leaf].entry_count, s.leaf_sizes.histogram.back().last);
      }
    }
    EXPECT_EQ(leaves, s.leaves);
    EXPECT_EQ(s.nodes, partition.tree_node_count);
  }
}

TEST(PartitionStatistics, BothSidesStoreTwiceWhatTheCutKeepsApart) {
  const mesh::TriangleMesh mesh = test::goldenBack();
  const auto with = [&](Assignment assignment) {
    return statisticsOf(buildPartition(mesh, {TreeKind::Octree, assignment, 64}));
  };
  EXPECT_EQ(with(Assignment::Majority).entries_per_triangle, 1.0);
  EXPECT_GT(with(Assignment::BothSides).entries_per_triangle, 1.2);
  EXPECT_GT(with(Assignment::Cut).entries_per_triangle, with(Assignment::BothSides).entries_per_triangle);
  // Pieces of different leaves share planes only, so hardly any point is in two leaf boxes.
  EXPECT_NEAR(with(Assignment::Cut).leaves_per_point, 1.0, 0.02);
  EXPECT_GT(with(Assignment::BothSides).leaves_per_point, 1.1);
}

}  // namespace palpate::hdb

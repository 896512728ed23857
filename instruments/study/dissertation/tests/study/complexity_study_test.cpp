// Counted visits are those of the closed forms on complete trees and never more than the worst case on real ones.
#include "dissertation/studies.h"

#include <gtest/gtest.h>

#include "dissertation/complexity/search_cost.h"
#include "dissertation/cost/complexity.h"
#include "lab/measured/model_meshes.h"
#include "report/tests/report/page_numbers.h"
#include "report/tests/report/texts_apart.h"

namespace palpate::study {

namespace {

using hdb::TreeKind;

hdb::Partition completeTree(TreeKind tree, int height) {
  return hdb::buildPartition(completeTreeMesh(tree, height), {.tree = tree, .threshold = 1});
}

Box3 everywhere(const hdb::Partition& tree) { return tree.bounds; }

}  // namespace

TEST(CompleteTree, HasAsManyNodesAsTheFormulae) {
  for (const auto& [kind, arity, most] :
       {std::tuple{TreeKind::Bsp, kBspArity, 10}, std::tuple{TreeKind::Octree, kOctreeArity, 4}}) {
    for (int height = 1; height <= most; ++height) {
      const hdb::Partition tree = completeTree(kind, height);
      const auto leaves = static_cast<double>(leavesOfCompleteTree(arity, height));
      EXPECT_EQ(static_cast<double>(tree.leaves.size()), leaves);
      EXPECT_EQ(static_cast<double>(tree.tree_node_count), nodesOfCompleteTree(arity, leaves));
    }
  }
}

TEST(SearchCounter, OneLeafCostsOneWayAndTheSiblingsBesideIt) {
  const mesh::TriangleMesh mesh = completeTreeMesh(TreeKind::Octree, 3);
  const hdb::Partition tree = completeTree(TreeKind::Octree, 3);
  SearchCounter counter(tree);
  const SearchCount count = counter.count(hdb::hapticBox(mesh.positions[0], 1e-4));
  EXPECT_EQ(count.leaves_found, 1.0);
  EXPECT_EQ(count.on_paths, 4.0);
  EXPECT_EQ(count.entered, 4.0);
  EXPECT_EQ(count.tested, 1.0 + 3.0 * 8.0);
}

TEST(SearchCounter, ABoxAroundAllVisitsAll) {
  const hdb::Partition tree = completeTree(TreeKind::Bsp, 7);
  SearchCounter counter(tree);
  const SearchCount count = counter.count(everywhere(tree));
  EXPECT_EQ(count.leaves_found, 128.0);
  EXPECT_EQ(count.on_paths, 255.0);
  EXPECT_EQ(count.tested, 255.0);
}

TEST(SearchCounter, NeverCountsMoreThanTheWorstCaseOnRealModels) {
  for (const mesh::TriangleMesh& mesh : {backModel(), handModel()}) {
    for (const TreeKind kind : {TreeKind::Bsp, TreeKind::Octree}) {
      for (const Index threshold : {64u, 512u}) {
        const hdb::Partition tree = hdb::buildPartition(mesh, {.tree = kind, .threshold = threshold});
        for (const double edge : {20.0, 100.0}) {
          const SearchSweep sweep = sweepSearches(mesh, tree, edge, 200);
          EXPECT_GT(sweep.worst.leaves_found, 0.0);
          EXPECT_LE(sweep.worst_over_bound, 1.0);
          EXPECT_LE(sweep.worst.on_paths, sweep.worst.entered);
          EXPECT_LE(sweep.worst.entered, sweep.worst.tested);
          EXPECT_LE(sweep.worst.tested, sweep.nodes);
          EXPECT_LE(sweep.mean.tested, sweep.worst.tested);
        }
      }
    }
  }
}

TEST(ComplexityStudy, SharesAreSharesAndFiguresAreReadable) {
  const StudyPage page = studyComplexity({.quick = true});
  EXPECT_GT(numberOf(page, "octree_leaf_ratio_mean"), 0.1);  // what the text takes as the most
  EXPECT_LE(numberOf(page, "ways_over_bound_max"), 1.0);
  for (const StudyFigure& figure : page.figures) expectTextsApart(figure.figure, figure.stem);
}

}  // namespace palpate::study

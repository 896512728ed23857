#include "palpate/hdb/partition.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "core/tests/hdb/partition_judges.h"
#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "support/golden.h"

namespace palpate::hdb {

namespace {

void forEveryKind(const std::vector<Index>& thresholds, const std::function<void(const BuildSettings&)>& body) {
  for (const TreeKind tree : test::kTrees) {
    for (const Assignment assignment : test::kAssignments) {
      for (const Index threshold : thresholds) {
        const BuildSettings settings{tree, assignment, threshold};
        SCOPED_TRACE(test::nameOf(settings));
        body(settings);
      }
    }
  }
}

double areaOf(const Piece& p) { return 0.5 * mesh::areaVector2(p[0], p[1], p[2]).norm(); }

Piece cornersOf(const mesh::TriangleMesh& mesh, Index triangle) {
  const auto [a, b, c] = mesh.triangles[triangle];
  return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

int treeHeight(const Partition& partition) {
  int height = 0;
  for (const Index leaf : partition.leaves) height = std::max<int>(height, partition.nodes[leaf].level);
  return height;
}

std::uint64_t hashOf(const Partition& partition) {
  Hash hash;
  for (const Node& node : partition.nodes) {
    hash.add(node.tight.min());
    hash.add(node.tight.max());
    for (const Index value : {node.first_entry, node.entry_count, node.first_child}) hash.add(std::uint64_t{value});
  }
  for (const Index triangle : partition.triangles) hash.add(std::uint64_t{triangle});
  return hash.value();
}

/// Entries of leaves follow each other without a gap; subtrees are ranges; tight boxes hold what is below.
void expectSound(const Partition& partition) {
  Index next = 0;
  for (const Index leaf : partition.leaves) {
    EXPECT_TRUE(partition.nodes[leaf].is_leaf);
    EXPECT_GT(partition.nodes[leaf].entry_count, 0u);
    EXPECT_EQ(partition.nodes[leaf].first_entry, next);
    next += partition.nodes[leaf].entry_count;
  }
  EXPECT_EQ(next, partition.triangles.size());
  EXPECT_EQ(partition.boxes.size(), partition.triangles.size());
  EXPECT_EQ(partition.cells.size(), partition.tree_node_count);
  for (std::size_t n = 0; n < partition.nodes.size(); ++n) {
    const Node& node = partition.nodes[n];
    Index entries = 0;
    for (Index c = node.first_child; c < node.first_child + node.child_count; ++c) {
      ASSERT_GT(c, n);
      ASSERT_TRUE(node.tight.contains(partition.nodes[c].tight));
      ASSERT_EQ(partition.nodes[c].first_entry, node.first_entry + entries);
      entries += partition.nodes[c].entry_count;
    }
    if (node.child_count > 0) {
      ASSERT_EQ(entries, node.entry_count);
    }
    for (Index e = 0; e < node.entry_count; ++e)
      ASSERT_TRUE(node.tight.contains(partition.boxes[node.first_entry + e]));
  }
}

}  // namespace

TEST(Partition, IsSoundOnEveryMesh) {
  for (const zoo::Specimen& specimen : test::buildableZoo()) {
    SCOPED_TRACE(specimen.name);
    forEveryKind({1, 7, 1024},
                 [&](const BuildSettings& settings) { expectSound(buildPartition(specimen.mesh, settings)); });
  }
}

TEST(Partition, StoresEveryTriangleAndWithTheMajorityOnce) {
  for (const zoo::Specimen& specimen : test::buildableZoo()) {
    SCOPED_TRACE(specimen.name);
    forEveryKind({1, 7, 64}, [&](const BuildSettings& settings) {
      const Partition partition = buildPartition(specimen.mesh, settings);
      const std::set<Index> stored(partition.triangles.begin(), partition.triangles.end());
      EXPECT_EQ(stored.size(), specimen.mesh.triangles.size());
      if (settings.assignment == Assignment::Majority) {
        EXPECT_EQ(partition.triangles.size(), specimen.mesh.triangles.size());
      }
      const auto most = kMaxEntriesPerTriangle * static_cast<double>(specimen.mesh.triangles.size());
      EXPECT_LE(static_cast<double>(partition.triangles.size()), most);
    });
  }
}

TEST(Partition, CutsWithoutLosingArea) {
  for (const zoo::Specimen& specimen : test::buildableZoo()) {
    SCOPED_TRACE(specimen.name);
    for (const TreeKind tree : test::kTrees) {
      const Partition partition = buildPartition(specimen.mesh, {tree, Assignment::Cut, 4});
      std::map<Index, double> area;
      for (std::size_t e = 0; e < partition.pieces.size(); ++e)
        area[partition.triangles[e]] += areaOf(partition.pieces[e]);
      for (Index t = 0; t < specimen.mesh.triangles.size(); ++t) {
        const double expected = areaOf(cornersOf(specimen.mesh, t));
        const double diagonal = test::computeBox(specimen.mesh, t).diagonal().norm();
        ASSERT_NEAR(area[t], expected, 1e-11 * diagonal * diagonal + 1e-9 * expected) << "triangle " << t;
      }
    }
  }
}

TEST(Partition, PiecesStayInTheCellOfTheirLeaf) {
  const mesh::TriangleMesh mesh = test::goldenBack();
  for (const TreeKind tree : test::kTrees) {
    const Partition partition = buildPartition(mesh, {tree, Assignment::Cut, 64});
    ASSERT_EQ(partition.pieces.size(), partition.triangles.size());
    for (const Index leaf : partition.leaves) {
      const Node& node = partition.nodes[leaf];
      for (Index e = node.first_entry; e < node.first_entry + node.entry_count; ++e) {
        for (const Vec3& corner : partition.pieces[e]) {
          ASSERT_LE(partition.cells[leaf].exteriorDistance(corner), 1e-12) << "entry " << e;
        }
      }
    }
  }
}

TEST(Partition, WithBothSidesALeafHoldsWhatReachesIntoItsCell) {
  const mesh::TriangleMesh mesh = test::goldenBack();
  const Partition partition = buildPartition(mesh, {TreeKind::Bsp, Assignment::BothSides, 64});
  for (const Index leaf : partition.leaves) {
    const auto stored = trianglesOf(partition, partition.nodes[leaf]);
    const std::set<Index> in_leaf(stored.begin(), stored.end());
    const Box3& cell = partition.cells[leaf];
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
      const Box3 box = test::computeBox(mesh, t);
      const bool overlaps =
          (box.min().array() < cell.max().array()).all() && (box.max().array() > cell.min().array()).all();
      if (overlaps) {
        ASSERT_TRUE(in_leaf.contains(t)) << "triangle " << t << " leaf " << leaf;
      }
    }
  }
}

TEST(Partition, LeavesHoldAtMostTheThreshold) {
  const mesh::TriangleMesh mesh = test::goldenBack();
  forEveryKind({64, 100, 1024, 5000}, [&](const BuildSettings& settings) {
    const Partition partition = buildPartition(mesh, settings);
    for (const Index leaf : partition.leaves) EXPECT_LE(partition.nodes[leaf].entry_count, settings.threshold);
  });
}

TEST(Partition, TheTextsLeafRuleWantsFewerThanTheThreshold) {  // E7
  const mesh::TriangleMesh mesh = test::goldenBack();
  const auto count = static_cast<Index>(mesh.triangles.size());
  EXPECT_EQ(buildPartition(mesh, {.threshold = count}).leaves.size(), 1u);
  EXPECT_EQ(buildPartition(mesh, {.threshold = count + 1, .leaf_below_threshold = true}).leaves.size(), 1u);
  EXPECT_GT(buildPartition(mesh, {.threshold = count, .leaf_below_threshold = true}).leaves.size(), 1u);
  EXPECT_EQ(buildPartition(zoo::oneTriangle(), {.threshold = 1, .leaf_below_threshold = true}).leaves.size(), 1u);
}

TEST(Partition, AgreesWithTheGoldenTrees) {
  const mesh::TriangleMesh mesh = test::goldenBack();
  for (const nlohmann::json& item : palpate::test::goldenRows("hdb_query", "cases")) {
    const auto threshold = item.at("threshold").get<Index>();
    for (const TreeKind tree : test::kTrees) {
      const nlohmann::json& expected = item.at(tree == TreeKind::Bsp ? "bsp" : "octree");
      const Partition partition = buildPartition(mesh, {.tree = tree, .threshold = threshold});
      SCOPED_TRACE(test::nameOf({.tree = tree, .threshold = threshold}));
      EXPECT_EQ(partition.tree_node_count, expected.at("nodes_nonempty").get<Index>());
      EXPECT_EQ(partition.leaves.size(), expected.at("leaves").get<std::size_t>());
      EXPECT_EQ(treeHeight(partition), expected.at("height").get<int>());
      EXPECT_EQ(partition.triangles.size(), expected.at("sum_leaf").get<std::size_t>());
      Index least = kNoIndex, most = 0;
      for (const Index leaf : partition.leaves) {
        least = std::min(least, partition.nodes[leaf].entry_count);
        most = std::max(most, partition.nodes[leaf].entry_count);
      }
      EXPECT_EQ(least, expected.at("min_leaf").get<Index>());
      EXPECT_EQ(most, expected.at("max_leaf").get<Index>());
    }
  }
}

TEST(Partition, CoincidentTrianglesEndInALeaf) {  // E7
  mesh::TriangleMesh mesh = zoo::oneTriangle();
  mesh.triangles.resize(5000, mesh.triangles[0]);
  forEveryKind({1}, [&](const BuildSettings& settings) {
    const Partition partition = buildPartition(mesh, settings);
    EXPECT_EQ(partition.leaves.size(), 1u);
    EXPECT_EQ(partition.triangles.size(), 5000u);
  });
}

TEST(Partition, SliversThatCrossEveryPlaneStayWithinTheAllowance) {
  mesh::TriangleMesh mesh;  // 3000 needles side by side along x
  for (Index i = 0; i < 3000; ++i) {
    mesh.positions.insert(mesh.positions.end(), {{0, i * 1e-4, 0}, {100, i * 1e-4, 0}, {100, i * 1e-4 + 1e-5, 0}});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  forEveryKind({1}, [&](const BuildSettings& settings) {
    EXPECT_LE(buildPartition(mesh, settings).triangles.size(), 16u * 3000u);
  });
}

TEST(Partition, AStrayVertexFarAwayDoesNotSpoilTheTree) {
  const mesh::TriangleMesh mesh = zoo::joined(zoo::sphere(20.0, 4), zoo::cube(1.0, Vec3(1e8, 0, 0)));
  const Partition partition = buildPartition(mesh, {.threshold = 64});
  for (const Index leaf : partition.leaves) EXPECT_LE(partition.nodes[leaf].entry_count, 64u);
}

TEST(Partition, IsTheSameEveryTime) {
  const mesh::TriangleMesh mesh = zoo::overlappingSpheres();
  forEveryKind({1, 64}, [&](const BuildSettings& settings) {
    EXPECT_EQ(hashOf(buildPartition(mesh, settings)), hashOf(buildPartition(mesh, settings)));
  });
}

TEST(Partition, ReportsItsProgressAndStopsWhenTheReportThrows) {
  const mesh::TriangleMesh mesh = zoo::sphere(20.0, 5);
  forEveryKind({64}, [&](const BuildSettings& settings) {
    std::vector<double> reports;
    buildPartition(mesh, settings, [&](std::string_view, double done) { reports.push_back(done); });
    ASSERT_GT(reports.size(), 10u);
    EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
    EXPECT_NEAR(reports.back(), 1.0, 0.02);
    struct Stop {};
    EXPECT_THROW(buildPartition(mesh, settings, [](std::string_view, double) { throw Stop(); }), Stop);
  });
}

TEST(Partition, RefusesWhatItCannotDivide) {
  EXPECT_THROW(buildPartition(zoo::cube(), {.threshold = 0}), Error);
  EXPECT_THROW(buildPartition(zoo::cubeWithWrongIndices(), {}), Error);
  EXPECT_THROW(buildPartition(zoo::cubeWithNonFiniteVertices(), {}), Error);
}

}  // namespace palpate::hdb

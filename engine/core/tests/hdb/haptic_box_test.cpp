#include "palpate/hdb/haptic_box.h"

#include <gtest/gtest.h>

#include "core/tests/hdb/partition_judges.h"
#include "palpate/body/torso.h"
#include "support/counted.h"
#include "support/golden.h"

namespace palpate::hdb {

using test::computeBox;

namespace {

/// Leaves and exact triangles against brute force for random boxes.
void expectNothingMissed(const mesh::TriangleMesh& mesh, const Partition& partition, int boxes, std::uint64_t seed) {
  LeafHits leaves;
  TriangleHits exact;
  leaves.prepareFor(partition);
  exact.prepareFor(partition);
  Random random(seed);
  for (int i = 0; i < boxes; ++i) {
    const Box3 box = test::randomBox(random, mesh);
    const std::set<Index> must = test::trianglesMeeting(mesh, box);
    findLeaves(partition, box, leaves);
    ASSERT_EQ(test::missing(must, test::trianglesOfLeaves(partition, leaves.leaves)), 0u) << "box " << i;
    findTriangles(partition, box, exact);
    listTriangles(partition, exact);
    const std::set<Index> found(exact.triangles.begin(), exact.triangles.end());
    ASSERT_EQ(found, must) << "box " << i;
    ASSERT_EQ(found.size(), exact.triangles.size()) << "a triangle twice, box " << i;
  }
}

}  // namespace

TEST(HapticBox, MissesNothingOnAnyMeshWithAnyTreeAssignmentAndThreshold) {
  for (const zoo::Specimen& specimen : test::buildableZoo()) {
    for (const TreeKind tree : test::kTrees) {
      for (const Assignment assignment : test::kAssignments) {
        for (const Index threshold : {1u, 2u, 7u, 64u, 1024u, 100000u}) {
          const BuildSettings settings{tree, assignment, threshold};
          SCOPED_TRACE(specimen.name + " " + test::nameOf(settings));
          expectNothingMissed(specimen.mesh, buildPartition(specimen.mesh, settings), 12, threshold);
        }
      }
    }
  }
}

TEST(HapticBox, MissesNothingOnTheBody) {
  const body::Torso torso = body::makeTorso({.triangles = 20389});
  mesh::TriangleMesh mesh = torso.skin.mesh;
  for (const body::Bone& bone : torso.bones) mesh = zoo::joined(std::move(mesh), bone.mesh);
  for (const TreeKind tree : test::kTrees) {
    for (const Assignment assignment : test::kAssignments) {
      for (const Index threshold : {1u, 64u, 1024u, 100000u}) {
        const BuildSettings settings{tree, assignment, threshold};
        SCOPED_TRACE(test::nameOf(settings));
        expectNothingMissed(mesh, buildPartition(mesh, settings), 12, threshold);
      }
    }
  }
}

TEST(HapticBox, AgreesWithTheGoldenQueries) {
  const mesh::TriangleMesh mesh = test::goldenBack();
  for (const nlohmann::json& item : palpate::test::goldenRows("hdb_query", "cases")) {
    const auto threshold = item.at("threshold").get<Index>();
    const Partition bsp = buildPartition(mesh, {.tree = TreeKind::Bsp, .threshold = threshold});
    const Partition octree = buildPartition(mesh, {.tree = TreeKind::Octree, .threshold = threshold});
    for (const nlohmann::json& query : item.at("queries")) {
      const Box3 box = hapticBox(palpate::test::vec3(query.at("center")), 100.0);
      SCOPED_TRACE("threshold " + std::to_string(threshold) + " query " + query.at("center").dump());
      const std::set<Index> must = test::trianglesMeeting(mesh, box);
      EXPECT_EQ(must.size(), query.at("must").get<std::size_t>());

      LeafHits hits;
      findLeaves(bsp, box, hits);
      EXPECT_EQ(test::missing(must, test::trianglesOfLeaves(bsp, hits.leaves)), 0u);
      EXPECT_EQ(entriesIn(bsp, hits.leaves), query.at("bsp_tight").at("rendered").get<std::size_t>());
      EXPECT_EQ(hits.cost.nodes_entered, query.at("bsp_tight").at("visited").get<Index>());

      findLeaves(octree, box, hits);
      EXPECT_EQ(test::missing(must, test::trianglesOfLeaves(octree, hits.leaves)), 0u);
      EXPECT_EQ(entriesIn(octree, hits.leaves), query.at("oct_tight").at("rendered").get<std::size_t>());
      EXPECT_EQ(hits.cost.nodes_tested, query.at("oct_tight").at("visited").get<Index>());
    }
  }
}

TEST(HapticBox, TakesTheWholeModelAsOneRange) {
  const mesh::TriangleMesh mesh = zoo::sphere(20.0, 4);
  const Partition partition = buildPartition(mesh, {.threshold = 64});
  TriangleHits hits;
  findTriangles(partition, computeBox(mesh), hits);
  ASSERT_EQ(hits.ranges.size(), 1u);
  EXPECT_EQ(hits.ranges[0], (EntryRange{0, static_cast<Index>(mesh.triangles.size())}));
}

TEST(HapticBox, CountsTouchingAsMeeting) {
  const Partition partition = buildPartition(zoo::cube(10.0), {});
  TriangleHits hits;
  findTriangles(partition, Box3(Vec3(10, 2, 2), Vec3(20, 3, 3)), hits);
  listTriangles(partition, hits);
  EXPECT_EQ(hits.triangles.size(), 2u);  // the face at x = 10
  findTriangles(partition, Box3(Vec3(std::nextafter(10.0, 11.0), 2, 2), Vec3(20, 3, 3)), hits);
  EXPECT_TRUE(hits.ranges.empty());
}

TEST(HapticBox, AnEmptyPartitionHasNothing) {
  const Partition partition = buildPartition(zoo::empty(), {});
  LeafHits leaves;
  TriangleHits exact;
  exact.prepareFor(partition);
  findLeaves(partition, hapticBox(Vec3::Zero(), 1e9), leaves);
  findTriangles(partition, hapticBox(Vec3::Zero(), 1e9), exact);
  listTriangles(partition, exact);
  EXPECT_TRUE(leaves.leaves.empty());
  EXPECT_TRUE(exact.ranges.empty());
  EXPECT_TRUE(exact.triangles.empty());
  EXPECT_EQ(hdbEdges(partition.bounds), Vec3::Zero());
}

TEST(HapticBox, AllocatesNothingOnceThereIsRoom) {
  const mesh::TriangleMesh mesh = zoo::sphere(20.0, 4);
  for (const Assignment assignment : test::kAssignments) {
    const Partition partition = buildPartition(mesh, {.assignment = assignment, .threshold = 16});
    LeafHits leaves;
    TriangleHits exact;
    leaves.prepareFor(partition);
    exact.prepareFor(partition);
    Random random(3);
    support::expectNoAllocation([&] {
      for (int i = 0; i < 200; ++i) {
        const Box3 box = test::randomBox(random, mesh);  // the judge's own boxes allocate nothing either
        findLeaves(partition, box, leaves);
        findTriangles(partition, box, exact);
        listTriangles(partition, exact);
      }
    });
  }
}

TEST(HapticBox, MeasuresAQuarterOfTheLongestEdgeOrOfTheBox) {
  const Box3 model(Vec3(-10, 0, 5), Vec3(30, 400, 85));
  EXPECT_EQ(hdbEdges(model), Vec3(100, 100, 100));
  EXPECT_EQ(hdbEdges(model, HdbSize::QuarterOfBox), Vec3(10, 100, 20));  // E12
  const Box3 box = hapticBox(Vec3(1, 2, 3), 10.0);
  EXPECT_EQ(box.min(), Vec3(-4, -3, -2));
  EXPECT_EQ(box.max(), Vec3(6, 7, 8));
}

TEST(HapticBox, AFingerCannotOutrunTheLeastEdge) {
  // 500 mm/s for 20 ms is 10 mm; with triangles of 5 mm the half edge must be 15 mm.
  EXPECT_DOUBLE_EQ(leastHdbEdge(500.0, 0.02, 5.0), 30.0);
}

}  // namespace palpate::hdb

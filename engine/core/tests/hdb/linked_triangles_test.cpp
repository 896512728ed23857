#include "palpate/hdb/linked_triangles.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/tests/hdb/hdb_track.h"
#include "core/tests/hdb/partition_judges.h"
#include "palpate/base/random.h"
#include "support/counted.h"

namespace palpate::hdb {

namespace {

const Box3 kEverywhere(Vec3::Constant(-1e15), Vec3::Constant(1e15));

std::set<Index> marked(LinkedTriangles& list, const Partition& partition) {
  std::vector<Index> entries;
  appendNear(list, partition, kEverywhere, entries);
  EXPECT_TRUE(std::is_sorted(entries.begin(), entries.end()));
  EXPECT_EQ(entries.size(), list.triangles);
  std::set<Index> triangles;
  for (const Index entry : entries) triangles.insert(partition.triangles[entry]);
  return triangles;
}

Vec3 onTheWay(int step, int steps) { return {-120.0 + 240.0 * step / steps, 60.0 + 280.0 * step / steps, 60.0}; }

TEST(LinkedTriangles, AreExactlyWhatTheBoxMeetsAtEveryTick) {
  const mesh::TriangleMesh mesh = test::goldenBack();
  for (const TreeKind tree : {TreeKind::Bsp, TreeKind::Octree}) {
    for (const Assignment assignment : test::kAssignments) {
      for (const Index threshold : {16u, 64u, 100000u}) {
        const Partition partition =
            buildPartition(mesh, {.tree = tree, .assignment = assignment, .threshold = threshold});
        LinkedTriangles list;
        list.prepareFor(partition);
        for (int step = 0; step < 60; ++step) {
          const Box3 box = hapticBox(onTheWay(step, 60), 100.0);
          moveTo(list, partition, box);
          ASSERT_EQ(marked(list, partition), test::trianglesMeeting(mesh, box)) << "step " << step;
        }
      }
    }
  }
}

// Small steps, jumps out of the body and back, boxes that grow and shrink, in any order.
TEST(LinkedTriangles, FollowABoxThatJumps) {
  for (const zoo::Specimen& specimen : test::buildableZoo()) {
    const Partition partition = buildPartition(specimen.mesh, {.threshold = 20});
    Vec3 size = Vec3::Ones();
    if (!partition.bounds.isEmpty()) size = partition.bounds.sizes();
    LinkedTriangles list;
    list.prepareFor(partition);
    Random random(11);
    Vec3 place = Vec3::Zero();
    if (!partition.bounds.isEmpty()) place = partition.bounds.center();
    for (int step = 0; step < 60; ++step) {
      const double reach = step % 7 == 0 ? 1.0 : 0.01;
      for (int axis = 0; axis < 3; ++axis) place[axis] += reach * size[axis] * random.uniform(-1.0, 1.0);
      const Box3 box = hapticBox(place, random.uniform(0.05, 0.8) * size.maxCoeff());
      moveTo(list, partition, box);
      ASSERT_EQ(marked(list, partition), test::trianglesMeeting(specimen.mesh, box)) << specimen.name << " " << step;
    }
  }
}

TEST(LinkedTriangles, TestFewBoxesWhileTheBoxMovesALittle) {
  const Partition partition = buildPartition(zoo::sphere(100.0, 6), {});
  LinkedTriangles list;
  list.prepareFor(partition);
  EXPECT_TRUE(moveTo(list, partition, hapticBox(Vec3(0, 0, 100), 80.0)));
  EXPECT_FALSE(moveTo(list, partition, hapticBox(Vec3(0, 0, 100), 80.0)));
  const std::uint64_t before = list.boxes_moved;
  EXPECT_TRUE(moveTo(list, partition, hapticBox(Vec3(0.2, 0, 100), 80.0)));
  EXPECT_LT(list.boxes_moved - before, list.triangles / 4);
}

TEST(LinkedTriangles, StartAgainForAnotherPartition) {
  const Partition first = buildPartition(test::goldenBack(), {}), second = buildPartition(zoo::cube(), {});
  const Box3 box = hapticBox(Vec3(0, 0, 0), 5.0);
  LinkedTriangles list;
  list.prepareFor(first);
  moveTo(list, first, box);
  list.prepareFor(second);
  EXPECT_TRUE(moveTo(list, second, box));
  EXPECT_EQ(marked(list, second), test::trianglesMeeting(zoo::cube(), box));
}

TEST(LinkedTriangles, AllocateNothingWhileTheFingerSlides) {
  const Partition partition = buildPartition(test::goldenBack(), {.threshold = 16});
  LinkedTriangles list;
  list.prepareFor(partition);
  support::expectNoAllocation([&] {
    for (int step = 0; step < 2000; ++step) moveTo(list, partition, hapticBox(onTheWay(step, 2000), 60.0));
  });
  EXPECT_GT(list.triangles, 0u);
}

/// A finger that comes down on the back and slides with another list; its outputs.
std::vector<FingerOutput> slideOver(const mesh::TriangleMesh& mesh, HdbQuery query, const hdb::BuildSettings& build) {
  const HdbBody body(mesh, cubeSettings(60.0, query), build);
  HdbTrack finger(body);
  std::vector<FingerOutput> outputs;
  for (int step = 0; step < 1500; ++step) {
    const double share = step / 1500.0;
    outputs.push_back(
        finger.to(Vec3(-90.0 + 180.0 * share, 100.0 + 150.0 * share, step < 100 ? 110.0 - 0.5 * step : 60.0)));
  }
  return outputs;
}

TEST(LinkedTriangles, GiveTheForcesOfTheOtherListsToTheBit) {
  const mesh::TriangleMesh mesh = test::goldenBack();
  for (const Assignment assignment : test::kAssignments) {
    const hdb::BuildSettings build{.assignment = assignment, .threshold = 64};
    const auto expected = slideOver(mesh, HdbQuery::triangles, build);
    const auto found = slideOver(mesh, HdbQuery::linked, build);
    std::size_t touching = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].force, expected[i].force) << i;
      ASSERT_EQ(found[i].proxy, expected[i].proxy) << i;
      touching += found[i].depth_mm > 0.0 ? 1 : 0;
    }
    EXPECT_GT(touching, 500u);
  }
}

}  // namespace
}  // namespace palpate::hdb

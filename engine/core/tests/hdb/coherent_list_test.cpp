#include "palpate/hdb/coherent_list.h"

#include <gtest/gtest.h>

#include "core/tests/hdb/partition_judges.h"
#include "support/counted.h"

namespace palpate::hdb {

namespace {

std::set<Index> listed(const Partition& partition, const CoherentList& list) {
  std::set<Index> triangles;
  for (const EntryRange& range : list.hits.ranges) {
    triangles.insert(partition.triangles.begin() + range.begin, partition.triangles.begin() + range.end);
  }
  return triangles;
}

/// A finger that slides once across the golden back in this many steps.
Vec3 slidingProxy(int step, int steps) { return {-120.0 + 240.0 * step / steps, 60.0 + 280.0 * step / steps, 60.0}; }

}  // namespace

TEST(CoherentList, HoldsAllThatTheBoxMeetsAtEveryTick) {
  const mesh::TriangleMesh mesh = test::goldenBack();
  for (const Assignment assignment : test::kAssignments) {
    const Partition partition = buildPartition(mesh, {.assignment = assignment, .threshold = 64});
    CoherentList list;
    list.prepareFor(partition);
    for (int step = 0; step < 300; ++step) {
      const Box3 box = hapticBox(slidingProxy(step, 300), 100.0);
      follow(list, partition, box);
      ASSERT_EQ(test::missing(test::trianglesMeeting(mesh, box), listed(partition, list)), 0u) << "step " << step;
    }
  }
}

TEST(CoherentList, IsExactlyWhatTheCoveredBoxMeets) {
  const mesh::TriangleMesh mesh = test::goldenBack();
  const Partition partition = buildPartition(mesh, {.threshold = 64});
  CoherentList list;
  list.prepareFor(partition);
  follow(list, partition, hapticBox(Vec3(0, 200, 72), 100.0), 0.1);
  EXPECT_TRUE(list.covered.isApprox(hapticBox(Vec3(0, 200, 72), 120.0)));
  EXPECT_EQ(listed(partition, list), test::trianglesMeeting(mesh, list.covered));
}

TEST(CoherentList, IsRefreshedOnlyWhenTheBoxLeavesTheMargin) {
  const Partition partition = buildPartition(test::goldenBack(), {});
  CoherentList list;
  list.prepareFor(partition);
  const Vec3 start(0, 200, 72);
  EXPECT_TRUE(follow(list, partition, hapticBox(start, 100.0)));  // covers 12.5 mm more on each side
  EXPECT_FALSE(follow(list, partition, hapticBox(start + Vec3(12.5, -12.5, 12.0), 100.0)));
  EXPECT_FALSE(follow(list, partition, hapticBox(start, 80.0)));
  EXPECT_TRUE(follow(list, partition, hapticBox(start + Vec3(0, 0, 12.6), 100.0)));
  EXPECT_EQ(list.refreshes, 2u);
}

TEST(CoherentList, StartsAnewForAnotherPartition) {
  const Partition first = buildPartition(test::goldenBack(), {}), second = buildPartition(zoo::cube(), {});
  CoherentList list;
  list.prepareFor(first);
  const Box3 box = hapticBox(Vec3(0, 0, 0), 5.0);
  follow(list, first, box);
  list.prepareFor(second);
  EXPECT_TRUE(follow(list, second, box));
  EXPECT_EQ(listed(second, list), test::trianglesMeeting(zoo::cube(), list.covered));
}

TEST(CoherentList, AllocatesNothingWhileTheFingerSlides) {
  const Partition partition = buildPartition(test::goldenBack(), {.threshold = 16});
  CoherentList list;
  list.prepareFor(partition);
  support::expectNoAllocation([&] {
    for (int step = 0; step < 2000; ++step) follow(list, partition, hapticBox(slidingProxy(step, 2000), 60.0));
  });
  EXPECT_GT(list.refreshes, 10u);
}

}  // namespace palpate::hdb

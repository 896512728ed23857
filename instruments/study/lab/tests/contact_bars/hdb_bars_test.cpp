// The finger that feels through the haptic detecting box, on the workloads of the benchmarks: as the default finger in
// ordinary use, and as bad as it must be with the printed traversal.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/tests/hdb/hdb_track.h"
#include "lab/runs/contact_run.h"
#include "lab/workloads/workload_meshes.h"
#include "lab/workloads/workload_paths.h"

namespace palpate::hdb {
namespace {

/// Figures of a benchmark path, felt through the detecting box.
bench::ContactFigures figures(bench::ContactWorld& world, const std::string& path,
                              const std::shared_ptr<const HdbSurface>& hdb, const bench::Window& window = {}) {
  const device::Trajectory trajectory = lab::workloadPath(path);
  HdbCandidates candidates(hdb);
  FingerState state;
  bench::FingerRun run;
  for (const Vec3& tip : trajectory.tip_mm) {
    run.outputs.push_back(stepHdb(world.surface, {}, candidates, state, tip));
    run.tick_us.push_back(0.0);
  }
  return bench::computeFigures(world, run, {}, trajectory.time_s, window);
}

/// The quarter of the longest edge, as in the dissertation.
HdbSettings usualBox(const hdb::Partition& partition, HdbQuery query) {
  HdbSettings settings;
  settings.edges_mm = hdb::hdbEdges(partition.bounds);
  settings.query = query;
  return settings;
}

TEST(HdbBars, SlidesOverTheBackAsTheDefaultFingerDoes) {
  bench::ContactWorld world = bench::buildContactWorld(lab::workloadMesh("back_8163"));
  const auto partition = buildTestPartition(lab::workloadMesh("back_8163"));
  const bench::Window window{lab::kSlideFromSeconds, lab::kSlideUntilSeconds};
  const auto reference = bench::measureContact(world, lab::workloadPath("back_slide"), {}, window);
  for (const HdbQuery query : {HdbQuery::leaves, HdbQuery::triangles, HdbQuery::coherent, HdbQuery::linked}) {
    const auto found =
        figures(world, "back_slide", makeHdbSurface(world.surface, partition, usualBox(*partition, query)), window);
    EXPECT_EQ(found.falls.ticks, 0u);
    EXPECT_EQ(found.falls.first_contact_delay_ticks, 0u);
    EXPECT_EQ(found.contact_ticks, reference.contact_ticks);
    EXPECT_NEAR(found.lag_mm.p99, reference.lag_mm.p99, 0.05);
    EXPECT_NEAR(found.lag_mm.max, reference.lag_mm.max, 0.5);
    EXPECT_NEAR(found.peak_force_n, reference.peak_force_n, 0.05);
    EXPECT_LT(found.max_force_step_n, 0.45);
    EXPECT_NEAR(found.friction.kinetic, 0.44, 1e-9);
  }
}

TEST(HdbBars, DoesNotFallInStabsJumpsGroovesAndPits) {
  for (const auto& [mesh, path] :
       {std::pair{"back_2962", "back_stab5mps"}, std::pair{"back_2962", "back_jump20mm"},
        std::pair{"groove60", "groove60"}, std::pair{"pit", "pit"}, std::pair{"eggcrate", "eggcrate_0.1mps"}}) {
    bench::ContactWorld world = bench::buildContactWorld(lab::workloadMesh(mesh));
    const auto partition = buildTestPartition(lab::workloadMesh(mesh));
    const auto found =
        figures(world, path, makeHdbSurface(world.surface, partition, usualBox(*partition, HdbQuery::coherent)));
    EXPECT_EQ(found.falls.ticks, 0u) << path;
    EXPECT_GT(found.contact_ticks, 1000u) << path;
  }
}

TEST(HdbBars, TreesAndAssignmentsGiveTheSameForces) {
  bench::ContactWorld world = bench::buildContactWorld(lab::workloadMesh("back_2962"));
  const auto lag = [&](hdb::TreeKind tree, hdb::Assignment assignment) {
    hdb::BuildSettings build;
    build.tree = tree;
    build.assignment = assignment;
    build.threshold = 100;
    const auto partition = buildTestPartition(lab::workloadMesh("back_2962"), build);
    return figures(world, "back_slide",
                   makeHdbSurface(world.surface, partition, usualBox(*partition, HdbQuery::leaves)))
        .lag_mm.max;
  };
  const double reference = lag(hdb::TreeKind::Octree, hdb::Assignment::Majority);
  for (const auto tree : {hdb::TreeKind::Bsp, hdb::TreeKind::Octree}) {
    for (const auto assignment : {hdb::Assignment::Cut, hdb::Assignment::BothSides, hdb::Assignment::Majority}) {
      EXPECT_NEAR(lag(tree, assignment), reference, 1e-6);
    }
  }
}

// E4, E10 and E5 on a fine BSP tree: the printed pseudocode goes into one child of two, and the skin has holes.
TEST(HdbBars, ThePrintedTraversalLosesTheSkin) {
  bench::ContactWorld world = bench::buildContactWorld(lab::workloadMesh("back_2962"));
  hdb::BuildSettings build;
  build.tree = hdb::TreeKind::Bsp;
  build.threshold = 64;
  const auto partition = buildTestPartition(lab::workloadMesh("back_2962"), build);
  HdbSettings settings = usualBox(*partition, HdbQuery::leaves);
  const auto corrected = figures(world, "back_slide", makeHdbSurface(world.surface, partition, settings));
  settings.literal = hdb::LiteralTraversal::ElseIf;
  const auto printed = figures(world, "back_slide", makeHdbSurface(world.surface, partition, settings));
  EXPECT_EQ(corrected.falls.ticks, 0u);
  EXPECT_GT(printed.falls.ticks, 100u);
  EXPECT_LT(printed.contact_ticks, corrected.contact_ticks);
}

}  // namespace
}  // namespace palpate::hdb

// contact_run.h with the detecting box as the source of contact: same tips, same figures, and the box's counts.
#include "lab/runs/contact_run.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "lab/runs/timed_run.h"
#include "palpate/hdb/hdb_finger.h"

namespace palpate::bench {

namespace {

/// Finds every page of code and surface.
void warmUp(const contact::Surface& surface, const contact::FingerSettings& finger,
            const std::shared_ptr<const hdb::HdbSurface>& hdb, const std::vector<Vec3>& tips) {
  hdb::HdbCandidates candidates(hdb);
  contact::FingerState state;
  for (const Vec3& tip : tips) (void)hdb::stepHdb(surface, finger, candidates, state, tip);
}

}  // namespace

HdbFigures measureHdb(ContactWorld& world, const device::Trajectory& trajectory, const contact::FingerSettings& finger,
                      const HdbRunSettings& settings, const Window& window) {
  contact::check(finger);
  auto partition =
      std::make_shared<const hdb::Partition>(hdb::buildPartition(extractMesh(world.surface), settings.build));
  hdb::HdbSettings hdb = settings.hdb;
  hdb.edges_mm = settings.edge_mm > 0.0 ? Vec3::Constant(settings.edge_mm) : hdb::hdbEdges(partition->bounds);
  HdbFigures figures;
  figures.leaves = partition->leaves.size();
  figures.edge_mm = hdb.edges_mm.x();
  const auto surface = hdb::makeHdbSurface(world.surface, std::move(partition), hdb);
  const device::Trajectory ticks = device::resampled(trajectory, finger.tick_s);
  warmUp(world.surface, finger, surface, ticks.tip_mm);
  hdb::HdbCandidates candidates(surface);
  contact::FingerState state;
  const FingerRun run = timedRun(std::span(ticks.tip_mm), [&](const Vec3& tip) {
    contact::FingerOutput output = hdb::stepHdb(world.surface, finger, candidates, state, tip);
    figures.most_listed = std::max(figures.most_listed, candidates.size());
    return output;
  });
  figures.queries = candidates.queries();
  figures.contact = computeFigures(world, run, finger, ticks.time_s, window);
  return figures;
}

}  // namespace palpate::bench

// All ways take the same strokes in the same run, each with a box of a quarter of the model that follows at every tick;
// of some runs the shortest counts, because other load only ever adds.
// Based on: Ji, dissertation 2008, 6.2 (4).
#include "dissertation/hdb/hdb_measurement.h"

#include <algorithm>
#include <memory>

#include "lab/measured/finger_strokes.h"
#include "lab/measured/haptic_frames.h"
#include "lab/measured/stopwatch.h"
#include "lab/workloads/workload_meshes.h"
#include "palpate/hdb/hdb_finger.h"

namespace palpate::study {

namespace {

using hdb::HdbQuery;
using ListStrokes = std::vector<std::vector<Vec3>>;
using Outputs = std::vector<contact::FingerOutput>;

constexpr HdbQuery kQueries[] = {HdbQuery::leaves, HdbQuery::triangles, HdbQuery::coherent, HdbQuery::linked};
constexpr double kSpeedMmS = 200.0;

bool sameToTheBit(const Outputs& a, const Outputs& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    return one.force == other.force && one.proxy == other.proxy;
  });
}

void feelByDefault(const contact::Surface& surface, const ListStrokes& strokes, Outputs& outputs) {
  outputs.clear();
  for (const auto& stroke : strokes) {
    contact::FingerState state;
    for (const Vec3& tip : stroke) outputs.push_back(contact::step(surface, {}, state, tip));
  }
}

/// One finger continues from stroke to stroke, lifted in between: its list follows from one to the next.
template <class Visit>
void feel(const contact::Surface& surface, hdb::HdbCandidates& list, const ListStrokes& strokes, Outputs& outputs,
          Visit&& visit) {
  outputs.clear();
  for (const auto& stroke : strokes) {
    contact::FingerState state;
    for (const Vec3& tip : stroke) {
      outputs.push_back(hdb::stepHdb(surface, {}, list, state, tip));
      visit();
    }
  }
}

ListRow measureListRow(const contact::Surface& surface, const std::shared_ptr<const hdb::HdbSurface>& box,
                       const ListStrokes& strokes, const Outputs& expected, const ListPlan& plan) {
  ListRow row{.model = box->partition->triangle_count, .query = box->settings.query};
  row.make_us = shortestMicroseconds(plan.runs, [&] { hdb::HdbCandidates made(box); });
  hdb::HdbCandidates list(box);
  row.bytes = static_cast<double>(list.bytes());
  Outputs outputs;
  outputs.reserve(expected.size());
  feel(surface, list, strokes, outputs, [&] { row.listed += static_cast<double>(list.size()); });
  row.same = sameToTheBit(outputs, expected);
  const auto ticks = static_cast<double>(expected.size());
  row.listed /= ticks;
  row.asked = static_cast<double>(list.queries()) / ticks;
  row.moved = static_cast<double>(list.boxesMoved()) / ticks;
  row.tested = static_cast<double>(list.boxesTested()) / ticks;
  row.tick_us = shortestMicroseconds(plan.runs, [&] { feel(surface, list, strokes, outputs, [] {}); }) / ticks;
  return row;
}

void measureModel(std::size_t triangles, const ListPlan& plan, ListCosts& costs) {
  const mesh::TriangleMesh mesh = lab::backMesh(triangles);
  const contact::Surface surface = contactSurface(mesh);
  const ListStrokes strokes = fingerStrokes({.count = plan.strokes, .speed_mm_s = kSpeedMmS});
  std::shared_ptr<const hdb::Partition> partition;
  costs.build_us.push_back(shortestMicroseconds(
      plan.runs, [&] { partition = std::make_shared<const hdb::Partition>(hdb::buildPartition(mesh, {})); }));
  costs.models.push_back(mesh.triangles.size());
  Outputs expected;
  const double all_us = shortestMicroseconds(plan.runs, [&] { feelByDefault(surface, strokes, expected); });
  costs.default_us.push_back(all_us / static_cast<double>(expected.size()));
  for (const HdbQuery query : kQueries) {
    hdb::HdbSettings settings;
    settings.edges_mm = hdb::hdbEdges(partition->bounds);
    settings.query = query;
    costs.rows.push_back(
        measureListRow(surface, hdb::makeHdbSurface(surface, partition, settings), strokes, expected, plan));
  }
}

}  // namespace

ListCosts measureLists(const ListPlan& plan) {
  ListCosts costs;
  for (const std::size_t model : plan.models) measureModel(model, plan, costs);
  return costs;
}

const ListRow* findListRow(const ListCosts& costs, std::size_t model, HdbQuery query) {
  for (const ListRow& row : costs.rows) {
    if (row.model == model && row.query == query) return &row;
  }
  return nullptr;
}

}  // namespace palpate::study

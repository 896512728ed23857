// One slide over the surface runs each way of finding in turn: ranges, their triangles, leaves. The list that follows
// has slides of its own; of these and of builds the shortest time counts, since other load only ever adds.
#include "lab/runs/partition_run.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "lab/counters/thread_counts.h"
#include "lab/runs/partition_statistics.h"
#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/base/random.h"
#include "palpate/base/stopwatch.h"
#include "palpate/hdb/haptic_box.h"
#include "palpate/hdb/linked_triangles.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::bench {

namespace {

using hdb::Partition;

constexpr double kTickS = 1e-3;
// The fastest counts: other load only ever adds.
constexpr int kBuilds = 3;
constexpr int kSlides = 3;

Vec3 randomVertex(const mesh::TriangleMesh& mesh, Random& random) {
  return mesh.positions[mesh.triangles[random.below(mesh.triangles.size())][0]];
}

/// From random vertex to random vertex in straight lines, each place moved to the nearest point of the surface.
std::vector<Vec3> slidingProxies(const mesh::TriangleMesh& mesh, const PartitionRun& run) {
  const tree::TriangleTree tree = tree::buildTriangleTree(mesh);
  Random random(1);
  std::vector<Vec3> proxies;
  Vec3 place = randomVertex(mesh, random), goal = randomVertex(mesh, random);
  for (int tick = 0; tick < run.ticks; ++tick) {
    const double step = run.speed_mm_s * kTickS;
    if ((goal - place).norm() <= step) goal = randomVertex(mesh, random);
    const Vec3 way = goal - place;
    place += way * std::min(1.0, step / std::max(way.norm(), 1e-300));
    proxies.push_back(tree::nearestPoint(tree, place, 2.0 * tree.diagonal + 1.0).closest.point);
  }
  return proxies;
}

Partition fastestBuild(const mesh::TriangleMesh& mesh, const PartitionRun& run, double& ns_per_triangle) {
  double best_us = 1e300;
  Partition built;
  for (int i = 0; i < kBuilds; ++i) {
    built = {};
    const auto start = Clock::now();
    built = hdb::buildPartition(mesh, run.settings);
    best_us = std::min(best_us, microsecondsSince(start));
  }
  ns_per_triangle = 1e3 * best_us / static_cast<double>(mesh.triangles.size());
  return built;
}

struct Samples {
  std::vector<double> query, ranges, leaves;
  explicit Samples(std::size_t ticks) : query(ticks), ranges(ticks), leaves(ticks) {}
};

void measureQueries(const Partition& built, const std::vector<Vec3>& proxies, Samples& samples,
                    PartitionFigures& figures) {
  hdb::TriangleHits exact;
  hdb::LeafHits leaves;
  exact.prepareFor(built);
  leaves.prepareFor(built);
  Hash hash;
  const auto before = lab::allocationsOfThisThread();
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    const Box3 box = hdb::hapticBox(proxies[i], figures.edge_mm);
    auto start = Clock::now();
    hdb::findTriangles(built, box, exact);
    samples.ranges[i] = microsecondsSince(start);
    hdb::listTriangles(built, exact);
    samples.query[i] = microsecondsSince(start);
    start = Clock::now();
    hdb::findLeaves(built, box, leaves);
    samples.leaves[i] = microsecondsSince(start);

    const std::size_t rendered = hdb::entriesIn(built, leaves.leaves);
    figures.mean_triangles += static_cast<double>(exact.triangles.size());
    figures.mean_ranges += static_cast<double>(exact.ranges.size());
    figures.mean_rendered += static_cast<double>(rendered);
    for (const std::size_t count : {exact.triangles.size(), exact.ranges.size(), rendered}) {
      hash.add(static_cast<std::uint64_t>(count));
    }
  }
  if (before) figures.allocations = *lab::allocationsOfThisThread() - *before;
  figures.hash = hash.value();
  for (double* mean : {&figures.mean_triangles, &figures.mean_ranges, &figures.mean_rendered}) {
    *mean /= static_cast<double>(proxies.size());
  }
}

/// The times of one slide, in us.
void slide(const Partition& built, const std::vector<Vec3>& proxies, const PartitionRun& run, double edge,
           hdb::CoherentList& list, std::vector<double>& times) {
  list.prepareFor(built);
  list.refreshes = 0;
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    const auto start = Clock::now();
    hdb::follow(list, built, hdb::hapticBox(proxies[i], edge), run.margin);
    times[i] = std::min(times[i], microsecondsSince(start));
  }
}

/// Each tick's shortest time in a few slides counts, of those after the first, which is warm-up.
void measureHybrid(const Partition& built, const std::vector<Vec3>& proxies, const PartitionRun& run,
                   PartitionFigures& figures) {
  hdb::CoherentList list;
  std::vector<double> warm_up(proxies.size(), 1e300), times = warm_up;
  slide(built, proxies, run, figures.edge_mm, list, warm_up);
  for (int i = 0; i < kSlides; ++i) slide(built, proxies, run, figures.edge_mm, list, times);
  figures.hybrid_us_per_tick = std::accumulate(times.begin(), times.end(), 0.0) / static_cast<double>(times.size());
  figures.hybrid_worst_us = *std::max_element(times.begin(), times.end());
  figures.hybrid_refreshes = list.refreshes;
}

/// Like measureHybrid. Each slide begins with the box far from where the last one ended: the first tick is not counted.
void measureLinked(const Partition& built, const std::vector<Vec3>& proxies, PartitionFigures& figures) {
  hdb::LinkedTriangles list;
  list.prepareFor(built);
  std::vector<double> times(proxies.size(), 1e300);
  times.front() = 0.0;
  for (int run = 0; run <= kSlides; ++run) {
    hdb::moveTo(list, built, hdb::hapticBox(proxies.front(), figures.edge_mm));
    list.boxes_moved = 0;
    for (std::size_t i = 1; i < proxies.size(); ++i) {
      const auto start = Clock::now();
      hdb::moveTo(list, built, hdb::hapticBox(proxies[i], figures.edge_mm));
      if (run > 0) times[i] = std::min(times[i], microsecondsSince(start));
    }
  }
  const auto ticks = static_cast<double>(proxies.size());
  figures.linked_us_per_tick = std::accumulate(times.begin(), times.end(), 0.0) / ticks;
  figures.linked_worst_us = *std::max_element(times.begin(), times.end());
  figures.linked_boxes = static_cast<double>(list.boxes_moved) / ticks;
}

}  // namespace

PartitionFigures measurePartition(const mesh::TriangleMesh& mesh, const PartitionRun& run) {
  if (mesh.triangles.empty()) throw Error("bench partition: the mesh has no triangles");
  PartitionFigures figures;
  figures.triangles = mesh.triangles.size();
  const Partition built = fastestBuild(mesh, run, figures.build_ns_per_triangle);
  figures.edge_mm = hdb::hdbEdges(built.bounds).x();
  figures.bytes_per_triangle = static_cast<double>(statisticsOf(built).bytes) / static_cast<double>(figures.triangles);
  const std::vector<Vec3> proxies = slidingProxies(mesh, run);
  Samples samples(proxies.size());
  measureQueries(built, proxies, samples, figures);
  measureHybrid(built, proxies, run, figures);
  measureLinked(built, proxies, figures);
  figures.hdb_query_us = lab::computePercentiles(std::move(samples.query));
  figures.ranges_us = lab::computePercentiles(std::move(samples.ranges));
  figures.leaves_us = lab::computePercentiles(std::move(samples.leaves));
  return figures;
}

std::vector<Box3> slidingBoxes(const mesh::TriangleMesh& mesh, const PartitionRun& run) {
  const Vec3 edges = hdb::hdbEdges(mesh::boundingBox(mesh));
  std::vector<Box3> boxes;
  for (const Vec3& proxy : slidingProxies(mesh, run)) boxes.push_back(hdb::hapticBox(proxy, edges));
  return boxes;
}

}  // namespace palpate::bench

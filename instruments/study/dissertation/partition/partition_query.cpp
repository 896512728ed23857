#include "dissertation/partition/partition_report.h"

#include <algorithm>
#include <chrono>

#include "palpate/base/stopwatch.h"

namespace palpate::app {

using hdb::LeafHits;
using hdb::Partition;

namespace {

constexpr int kRounds = 1000;
constexpr double kMaxSeconds = 0.5;  // for each of the two queries

/// The times of up to kRounds calls in us.
template <class Call>
lab::Percentiles measureTimes(const Call& call) {
  call();  // warm
  std::vector<double> times;
  const auto end = Clock::now() + std::chrono::duration<double>(kMaxSeconds);
  while (times.size() < kRounds && (times.empty() || Clock::now() < end)) {
    const auto start = Clock::now();
    call();
    times.push_back(microsecondsSince(start));
  }
  return lab::computePercentiles(std::move(times));
}

double radiusIn(const Box3& box) { return 0.5 * box.sizes().x(); }

void findLeavesBy(const LeafSearch& search, const Partition& partition, const Box3& box, LeafHits& hits) {
  if (search.literal) return findLeavesLiterally(partition, *search.literal, box, hits);
  if (search.sphere) return findLeavesInSphere(partition, box.center(), radiusIn(box), hits);
  findLeaves(partition, box, hits);
}

bool mustBeFound(const Box3& triangle, const Box3& box, bool by_sphere) {
  if (by_sphere) return triangle.squaredExteriorDistance(box.center()) <= radiusIn(box) * radiusIn(box);
  return (triangle.min().array() <= box.max().array()).all() && (box.min().array() <= triangle.max().array()).all();
}

std::vector<bool> foundIn(const Partition& partition, const std::vector<Index>& leaves) {
  std::vector<bool> found(partition.triangle_count, false);
  for (const Index leaf : leaves) {
    for (const Index triangle : trianglesOf(partition, partition.nodes[leaf])) found[triangle] = true;
  }
  return found;
}

/// From the mesh itself, so that nothing of the partition takes part in the verdict.
void judge(const mesh::TriangleMesh& mesh, const Box3& box, bool by_sphere, const std::vector<bool>& found,
           PartitionQuery& query) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Box3 triangle;
    for (const Index vertex : mesh.triangles[t]) triangle.extend(mesh.positions[vertex]);
    if (!mustBeFound(triangle, box, by_sphere)) continue;
    ++query.must;
    if (!found[t]) ++query.missed;
  }
}

}  // namespace

PartitionQuery askPartition(const mesh::TriangleMesh& mesh, const Partition& partition, const Box3& box,
                            const LeafSearch& search) {
  PartitionQuery query;
  query.leaves.prepareFor(partition);
  query.leaves_us = measureTimes([&] { findLeavesBy(search, partition, box, query.leaves); });
  query.rendered = entriesIn(partition, query.leaves.leaves);

  hdb::TriangleHits exact;
  exact.prepareFor(partition);
  query.exact_us = measureTimes([&] {
    findTriangles(partition, box, exact);
    listTriangles(partition, exact);
  });
  query.exact = std::move(exact.triangles);
  std::sort(query.exact.begin(), query.exact.end());

  const std::vector<bool> found = foundIn(partition, query.leaves.leaves);
  query.rendered_triangles = static_cast<std::size_t>(std::count(found.begin(), found.end(), true));
  judge(mesh, box, search.bySphere(), found, query);
  return query;
}

}  // namespace palpate::app

// Contact: the exact answer of our tree, within what single precision leaves. Boxes: brute force over slightly smaller
// and larger boxes gives the least and most that an answer may hold; a hundred boxes are checked, for each is slow.
#include "lab/peers/judge.h"

#include <algorithm>
#include <cmath>

#include "lab/literal/triangle_tests.h"
#include "palpate/base/hash.h"

namespace palpate::bench {

namespace {

/// Distances may differ by this share of the body's diagonal: coordinates in single precision leave 1e-7 of it.
constexpr double kTolerance = 2e-6;
/// A triangle that a box touches by less than this share of the box is in it for one library and not for another.
constexpr double kBoxTolerance = 1e-6;

template <class OnePeer, class Answer>
PeerFigures makePeerFigures(const OnePeer& peer, const PeerRun<Answer>& run) {
  PeerFigures figures;
  figures.name = peer.name;
  figures.package = peer.package;
  figures.queries = run.asked.size();
  figures.query_us = lab::computePercentiles(run.query_us);
  figures.build_ns_per_triangle = run.build_ns_per_triangle;
  figures.bytes_per_triangle = run.bytes_per_triangle;
  return figures;
}

/// A segment that begins or ends on the surface crosses it for the one and only touches it for the other.
bool endsOnSurface(const tree::TriangleTree& tree, const ContactQuery& query, double tolerance) {
  return tree::nearestPoint(tree, query.from, tolerance).triangle != kNoIndex ||
         tree::nearestPoint(tree, query.to, tolerance).triangle != kNoIndex;
}

bool isRight(const ContactAnswer& answer, const tree::TriangleTree& tree, const ContactQuery& query) {
  const double tolerance = kTolerance * tree.diagonal;
  const ContactAnswer exact = exactAnswer(tree, query);
  if (answer.crosses != exact.crosses && !endsOnSurface(tree, query, tolerance)) return false;
  if (std::isinf(answer.distance) && std::isinf(exact.distance)) return true;
  // One may find points just beyond the other's reach.
  return std::abs(std::min(answer.distance, query.reach) - std::min(exact.distance, query.reach)) <= tolerance;
}

void judge(const PeerRun<ContactAnswer>& run, const ContactWorld& world, std::span<const ContactQuery> queries,
           PeerFigures& figures) {
  Hash hash;
  std::size_t found = 0;
  for (std::size_t k = 0; k < run.asked.size(); ++k) {
    const ContactQuery& query = queries[run.asked[k]];
    const ContactAnswer& answer = run.answers[k];
    if (!isRight(answer, world.surface.geometry->tree, query)) ++figures.disagreements;
    if (std::isfinite(answer.distance)) {
      figures.mean_distance_mm += answer.distance / world.scale;
      ++found;
    }
    figures.hits += answer.crosses ? 1 : 0;
    hash.add(answer.distance);
    hash.add(static_cast<std::uint64_t>(answer.crosses));
  }
  if (found > 0) figures.mean_distance_mm /= static_cast<double>(found);
  figures.hash = hash.value();
}

/// Triangles that must be in a box, and those that may be.
struct Expected {
  std::size_t least = 0, most = 0;
};

bool meets(const mesh::TriangleMesh& mesh, Index t, const Box3& box, BoxTest test) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3 centre = box.center();
  const std::array<Vec3, 3> corners = {mesh.positions[a] - centre, mesh.positions[b] - centre,
                                       mesh.positions[c] - centre};
  const Vec3 half = 0.5 * box.sizes();
  if (test == BoxTest::triangle) return triangleMeetsBox<double>(corners, half);
  Box3 own(corners[0]);
  own.extend(corners[1]).extend(corners[2]);
  return own.intersects(Box3(-half, half));
}

/// `near` are the triangles whose boxes meet a slightly larger box.
Expected expected(const mesh::TriangleMesh& mesh, const std::vector<Index>& near, const Box3& box, BoxTest test) {
  const Vec3 slack = kBoxTolerance * box.sizes();
  const Box3 smaller(box.min() + slack, box.max() - slack), larger(box.min() - slack, box.max() + slack);
  Expected counts;
  for (const Index t : near) {
    counts.least += meets(mesh, t, smaller, test) ? 1 : 0;
    counts.most += meets(mesh, t, larger, test) ? 1 : 0;
  }
  return counts;
}

/// Compares counts, on a hundred boxes spread over the run, for each needs brute force.
void judge(const Peer& peer, const PeerRun<BoxAnswer>& run, const mesh::TriangleMesh& mesh, const hdb::Partition& ours,
           std::span<const Box3> boxes, PeerFigures& figures) {
  constexpr std::size_t kJudged = 100;
  const std::size_t stride = std::max<std::size_t>(1, run.asked.size() / kJudged);
  hdb::TriangleHits hits;
  hits.prepareFor(ours);
  Hash hash;
  for (std::size_t k = 0; k < run.asked.size(); ++k) {
    const BoxAnswer& answer = run.answers[k];
    figures.mean_triangles += static_cast<double>(answer.count) / static_cast<double>(run.asked.size());
    hash.add(static_cast<std::uint64_t>(answer.count));
    hash.add(answer.sum);
    if (k % stride != 0) continue;
    const Box3& box = boxes[run.asked[k]];
    const Vec3 slack = kBoxTolerance * box.sizes();
    findTriangles(ours, Box3(box.min() - slack, box.max() + slack), hits);
    listTriangles(ours, hits);
    const Expected counts = expected(mesh, hits.triangles, box, peer.box_test);
    if (answer.count < counts.least || answer.count > counts.most) ++figures.disagreements;
  }
  figures.hash = hash.value();
}

/// Every pad's distance is exact; a pad that is within rounding of touching may do as it likes.
void judge(const PeerRun<ToolAnswer>& run, const ContactWorld& world, const ToolQueries& queries,
           PeerFigures& figures) {
  const tree::TriangleTree& tree = world.surface.geometry->tree;
  const double tolerance = kTolerance * tree.diagonal;
  const auto touching = [&](std::size_t tick, double more_mm) {
    return static_cast<std::size_t>(
        std::count_if(queries.shape.pads.begin(), queries.shape.pads.end(), [&](const contact::Pad& pad) {
          return tree::nearestPoint(tree, queries.centreOf(pad, tick), pad.radius_mm + more_mm).triangle != kNoIndex;
        }));
  };
  Hash hash;
  for (std::size_t k = 0; k < run.asked.size(); ++k) {
    const std::size_t answer = run.answers[k].touching;
    figures.mean_touching += static_cast<double>(answer) / static_cast<double>(run.asked.size());
    hash.add(static_cast<std::uint64_t>(answer));
    if (answer < touching(run.asked[k], -tolerance) || answer > touching(run.asked[k], tolerance)) {
      ++figures.disagreements;
    }
  }
  figures.hash = hash.value();
}

template <class OnePeer>
PeerFigures notInstalled(const OnePeer& peer) {
  PeerFigures figures;
  figures.name = peer.name;
  figures.package = peer.package;
  figures.skipped = "not installed";
  return figures;
}

bool missing(const Peer& peer) { return peer.contact == nullptr && peer.boxes == nullptr; }

}  // namespace

std::vector<PeerFigures> comparePeers(std::span<const Peer> peers, const ContactWorld& world,
                                      std::span<const ContactQuery> queries, double seconds_per_peer) {
  const mesh::TriangleMesh mesh = extractMesh(world.surface);
  std::vector<PeerFigures> all;
  for (const Peer& peer : peers) {
    if (missing(peer)) all.push_back(notInstalled(peer));
    if (peer.contact == nullptr) continue;
    const PeerRun<ContactAnswer> run = peer.contact(mesh, queries, seconds_per_peer);
    judge(run, world, queries, all.emplace_back(makePeerFigures(peer, run)));
  }
  return all;
}

std::vector<PeerFigures> comparePeers(std::span<const Peer> peers, const mesh::TriangleMesh& mesh,
                                      std::span<const Box3> boxes, double seconds_per_peer) {
  const hdb::Partition ours = hdb::buildPartition(mesh, {});
  std::vector<PeerFigures> all;
  for (const Peer& peer : peers) {
    if (missing(peer)) all.push_back(notInstalled(peer));
    if (peer.boxes == nullptr) continue;
    const PeerRun<BoxAnswer> run = peer.boxes(mesh, boxes, seconds_per_peer);
    judge(peer, run, mesh, ours, boxes, all.emplace_back(makePeerFigures(peer, run)));
  }
  return all;
}

std::vector<PeerFigures> comparePeers(std::span<const ToolPeer> peers, const ContactWorld& world,
                                      const ToolQueries& queries, double seconds_per_peer) {
  const mesh::TriangleMesh mesh = extractMesh(world.surface);
  std::vector<PeerFigures> all;
  for (const ToolPeer& peer : peers) {
    if (peer.tool == nullptr) {
      all.push_back(notInstalled(peer));
      continue;
    }
    const PeerRun<ToolAnswer> run = peer.tool(mesh, queries, seconds_per_peer);
    judge(run, world, queries, all.emplace_back(makePeerFigures(peer, run)));
  }
  return all;
}

ContactComparison compareContact(ContactWorld& world, const device::Trajectory& trajectory,
                                 const contact::FingerSettings& real, const Window& window, std::span<const Peer> peers,
                                 double seconds_per_peer) {
  contact::check(real);
  const device::Trajectory ticks = device::resampled(trajectory, real.tick_s);
  const FingerRun run = runFinger(world.surface, contact::scaled(real, world.scale), scaledTips(ticks, world.scale));
  ContactComparison comparison;
  comparison.ours = computeFigures(world, run, real, ticks.time_s, window);
  const std::vector<ContactQuery> queries = contactQueries(world, run, real, ticks.time_s, window);
  comparison.queries = queries.size();
  comparison.nearest_asked = static_cast<std::size_t>(
      std::count_if(queries.begin(), queries.end(), [](const auto& q) { return q.reach > 0; }));
  if (!queries.empty()) comparison.peers = comparePeers(peers, world, queries, seconds_per_peer);
  return comparison;
}

}  // namespace palpate::bench

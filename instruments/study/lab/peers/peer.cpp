// Turns a run of our finger into the queries of a finger in a tick. Ends of ways that lie on the skin are lifted off it
// by less than can be felt, or "does it cross" would be decided by rounding.
#include "lab/peers/peer.h"

#include <algorithm>

namespace palpate::bench {

namespace {

/// Proxies are lifted off the skin by this share of the body's diagonal, 0.05 mm on a back: below what can be felt,
/// above the rounding of single precision.
constexpr double kLift = 1e-4;
/// A sphere at rest on the skin is at its radius from it, to rounding: this is a little more.
constexpr double kSphereReach = 1.01;
/// So that rounding does not lose the point that made the bound; the lift is added, for a tip on the skin.
constexpr double kBoundSlack = 1.001;

using contact::FingerOutput;

bool touches(const FingerOutput& output) { return output.touch != contact::Touch::free; }

ContactQuery pointQuery(const FingerOutput& before, const FingerOutput& now, double reach, double lift) {
  ContactQuery query;
  query.proxy = before.proxy;
  query.from = touches(before) ? Vec3(before.proxy + lift * before.normal) : before.tip;
  query.to = touches(before) && touches(now) ? Vec3(now.proxy + lift * now.normal) : now.tip;
  if (!touches(before) && !touches(now)) return query;
  query.point = now.tip;
  query.reach = reach;
  query.bound = touches(before) ? std::min(reach, kBoundSlack * (before.proxy - now.tip).norm() + lift) : reach;
  return query;
}

/// The centre: of a sphere that touches, where it rests; of a free one, the tip.
Vec3 centreOf(const FingerOutput& output, double radius) { return output.proxy + radius * output.normal; }

ContactQuery sphereQuery(const FingerOutput& before, const FingerOutput& now, double radius) {
  ContactQuery query;
  query.proxy = query.from = centreOf(before, radius);
  query.point = query.to = centreOf(now, radius);
  query.reach = query.bound = kSphereReach * radius;
  return query;
}

}  // namespace

std::vector<ContactQuery> contactQueries(const ContactWorld& world, const FingerRun& run,
                                         const contact::FingerSettings& finger, std::span<const double> time_s,
                                         const Window& window) {
  const contact::FingerSettings scaled = contact::scaled(finger, world.scale);
  const double lift = kLift * world.surface.geometry->tree.diagonal;
  std::vector<ContactQuery> queries;
  for (std::size_t k = 0; k < run.outputs.size(); ++k) {
    if (time_s[k] < window.from_s || time_s[k] >= window.until_s) continue;
    const FingerOutput& now = run.outputs[k];
    const FingerOutput& before = k == 0 ? now : run.outputs[k - 1];
    queries.push_back(scaled.radius_mm > 0.0 ? sphereQuery(before, now, scaled.radius_mm)
                                             : pointQuery(before, now, scaled.max_depth_mm, lift));
  }
  return queries;
}

ContactAnswer exactAnswer(const tree::TriangleTree& tree, const ContactQuery& query) {
  ContactAnswer answer;
  if (query.reach > 0.0) {
    const tree::NearestPoint nearest = tree::nearestPoint(tree, query.point, query.reach);
    if (nearest.triangle != kNoIndex) answer.distance = (nearest.closest.point - query.point).norm();
  }
  answer.crosses = tree::firstFrontCrossing(tree, query.from, query.to).triangle != kNoIndex ||
                   tree::firstFrontCrossing(tree, query.to, query.from).triangle != kNoIndex;
  return answer;
}

std::vector<Peer> peersWithoutLibraries() {
  return {{"embree", "libembree-dev"}, {"cgal", "libcgal-dev"}, {"fcl", "libfcl-dev"}, literalPeer()};
}

std::vector<ToolPeer> toolPeersWithoutLibraries() { return {{"bullet", "libbullet-dev"}, {"fcl", "libfcl-dev"}}; }

}  // namespace palpate::bench

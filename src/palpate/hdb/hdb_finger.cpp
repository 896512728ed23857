// A tick: the box follows the proxy of the last tick; the tip's motion may pass a candidate (contact starts); the god
// object follows the tip along the skin; the place of the skin under it is held by friction. When the god object gets
// to the tip, nothing is between them: let go.
//
// Where the skin ends, or the list does, nothing holds the god object: it falls towards the tip by one path bound a
// tick, so the force fades within some ticks (no more than k times the bound in one) and the finger comes free.
//
// Based on: Ji, dissertation 2008, 2.2 and 3.3.3: the haptic process sees the triangles near the proxy and no others.
#include "palpate/hdb/hdb_finger.h"

#include "palpate/contact/felt_force.h"
#include "palpate/contact/surface_walk.h"
#include "palpate/hdb/god_object.h"

namespace palpate::hdb {

namespace {

/// In standoffs: a god object this near to the skin is on it; at the bottom of a sharp crease it stands a few off.
constexpr double kOnSkin = 64.0;

bool enters(const contact::Surface& surface, HdbCandidates& candidates, const Vec3& tip, contact::FingerState& state) {
  const Vec3 from = state.tip;
  const auto& near = candidates.near(Box3(from.cwiseMin(tip), from.cwiseMax(tip)));
  const tree::Crossing entry = firstFrontCrossing(surface, near, from, tip);
  if (entry.triangle == kNoIndex) return false;
  state.touching = true;
  state.slipping = false;
  state.proxy = {entry.point, entry.triangle, tree::Feature::face};
  state.anchor = state.proxy;
  state.hold = entry.point;  // what the tip slides further within this tick is friction already
  state.centre = from;
  return true;
}

/// The skin's point nearest to the god object becomes the proxy. True when the god object is on the skin.
bool findSkinUnder(const contact::Surface& surface, const std::vector<Index>& near, contact::FingerState& state) {
  const double farthest = kOnSkin * standoff(surface);
  double nearest = farthest * farthest;
  bool found = false;
  for (const Index t : near) {
    const auto closest = tree::closestOnTriangle(surface.tree.records[t].corners, state.centre);
    if (!(closest.squared_distance < nearest)) continue;
    nearest = closest.squared_distance;
    state.proxy = {closest.point, t, closest.feature};
    found = true;
  }
  return found;
}

contact::Press pressHdb(const contact::Surface& surface, const contact::FingerSettings& settings,
                        HdbCandidates& candidates, contact::FingerState& state, const Vec3& tip) {
  candidates.refresh(state.touching ? state.centre : state.tip);
  if (!state.touching && !enters(surface, candidates, tip, state)) return {};
  const double path = contact::pathBound(settings, (tip - state.tip).norm());
  const Vec3 reach = Vec3::Constant(path + kOnSkin * standoff(surface));
  const auto& near = candidates.near(Box3(state.centre - reach, state.centre + reach));
  const Arrival arrival = moveTowards(surface, near, tip, path, state.centre);
  state.touching = arrival != Arrival::reached;
  if (!state.touching) return {};
  const bool on_skin = findSkinUnder(surface, near, state);
  const Vec3& proxy = on_skin ? state.proxy.position : state.centre;
  contact::Press press = contact::pressTowards(surface, settings, proxy, contact::normalAt(surface, state.proxy), tip);
  if (press.depth_mm > settings.max_depth_mm) press.status |= contact::kTooDeep;
  if (arrival == Arrival::under_way) press.status |= contact::kCatchingUp;
  return press;
}

}  // namespace

contact::FingerOutput stepHdb(const contact::Surface& surface, const contact::FingerSettings& settings,
                              HdbCandidates& candidates, contact::FingerState& state, const Vec3& tip) noexcept {
  if (!contact::usableTip(surface, tip)) return contact::lostOutput(state);
  if (!state.knows_tip) state.tip = tip;
  const contact::Press press = pressHdb(surface, settings, candidates, state, tip);
  const double tip_moved_mm = (tip - state.tip).norm();
  state.knows_tip = true;
  state.tip = tip;
  return contact::feltOutput(surface, settings, press, tip, tip_moved_mm, state);
}

}  // namespace palpate::hdb

// A tick: the box follows the proxy of the last tick; the tip's motion may pass a candidate (contact starts); the god
// object follows the tip along the skin; the place of the skin under it is held by friction. When the god object gets
// to the tip, nothing is between them: let go.
//
// Where the skin ends, or the list does, nothing holds the god object: it falls towards the tip by one path bound a
// tick, so the force fades within some ticks (no more than k times the bound in one) and the finger comes free.
//
// Based on: Ji, dissertation 2008, 2.2 and 3.3.3: the haptic process sees the triangles near the proxy and no others.
#include "palpate/hdb/hdb_finger.h"

#include <algorithm>

#include "palpate/contact/felt_force.h"
#include "palpate/contact/surface_walk.h"
#include "palpate/hdb/god_object.h"

namespace palpate::hdb {

namespace {

/// In standoffs: a god object this near to the skin is on it; at the bottom of a sharp crease it stands a few off.
constexpr double kOnSkin = 64.0;

bool enters(const contact::Surface& surface, HdbCandidates& candidates, const Vec3& tip, HdbFingerState& state) {
  const Vec3 from = state.finger.tip;
  const auto& near = candidates.near(Box3(from.cwiseMin(tip), from.cwiseMax(tip)));
  const tree::Crossing entry = firstFrontCrossing(surface, near, from, tip);
  if (entry.triangle == kNoIndex) return false;
  state.finger.touching = true;
  state.finger.slipping = false;
  state.finger.proxy = {entry.point, entry.triangle, tree::Feature::face};
  state.finger.anchor = state.finger.proxy;  // what the tip slides further within this tick is friction already
  state.place = from;
  return true;
}

/// The skin's point nearest to the god object becomes the proxy. True when the god object is on the skin.
bool findSkinUnder(const contact::Surface& surface, const std::vector<Index>& near, HdbFingerState& state) {
  const double farthest = kOnSkin * standoff(surface);
  double nearest = farthest * farthest;
  bool found = false;
  for (const Index t : near) {
    const auto closest = tree::closestOnTriangle(surface.tree.records[t].corners, state.place);
    if (!(closest.squared_distance < nearest)) continue;
    nearest = closest.squared_distance;
    state.finger.proxy = {closest.point, t, closest.feature};
    found = true;
  }
  return found;
}

contact::Press pressAt(const contact::Surface& surface, const contact::FingerSettings& settings, bool on_skin,
                       const HdbFingerState& state, const Vec3& tip) {
  contact::Press press;
  press.touching = true;
  press.proxy = on_skin ? state.finger.proxy.position : state.place;
  press.normal = contact::normalAt(surface, state.finger.proxy);
  const Vec3 out = press.proxy - tip;
  const double depth = out.norm();
  if (depth > directionlessDepth(surface)) {
    press.normal = out / depth;
    press.depth_mm = depth;
  }
  press.felt_depth_mm = std::min(press.depth_mm, settings.max_depth_mm);
  if (press.depth_mm > settings.max_depth_mm) press.status |= contact::kTooDeep;
  return press;
}

contact::Press pressHdb(const contact::Surface& surface, const contact::FingerSettings& settings,
                        HdbCandidates& candidates, HdbFingerState& state, const Vec3& tip) {
  candidates.refresh(state.finger.touching ? state.place : state.finger.tip);
  if (!state.finger.touching && !enters(surface, candidates, tip, state)) return {};
  const double path = contact::pathBound(settings, (tip - state.finger.tip).norm());
  const Vec3 reach = Vec3::Constant(path + kOnSkin * standoff(surface));
  const auto& near = candidates.near(Box3(state.place - reach, state.place + reach));
  const Arrival arrival = moveTowards(surface, near, tip, path, state.place);
  state.finger.touching = arrival != Arrival::reached;
  if (!state.finger.touching) return {};
  const bool on_skin = findSkinUnder(surface, near, state);
  contact::Press press = pressAt(surface, settings, on_skin, state, tip);
  if (arrival == Arrival::under_way) press.status |= contact::kCatchingUp;
  return press;
}

}  // namespace

contact::FingerOutput stepHdb(const contact::Surface& surface, const contact::FingerSettings& settings,
                              HdbCandidates& candidates, HdbFingerState& state, const Vec3& tip) noexcept {
  if (!contact::usableTip(surface, tip)) return contact::lostOutput(state.finger);
  if (!state.finger.knows_tip) state.finger.tip = tip;
  const contact::Press press = pressHdb(surface, settings, candidates, state, tip);
  state.finger.knows_tip = true;
  state.finger.tip = tip;
  if (!press.touching) return contact::freeOutput(tip);
  return contact::pressedOutput(surface, settings, press, tip, contact::holdOnSkin, state.finger);
}

}  // namespace palpate::hdb

// A tick: the box follows the proxy of the last tick; the tip's motion may pass a candidate (contact starts); the proxy
// walks towards the tip over the candidates, as the default finger's does over the whole skin, so that both feel the
// same. Where the walk has nothing to go on - the list ends, the skin ends, sheets pierce each other, the tip has come
// out - the god object decides: it starts above the proxy and is tested against every candidate. When it gets to the
// tip, nothing is between them: the finger is released.
//
// Where the skin ends, or the list does, nothing holds the god object: it falls towards the tip by one path bound a
// tick, so the force fades within some ticks (no more than k times the bound in one) and the finger comes free.
//
// Based on: Ji, dissertation 2008, 2.2 and 3.3.3: the haptic process sees the triangles near the proxy and no others.
#include "palpate/hdb/hdb_finger.h"

#include <optional>

#include "palpate/contact/border.h"
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

/// Whether the god object is above the proxy: it is not while it falls past an end of the skin.
bool isOnSkin(const contact::Surface& surface, const contact::FingerState& state) {
  const double farthest = kOnSkin * standoff(surface);
  return (state.centre - state.proxy.position).squaredNorm() < farthest * farthest;
}

/// The place of a god object above `proxy`; nothing where the skin is so sharp that it would be behind a candidate.
std::optional<Vec3> placeAbove(const contact::Surface& surface, const std::vector<Index>& near,
                               const contact::SurfacePoint& proxy) {
  const Vec3 place = proxy.position + standoff(surface) * contact::normalAt(surface, proxy);
  return isInFront(surface, near, place) ? std::optional(place) : std::nullopt;
}

/// Walks over the candidates. Nothing, and the state as it was, where only the god object knows what comes of the tick.
std::optional<contact::Press> pressOnWalk(const contact::Surface& surface, const contact::FingerSettings& settings,
                                          const std::vector<Index>& near, const Vec3& tip, double path_mm,
                                          contact::FingerState& state) {
  const contact::WalkResult walk = contact::walkOnListed(surface, near, state.proxy, tip, path_mm);
  if (walk.stopped || contact::inFrontOf(surface, walk.at, tip)) return std::nullopt;
  if (contact::beyondBorder(surface, walk.at, tip) > 0.0) return std::nullopt;
  const auto above = placeAbove(surface, near, walk.at);
  if (!above) return std::nullopt;
  state.proxy = walk.at;
  state.centre = *above;
  contact::Press press =
      contact::pressTowards(surface, settings, walk.at.position, contact::normalAt(surface, walk.at), tip);
  if (!walk.finished) press.status |= contact::kCatchingUp;
  return press;
}

/// The skin's point nearest to the god object becomes the proxy. True when the god object is on the skin.
bool findSkinUnder(const contact::Surface& surface, const std::vector<Index>& near, contact::FingerState& state) {
  const double farthest = kOnSkin * standoff(surface);
  double nearest = farthest * farthest;
  bool found = false;
  for (const Index t : near) {
    const auto closest = tree::closestOnTriangle(surface.geometry->tree.records[t].corners, state.centre);
    if (!(closest.squared_distance < nearest)) continue;
    nearest = closest.squared_distance;
    state.proxy = {closest.point, t, closest.feature};
    found = true;
  }
  return found;
}

/// Moves the god object. Not touching where it gets to the tip.
contact::Press pressOfGodObject(const contact::Surface& surface, const contact::FingerSettings& settings,
                                const std::vector<Index>& near, const Vec3& tip, double path_mm,
                                contact::FingerState& state) {
  const Arrival arrival = moveTowards(surface, near, tip, path_mm, state.centre);
  state.touching = arrival != Arrival::reached;
  if (!state.touching) return {};
  const bool found = findSkinUnder(surface, near, state);
  const Vec3& proxy = found ? state.proxy.position : state.centre;
  contact::Press press = contact::pressTowards(surface, settings, proxy, contact::normalAt(surface, state.proxy), tip);
  if (arrival == Arrival::under_way) press.status |= contact::kCatchingUp;
  return press;
}

contact::Press pressHdb(const contact::Surface& surface, const contact::FingerSettings& settings,
                        HdbCandidates& candidates, contact::FingerState& state, const Vec3& tip) {
  candidates.refresh(state.touching ? state.centre : state.tip);
  bool on_skin = state.touching && isOnSkin(surface, state);
  if (!state.touching) {
    if (!enters(surface, candidates, tip, state)) return {};
    on_skin = true;
  }
  const double path = contact::pathBound(settings, (tip - state.tip).norm());
  const Vec3 reach = Vec3::Constant(path + kOnSkin * standoff(surface));
  Box3 around(state.centre - reach, state.centre + reach);
  if (on_skin) around.extend(Box3(state.proxy.position - reach, state.proxy.position + reach));
  const auto& near = candidates.near(around);
  std::optional<contact::Press> press;
  if (on_skin) press = pressOnWalk(surface, settings, near, tip, path, state);
  if (!press) press = pressOfGodObject(surface, settings, near, tip, path, state);
  if (press->touching && press->depth_mm > settings.max_depth_mm) press->status |= contact::kTooDeep;
  return *press;
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

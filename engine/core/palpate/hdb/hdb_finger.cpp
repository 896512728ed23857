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

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "palpate/contact/border.h"
#include "palpate/contact/finger_tick.h"
#include "palpate/contact/half_spaces.h"
#include "palpate/contact/surface.h"
#include "palpate/contact/surface_walk.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::hdb {

namespace {

/// Result of a god object's tick.
enum class Arrival : std::uint8_t {
  reached,   ///< it is at the target: nothing is between them
  resting,   ///< on the skin, nearer to the target than any place it could go to
  under_way  ///< its path was used up
};

/// Distance that is kept from every plane, mm: a million times what rounding could take away, and a thousandth of what
/// could be felt. The exact test of every move, not this, keeps the object outside.
double standoff(const contact::Surface& surface) { return 1e-9 * surface.geometry->tree.diagonal; }

using tree::Crossing;
using tree::TriangleRecord;

/// Rounds of one tick. On a smooth body a tick takes two or three; a jump over many triangles continues in the next
/// tick.
constexpr int kMaxRounds = 32;
/// Planes of one round. More mean a place so tight that resting there for a tick is right.
constexpr int kMaxPlanes = 8;
/// Triangles tried one by one at a corner: a fan of usual size.
constexpr int kMaxTouched = 12;
/// In standoffs: anything nearer counts as touched, and a shorter move does not count.
constexpr double kTouching = 4.0;

contact::HalfSpace offsetFacePlane(const TriangleRecord& record, double standoff_mm) {
  const Vec3 normal = contact::faceNormal(record);
  return {normal, normal.dot(record.corners[0]) + standoff_mm};
}

/// A point that follows the tip but never passes the front of a triangle: the god object over a loose list of
/// triangles.
///
/// It knows no neighbours: every move is tested against every listed triangle, as a toolkit must that is handed
/// triangles without their neighbours. A tick uses it where a walk over the skin (contact/surface_walk.h) ends.
///
/// In each round the object heads for the target; what blocks the way becomes a plane, and the new goal is the point of
/// the planes' half-spaces nearest to the target (of any number of planes at most three decide). A way that is free is
/// gone, and the planes are forgotten: the next round finds those that matter there. It rests where the goal is where
/// it is already.
///
/// Planes go on for ever and triangles do not, so at a corner where some neighbours rise and others fall the
/// half-spaces may leave nothing although there is a way. There the object also tries the planes of the triangles that
/// it touches one by one and in pairs; every try is tested like any other way.
///
/// Based on: Zilles and Salisbury, "A constraint-based god-object method for haptic display" (1995); Ruspini, Kolarov
/// and Khatib, "The haptic display of complex graphical environments" (1997).
struct Mover {
  const contact::Surface& surface;
  std::span<const Index> triangles;
  Vec3 target;
  double path_mm;
  Vec3 place;
  double standoff_mm;

  const TriangleRecord& record(Index t) const { return surface.geometry->tree.records[t]; }
  Crossing firstOnWayTo(const Vec3& end) const {
    return firstFrontCrossingAmong(surface.geometry->tree, triangles, place, end);
  }
  double toTarget(const Vec3& point) const { return (point - target).norm(); }

  /// `goal`, or as far towards it as the path reaches.
  Vec3 endTowards(const Vec3& goal) const {
    const Vec3 way = goal - place;
    const double length = way.norm();
    return length <= path_mm ? goal : Vec3(place + (path_mm / length) * way);
  }

  void go(const Vec3& end) {
    path_mm = std::max(0.0, path_mm - (end - place).norm());
    place = end;
  }

  /// Goes as far on the way to `end` as this plane's standoff lets it. False when it is there already.
  bool approach(const contact::HalfSpace& plane, const Vec3& end) {
    const double room = plane.excess(place);
    if (room <= 0.5 * standoff_mm) return false;
    const double share = room / (room - plane.excess(end));
    const Vec3 stop = place + share * (end - place);
    if (firstOnWayTo(stop).triangle != kNoIndex) return false;
    go(stop);
    return true;
  }

  enum class Round : std::uint8_t { moved, stuck, there };

  Round slide(int& planes_met);
  bool moveAroundCorner();
};

/// One straight move, towards the target or along what is in its way.
Mover::Round Mover::slide(int& planes_met) {
  contact::HalfSpaces planes;
  Vec3 goal = target;
  for (planes_met = 0; planes_met < kMaxPlanes; ++planes_met) {
    const Vec3 end = endTowards(goal);
    const Crossing hit = firstOnWayTo(end);
    if (hit.triangle == kNoIndex) {
      go(end);
      return end == target ? Round::there : Round::moved;
    }
    const contact::HalfSpace plane = offsetFacePlane(record(hit.triangle), standoff_mm);
    if (approach(plane, end)) return Round::moved;
    planes.add(plane);
    if (!contact::nearestInside(planes, target, 1e-3 * standoff_mm, goal)) return Round::stuck;
    const bool nearer = toTarget(goal) < toTarget(place);
    if (!nearer || (goal - place).norm() <= kTouching * standoff_mm) {
      ++planes_met;
      return Round::stuck;
    }
  }
  return Round::stuck;
}

/// Tries the planes of the triangles at `place`, alone and in pairs, for a way that leads nearer to the target.
bool Mover::moveAroundCorner() {
  std::array<contact::HalfSpace, kMaxTouched> touched;
  int count = 0;
  const double reach = kTouching * standoff_mm;
  for (const Index t : triangles) {
    const auto closest = tree::closestOnTriangle(record(t).corners, place);
    if (closest.squared_distance > reach * reach || count == kMaxTouched) continue;
    touched[count++] = offsetFacePlane(record(t), standoff_mm);
  }
  Vec3 best = place;
  for (int i = 0; i < count; ++i) {
    for (int j = i; j < count; ++j) {
      contact::HalfSpaces planes;
      planes.add(touched[i]);
      if (j > i) planes.add(touched[j]);
      Vec3 goal = place;
      if (!contact::nearestInside(planes, target, 1e-3 * standoff_mm, goal)) continue;
      if (toTarget(goal) + reach >= toTarget(best)) continue;
      const Vec3 end = endTowards(goal);
      if (firstOnWayTo(end).triangle == kNoIndex) best = end;
    }
  }
  if (best == place) return false;
  go(best);
  return true;
}

/// Whether `place` is in front of each listed triangle that it touches.
bool isInFront(const contact::Surface& surface, std::span<const Index> triangles, const Vec3& place) noexcept {
  const double reach = kTouching * standoff(surface);
  return std::none_of(triangles.begin(), triangles.end(), [&](Index t) {
    const TriangleRecord& record = surface.geometry->tree.records[t];
    if (tree::closestOnTriangle(record.corners, place).squared_distance > reach * reach) return false;
    return offsetFacePlane(record, 0.0).excess(place) <= 0.0;
  });
}

/// Moves `place` towards `target`, at most `path_mm` far, along straight pieces none of which passes a listed triangle
/// (records of the tree) from front to back. Slides along one, two or three planes at a time. noexcept, no allocation.
Arrival moveTowards(const contact::Surface& surface, std::span<const Index> triangles, const Vec3& target,
                    double path_mm, Vec3& place) noexcept {
  Mover mover{surface, triangles, target, path_mm, place, standoff(surface)};
  Arrival arrival = Arrival::under_way;
  for (int round = 0; round < kMaxRounds && mover.path_mm > 0.0 && arrival == Arrival::under_way; ++round) {
    int planes_met = 0;
    const Mover::Round result = mover.slide(planes_met);
    if (result == Mover::Round::there) arrival = Arrival::reached;
    if (result == Mover::Round::stuck && (planes_met < 2 || !mover.moveAroundCorner())) arrival = Arrival::resting;
  }
  place = mover.place;
  return arrival;
}

/// In standoffs: a god object this near to the skin is on it; at the bottom of a sharp crease it is a few off.
constexpr double kOnSkin = 64.0;

bool enters(const contact::Surface& surface, HdbCandidates& candidates, const Vec3& tip, contact::FingerState& state) {
  const Vec3 from = state.tip;
  const auto& near = candidates.near(Box3(from.cwiseMin(tip), from.cwiseMax(tip)));
  const Crossing entry = firstFrontCrossingAmong(surface.geometry->tree, near, from, tip);
  if (entry.triangle == kNoIndex) return false;
  contact::land(contact::placeOf(entry), state);
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
  contact::Press press = contact::pressTowards(surface, settings, walk.at.position, walk.at, tip);
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
  contact::Press press = contact::pressTowards(surface, settings, proxy, state.proxy, tip);
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
                              HdbCandidates& candidates, contact::FingerState& state, const Vec3& tip,
                              const contact::LumpPlaces* lumps) noexcept {
  return contact::tickBy(surface, settings, state, tip, lumps,
                         [&] { return pressHdb(surface, settings, candidates, state, tip); });
}

}  // namespace palpate::hdb

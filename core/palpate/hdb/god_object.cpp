// In each round the object heads for the target; what blocks the way becomes a plane, and the new goal is the point of
// the planes' half-spaces nearest to the target (of any number of planes at most three decide). A way that is free is
// gone, and the planes are forgotten: the next round finds those that matter there. It rests where the goal is where it
// is already.
//
// Planes go on for ever and triangles do not, so at a corner where some neighbours rise and others fall the half-spaces
// may leave nothing although there is a way. There the object also tries the planes of the triangles that it touches
// one by one and in pairs; every try is tested like any other way.
//
// Based on: Zilles and Salisbury, "A constraint-based god-object method for haptic display" (1995); Ruspini, Kolarov
// and Khatib, "The haptic display of complex graphical environments" (1997).
#include "palpate/hdb/god_object.h"

#include <algorithm>
#include <array>

#include "palpate/contact/half_spaces.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::hdb {

using tree::Crossing;
using tree::TriangleRecord;

namespace {

/// Rounds of one tick. On a smooth body a tick takes two or three; a jump over many triangles goes on in the next tick.
constexpr int kMostRounds = 32;
/// Planes of one round. More mean a place so tight that resting there for a tick is right.
constexpr int kMostPlanes = 8;
/// Triangles tried one by one at a corner: a fan of usual size.
constexpr int kMostTouched = 12;
/// In standoffs: what is nearer than this is touched, and a shorter move is no move.
constexpr double kTouching = 4.0;

contact::HalfSpace planeOf(const TriangleRecord& record, double standoff_mm) {
  const Vec3 normal = mesh::areaVector2(record.corners[0], record.corners[1], record.corners[2]).stableNormalized();
  return {normal, normal.dot(record.corners[0]) + standoff_mm};
}

double excess(const contact::HalfSpace& plane, const Vec3& x) { return plane.normal.dot(x) - plane.offset; }

/// The mover of one tick.
struct Mover {
  const contact::Surface& surface;
  std::span<const Index> triangles;
  Vec3 target;
  double path_mm;
  Vec3 place;
  double standoff_mm;

  const TriangleRecord& record(Index t) const { return surface.geometry->tree.records[t]; }
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
    const double room = excess(plane, place);
    if (room <= 0.5 * standoff_mm) return false;
    const double share = room / (room - excess(plane, end));
    const Vec3 stop = place + share * (end - place);
    if (firstFrontCrossing(surface, triangles, place, stop).triangle != kNoIndex) return false;
    go(stop);
    return true;
  }

  enum class Round : std::uint8_t { moved, stuck, there };

  Round slide(int& planes_met);
  bool roundTheCorner();
};

/// One straight move, towards the target or along what is in its way.
Mover::Round Mover::slide(int& planes_met) {
  contact::HalfSpaces planes;
  Vec3 goal = target;
  for (planes_met = 0; planes_met < kMostPlanes; ++planes_met) {
    const Vec3 end = endTowards(goal);
    const tree::Crossing hit = firstFrontCrossing(surface, triangles, place, end);
    if (hit.triangle == kNoIndex) {
      go(end);
      return end == target ? Round::there : Round::moved;
    }
    const contact::HalfSpace plane = planeOf(record(hit.triangle), standoff_mm);
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
bool Mover::roundTheCorner() {
  std::array<contact::HalfSpace, kMostTouched> touched;
  int count = 0;
  const double reach = kTouching * standoff_mm;
  for (const Index t : triangles) {
    const auto closest = tree::closestOnTriangle(record(t).corners, place);
    if (closest.squared_distance > reach * reach || count == kMostTouched) continue;
    touched[count++] = planeOf(record(t), standoff_mm);
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
      if (firstFrontCrossing(surface, triangles, place, end).triangle == kNoIndex) best = end;
    }
  }
  if (best == place) return false;
  go(best);
  return true;
}

}  // namespace

tree::Crossing firstFrontCrossing(const contact::Surface& surface, std::span<const Index> triangles, const Vec3& from,
                                  const Vec3& to) noexcept {
  tree::Crossing first;
  for (const Index t : triangles) {
    tree::Crossing crossing;
    if (!tree::detail::crossingOf(surface.geometry->tree.records[t], from, to, crossing)) continue;
    crossing.triangle = t;
    const bool earlier = first.triangle == kNoIndex || crossing.fraction < first.fraction ||
                         (crossing.fraction == first.fraction && t < first.triangle);
    if (earlier) first = crossing;
  }
  return first;
}

bool isInFront(const contact::Surface& surface, std::span<const Index> triangles, const Vec3& place) noexcept {
  const double reach = kTouching * standoff(surface);
  return std::none_of(triangles.begin(), triangles.end(), [&](Index t) {
    const TriangleRecord& record = surface.geometry->tree.records[t];
    if (tree::closestOnTriangle(record.corners, place).squared_distance > reach * reach) return false;
    return excess(planeOf(record, 0.0), place) <= 0.0;
  });
}

Arrival moveTowards(const contact::Surface& surface, std::span<const Index> triangles, const Vec3& target,
                    double path_mm, Vec3& place) noexcept {
  Mover mover{surface, triangles, target, path_mm, place, standoff(surface)};
  Arrival arrival = Arrival::under_way;
  for (int round = 0; round < kMostRounds && mover.path_mm > 0.0 && arrival == Arrival::under_way; ++round) {
    int planes_met = 0;
    const Mover::Round result = mover.slide(planes_met);
    if (result == Mover::Round::there) arrival = Arrival::reached;
    if (result == Mover::Round::stuck && (planes_met < 2 || !mover.roundTheCorner())) arrival = Arrival::resting;
  }
  place = mover.place;
  return arrival;
}

}  // namespace palpate::hdb

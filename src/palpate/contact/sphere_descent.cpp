// Descent of a sphere's centre over tangent planes.
//
// From a place that fits, the next one to try is the point nearest to the tip that stays off the tangent planes at the
// feet. If skin is in the way there, its planes are added and the point is asked for again; the planes are thrown away
// as soon as a place is taken, so that no plane of a place left behind can hold the sphere. Flat walls are met exactly
// in one or two trials, curved ones to 1e-5 of the radius in three to six.
//
// Based on: Ruspini, Kolarov, Khatib, "The haptic display of complex graphical environments" (1997) for a sphere as
// proxy among planes; Kelley, "The cutting-plane method for solving convex programs" (1960).
#include "palpate/contact/sphere_descent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/contact/border.h"
#include "palpate/contact/press.h"
#include "palpate/contact/sphere_feet.h"
#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// Shares of the radius.
constexpr double kSettled = 1e-5;  ///< a centre that would move less than this stays
constexpr double kOutlook = 0.02;  ///< skin within this of the sphere takes part in the first plan
constexpr double kSlack = 1e-9;    ///< of the planes: far above rounding, far below kTight

constexpr int kMostRounds = 24;  ///< trials in a tick, about 1 us each at 40,000 triangles
constexpr int kMostPushes = 12;
constexpr int kFullTrials = 4;     ///< trials that cut further before the step is shortened
constexpr int kPathHalvings = 12;  ///< the path is used up to 1/4096

Vec3 withinPath(const SphereTask& task, const Vec3& place) {
  const Vec3 way = place - task.start;
  const double length = way.norm();
  return length > task.path ? Vec3(task.start + (task.path / length) * way) : place;
}

/// Planes of the feet at a place that fits: what the next step has to respect. Beyond a border there are none, but the
/// sheet goes on flat; otherwise the sphere would come back under it.
void planFrom(const SphereTask& task, const Vec3& centre, const Feet& feet, HalfSpaces& planes) {
  planes.clear();
  for (int i = 0; i < feet.count; ++i) planes.add(keepOff(feet.feet[i], task.radius));
  if (feet.count > 0) return;
  const SurfacePoint below = walkToNearest(task.surface, task.last, centre, kUnbounded).at;
  Foot foot;
  if (beyondBorder(task.surface, below, centre) > 0.0 && standsOn(task.surface, below, centre, foot)) {
    planes.add(keepOff(foot, task.radius));
  }
}

/// The place nearest to the tip that keeps off the planes, within the path. False when there is none.
///
/// With the path's ball as a further constraint the answer is the place nearest to some point between the start and the
/// tip, the farther along the longer the way: so that point is found by halving.
bool nextGoal(const SphereTask& task, const HalfSpaces& planes, Vec3& goal) {
  const auto reachable = [&](double share, Vec3& place) {
    return nearestInside(planes, task.start + share * (task.tip - task.start), kSlack * task.radius, place) &&
           (place - task.start).norm() <= task.path;
  };
  if (reachable(1.0, goal)) return true;
  bool any = false;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < kPathHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    Vec3 place;
    const bool within = reachable(middle, place);
    (within ? low : high) = middle;
    if (within) goal = place;
    any = any || within;
  }
  return any;
}

/// Adds the planes of what is in the way from `from` to `to`. False when nothing is; `feet` are then those at `to`.
bool addObstacles(const SphereTask& task, const Vec3& from, const Vec3& to, HalfSpaces& planes, Feet& feet) {
  const partition::Crossing crossing = firstFrontCrossing(task.surface.tree, from, to);
  if (crossing.triangle != kNoIndex) {
    const Vec3 normal = normalAt(task.surface, {crossing.point, crossing.triangle, partition::Feature::face});
    planes.add({normal, normal.dot(crossing.point) + task.radius});
    return true;
  }
  findFeet(task.surface, to, task.radius * (1.0 + kOutlook), feet);
  bool any = false;
  for (int i = 0; i < feet.count; ++i) {
    if (feet.feet[i].height >= task.radius * (1.0 - kFit)) continue;
    planes.add(keepOff(feet.feet[i], task.radius));
    any = true;
  }
  return any;
}

}  // namespace

bool isFreeWay(const SphereTask& task, const Vec3& from, const Vec3& to) noexcept {
  return firstFrontCrossing(task.surface.tree, from, to).triangle == kNoIndex;
}

bool pushOut(const SphereTask& task, Vec3& centre) noexcept {
  Feet feet;
  for (int i = 0; i < kMostPushes; ++i) {
    findFeet(task.surface, centre, task.radius, feet);
    if (feet.count == 0) return true;
    const Foot& foot = feet.feet[feet.lowest()];
    if (foot.height >= task.radius * (1.0 - kFit)) return true;
    const Vec3 next = withinPath(task, centre + (task.radius - foot.height) * foot.normal);
    if (!isFreeWay(task, centre, next)) return false;
    centre = next;
  }
  return !anyFootLower(task.surface, centre, task.radius * (1.0 - kFit));
}

bool descend(const SphereTask& task, Vec3& centre, SurfacePoint& foot) noexcept {
  Feet feet;
  HalfSpaces planes;
  const auto settle_at = [&](const Vec3& place) {
    centre = place;
    planFrom(task, centre, feet, planes);
    if (feet.count > 0) foot = feet.feet[feet.lowest()].at;
  };
  findFeet(task.surface, centre, task.radius * (1.0 + kOutlook), feet);
  settle_at(centre);
  int failures = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    Vec3 goal = centre;
    if (!nextGoal(task, planes, goal)) return false;
    if (failures > kFullTrials) goal = centre + std::exp2(kFullTrials - failures) * (goal - centre);
    if ((goal - centre).norm() <= kSettled * task.radius) return true;
    const bool nearer = (goal - task.tip).squaredNorm() < (centre - task.tip).squaredNorm();
    if (!nearer && failures == 0) return true;
    if (!nearer || addObstacles(task, centre, goal, planes, feet)) {
      ++failures;
      continue;
    }
    settle_at(goal);
    failures = 0;
  }
  return false;
}

}  // namespace palpate::contact

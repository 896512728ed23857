// Descent of a sphere's centre over tangent planes.
//
// From a place that fits, the next one to try is the point nearest to the tip that stays off the tangent planes at the
// feet. If skin is in the way there, its planes are added and the point is asked for again; the planes are thrown away
// as soon as a place is taken, so that no plane of a place left behind can hold the sphere. Flat walls are met exactly
// in one or two trials, curved ones to 1e-5 of the radius in three to six, a ridge that lets the sphere go in ten.
//
// Asking the whole skin is what costs, so several steps are first gone in thought, with the known feet following the
// centre; only the place where that ends is asked for, like any other. When it is not free, the steps are gone one by
// one.
//
// Based on: Ruspini, Kolarov, Khatib, "The haptic display of complex graphical environments" (1997) for a sphere as
// proxy among planes; Kelley, "The cutting-plane method for solving convex programs" (1960).
#include "palpate/contact/sphere_descent.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "palpate/base/elementary.h"
#include "palpate/contact/border.h"
#include "palpate/contact/press.h"
#include "palpate/contact/sphere_feet.h"
#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

namespace {

// Shares of the radius.
constexpr double kSettled = 1e-5;   ///< a centre that would move less than this stays
constexpr double kOutlook = 0.001;  ///< skin within this of the sphere takes part in the first plan
constexpr double kSlack = 1e-9;     ///< of the planes: far above rounding, far below kTight

/// Trials in a tick, about 1 us each at 40,000 triangles. To stop after two and go on in the next tick would bring
/// p99.9 from 2.6 to 2.0 times p99 (8 mm, 1,000,000 triangles), but leaves one tick in 130 behind by 10 mN or more, up
/// to 0.65 N.
constexpr int kMaxRounds = 24;
constexpr int kMaxPushes = 12;
constexpr int kFullTrials = 4;                    ///< trials that cut further before the step is shortened
constexpr int kStepsAhead = 24;                   ///< steps gone in thought before the place is asked for
constexpr int kPathTrials = 12;                   ///< to use up the path
constexpr double kPathUsed = 1.0 - 1.0 / 4096.0;  ///< share of the path that counts as all of it

Vec3 withinPath(const SphereTask& task, const Vec3& place) {
  const Vec3 way = place - task.start;
  const double length = way.norm();
  return length > task.path ? Vec3(task.start + (task.path / length) * way) : place;
}

/// Planes of the feet at a place that fits: what the next step has to respect. Beyond a border there are none, but the
/// sheet goes on flat; otherwise the sphere would come back under it. Returns the place of the border then.
std::optional<SurfacePoint> planFrom(const SphereTask& task, const Vec3& centre, const Feet& feet, HalfSpaces& planes) {
  planes.clear();
  for (int i = 0; i < feet.count; ++i) planes.add(offsetHalfSpace(feet.feet[i], task.radius));
  if (feet.count > 0) return {};
  const SurfacePoint below = walkToNearest(task.surface, task.last, centre, kUnbounded).at;
  Foot foot;
  if (!(beyondBorder(task.surface, below, centre) > 0.0) || !standsOn(task.surface, below, centre, foot)) return {};
  planes.add(offsetHalfSpace(foot, task.radius));
  return below;
}

/// The place of the planes' half-spaces nearest to the point that is `share` of the way from the start to the tip.
bool nearestTowards(const SphereTask& task, const HalfSpaces& planes, double share, Vec3& place) {
  return nearestInside(planes, task.start + share * (task.tip - task.start), kSlack * task.radius, place);
}

/// Where the straight way from `inside` to `outside` leaves the ball of that radius round `centre`, as a share.
double shareWithinBall(const Vec3& centre, double radius, const Vec3& inside, const Vec3& outside) {
  const Vec3 offset = inside - centre;
  const Vec3 way = outside - inside;
  const double a = way.squaredNorm();
  const double b = way.dot(offset);
  const double c = std::min(0.0, offset.squaredNorm() - radius * radius);
  return a > 0.0 ? (std::sqrt(b * b - a * c) - b) / a : 0.0;
}

/// The place nearest to the tip that keeps off the planes, within the path. False when there is none.
///
/// With the path's ball as a further constraint the answer is the place nearest to some point between the start and the
/// tip, the farther along the longer the way. While the same planes hold it moves along a straight line, so where that
/// line leaves the ball is usually the answer; halving helps where the planes change.
bool nextGoal(const SphereTask& task, const HalfSpaces& planes, Vec3& goal) {
  const auto way = [&](const Vec3& place) { return (place - task.start).norm(); };
  double low = 0.0;
  double high = 1.0;
  Vec3 low_place = task.start;
  Vec3 high_place = task.tip;
  if (nearestTowards(task, planes, high, high_place) && way(high_place) <= task.path) {
    goal = high_place;
    return true;
  }
  bool any = nearestTowards(task, planes, low, low_place) && way(low_place) <= task.path;
  for (int i = 0; i < kPathTrials && (!any || way(low_place) < kPathUsed * task.path); ++i) {
    const bool along_line = any && i % 3 != 2;
    const double aim = 0.5 * (1.0 + kPathUsed) * task.path;
    const double part = along_line ? shareWithinBall(task.start, aim, low_place, high_place) : 0.5;
    const double middle = low + part * (high - low);
    Vec3 place = task.tip;
    const bool within = nearestTowards(task, planes, middle, place) && way(place) <= task.path;
    (within ? low : high) = middle;
    (within ? low_place : high_place) = place;
    any = any || within;
  }
  if (any) goal = low_place;
  return any;
}

/// Adds the planes of what is in the way from `from` to `to`. False when nothing is; `feet` are then those at `to`.
bool addObstacles(const SphereTask& task, const Vec3& from, const Vec3& to, HalfSpaces& planes, Feet& feet) {
  const tree::Crossing crossing = firstCrossing(task.surface, task.nearby, from, to);
  if (crossing.triangle != kNoIndex) {
    const Vec3 normal = normalAt(task.surface, {crossing.point, crossing.triangle, tree::Feature::face});
    planes.add({normal, normal.dot(crossing.point) + task.radius});
    return true;
  }
  findFeet(task.surface, to, task.radius * (1.0 + kOutlook), feet, task.nearby);
  bool any = false;
  for (int i = 0; i < feet.count; ++i) {
    if (feet.feet[i].height >= task.radius * (1.0 - kFit)) continue;
    planes.add(offsetHalfSpace(feet.feet[i], task.radius));
    any = true;
  }
  return any;
}

bool isNearer(const SphereTask& task, const Vec3& place, const Vec3& than) {
  return (place - task.tip).squaredNorm() < (than - task.tip).squaredNorm();
}

/// Lets the feet follow to `place`. False when one is lost or the sphere sinks in at one: its plane is then added.
bool followFeet(const SphereTask& task, const Vec3& place, const Feet& feet, Feet& followed, HalfSpaces& planes) {
  bool stands = true;
  followed.count = 0;
  for (int i = 0; i < feet.count; ++i) {
    Foot& foot = followed.add() = feet.feet[i];
    if (!followFoot(task.surface, place, foot)) return false;
    if (foot.height >= task.radius * (1.0 - kFit)) continue;
    planes.add(offsetHalfSpace(foot, task.radius));
    stands = false;
  }
  return stands;
}

/// Goes on from `place`, a step away from where the feet are, as long as the feet that are known allow it. Returns
/// where that ends.
Vec3 lookAhead(const SphereTask& task, const Feet& feet, Vec3 place) {
  Feet here = feet;
  Feet followed;
  HalfSpaces planes;
  if (!followFeet(task, place, here, followed, planes)) return place;
  Vec3 goal = place;
  bool taken = true;
  for (int step = 0; step < kStepsAhead; ++step) {
    if (taken) {
      place = goal;
      here = followed;
      planFrom(task, place, here, planes);
    }
    goal = place;
    if (!nextGoal(task, planes, goal)) break;
    if ((goal - place).norm() <= kSettled * task.radius || !isNearer(task, goal, place)) break;
    const int planes_before = planes.size();
    taken = followFeet(task, goal, here, followed, planes);
    if (!taken && planes.size() == planes_before) break;  // a foot is lost
  }
  return place;
}

/// The feet at `centre` that the next step has to respect.
void feetAt(const SphereTask& task, const Vec3& centre, const StandingPlaces& standing, Feet& feet) {
  if (standing.count < 0) {
    findFeet(task.surface, centre, task.radius * (1.0 + kOutlook), feet, task.nearby);
    return;
  }
  feet.count = 0;
  for (int i = 0; i < standing.count; ++i) standsOn(task.surface, standing.places[i], centre, feet.add());
}

void remember(const Feet& feet, StandingPlaces& standing) {
  standing.count = feet.count <= StandingPlaces::kMax ? feet.count : -1;
  for (int i = 0; i < standing.count; ++i) standing.places[i] = feet.feet[i].at;
}

}  // namespace

bool isFreeWay(const SphereTask& task, const Vec3& from, const Vec3& to) noexcept {
  return firstCrossing(task.surface, task.nearby, from, to).triangle == kNoIndex;
}

bool pushOut(const SphereTask& task, Vec3& centre) noexcept {
  Feet feet;
  for (int i = 0; i < kMaxPushes; ++i) {
    findFeet(task.surface, centre, task.radius, feet, task.nearby);
    if (feet.count == 0) break;
    const Foot& foot = feet.feet[feet.lowest()];
    if (foot.height >= task.radius * (1.0 - kFit)) return true;
    const Vec3 next = withinPath(task, centre + (task.radius - foot.height) * foot.normal);
    if (!isFreeWay(task, centre, next)) return false;
    centre = next;
  }
  return !hasLowerFoot(task.surface, centre, task.radius * (1.0 - kFit), task.nearby);
}

bool descend(const SphereTask& task, Vec3& centre, SurfacePoint& foot, StandingPlaces& standing) noexcept {
  const double settled = kSettled * task.radius;
  Feet feet;
  HalfSpaces planes;
  int failures = 0;
  double longest = kUnbounded;
  const auto settle_at = [&](const Vec3& place) {
    centre = place;
    const std::optional<SurfacePoint> border = planFrom(task, centre, feet, planes);
    if (feet.count > 0) foot = feet.feet[feet.lowest()].at;
    if (border) foot = *border;
    remember(feet, standing);
    failures = 0;
    longest = kUnbounded;
  };
  feetAt(task, centre, standing, feet);
  settle_at(centre);
  double tried = 0.0;
  for (int round = 0; round < kMaxRounds; ++round) {
    Vec3 goal = centre;
    const bool any = nextGoal(task, planes, goal);
    const double length = (goal - centre).norm();
    if (!any || length <= settled) {
      if (failures == 0 || 0.5 * tried <= settled) return any;
      // The planes of what is in the way farther on leave no way at all: as much of the way as is open, then.
      longest = 0.5 * tried;
      failures = 0;
      feetAt(task, centre, standing, feet);
      planFrom(task, centre, feet, planes);
      continue;
    }
    if (failures > kFullTrials) goal = centre + elementary::exp2(kFullTrials - failures) * (goal - centre);
    if (length > longest) goal = centre + (longest / length) * (goal - centre);
    const bool nearer = isNearer(task, goal, centre);
    if (!nearer && failures == 0) return true;
    if (failures == 0 && longest == kUnbounded) goal = lookAhead(task, feet, goal);
    tried = (goal - centre).norm();
    if (!nearer || addObstacles(task, centre, goal, planes, feet)) {
      ++failures;
      continue;
    }
    settle_at(goal);
  }
  return false;
}

}  // namespace palpate::contact

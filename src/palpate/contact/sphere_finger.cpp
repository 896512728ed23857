// One tick of a sphere finger.
//
// The centre C is a local minimum of |x - D| over the places where the sphere fits: in front of the skin and nowhere
// nearer to it than the radius. It gets there by descent, from C of the last tick: every place it takes fits, every one
// is nearer to the tip than the one before, the straight way between two of them crosses no skin, and all together they
// stay within the path bound. So it cannot fall through and cannot swing, whatever happens: when the rounds are used
// up, C is still a good place and the next tick goes on from there.
//
// Where to try next: first the place of a sphere that touches in one point (exact, nine ticks of ten); then the point
// nearest to the tip that stays off the tangent planes at the feet, cut down by further planes while it does not fit.
//
// Based on: Ruspini, Kolarov, Khatib, "The haptic display of complex graphical environments" (1997) for the sphere as
// proxy; Kelley, "The cutting-plane method for solving convex programs" (1960).
#include "palpate/contact/sphere_finger.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/contact/sphere_feet.h"
#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
// All shares of the radius.
constexpr double kFit = 1e-4;    ///< a sphere fits while it sinks in less than this
constexpr double kTight = 1e-5;  ///< what a single contact may sink in, so that curvature does not feed the slack above
constexpr double kSettled = 1e-5;  ///< a centre that would move less than this stays
constexpr double kTouches = 1e-3;  ///< skin within this of the sphere is touched
constexpr double kOutlook = 0.05;  ///< skin within this of the sphere takes part in the first plan
constexpr double kSlack = 1e-9;    ///< of the planes: far above rounding, far below kTight
constexpr int kMostRounds = 24;    ///< trials in a tick; about 1 us each at 40,000 triangles
constexpr int kMostPushes = 12;
constexpr int kFullTrials = 4;  ///< trials that cut further before the step is shortened
constexpr int kMostAdvances = 32;
constexpr int kPathHalvings = 12;

/// What does not change during one tick.
struct Task {
  const Surface& surface;
  double radius;
  Vec3 tip;
  Vec3 start;   ///< the centre when the tick began
  double path;  ///< how far from `start` the centre may go
};

bool isFree(const Task& task, const Vec3& from, const Vec3& to) {
  return firstFrontCrossing(task.surface.tree, from, to).triangle == kNoIndex;
}

Vec3 withinPath(const Task& task, const Vec3& place) {
  const Vec3 way = place - task.start;
  const double length = way.norm();
  return length > task.path ? Vec3(task.start + (task.path / length) * way) : place;
}

// --- First contact
// ----------------------------------------------------------------------------------------------------

/// Whether the sphere at `centre` sinks into a front side that can be seen from its centre. From inside a body the
/// fronts of other parts may be near, but only through the body.
bool overlapsVisibleFront(const Surface& surface, const Vec3& centre, double radius) {
  const partition::NearestPoint front = nearestFront(surface, centre, radius);
  if (front.triangle == kNoIndex) return false;
  const SurfacePoint foot{front.closest.point, front.triangle, front.closest.feature};
  const auto hidden = firstFrontCrossingIf(surface.tree, foot.position, centre,
                                           [&](Index t) { return !touchesFeature(surface, t, foot); });
  return hidden.triangle == kNoIndex;
}

/// Where a sphere that moves from `from` to `to` first touches: steps that the distance to the skin allows.
Vec3 advance(const Surface& surface, const Vec3& from, const Vec3& to, double radius) {
  Vec3 centre = from;
  for (int i = 0; i < kMostAdvances; ++i) {
    const double left = (to - centre).norm();
    const partition::NearestPoint front = nearestFront(surface, centre, radius + left);
    if (left == 0.0 || front.triangle == kNoIndex) break;
    const double room = std::sqrt(front.closest.squared_distance) - radius;
    if (room <= kTight * radius) break;
    centre += std::min(1.0, room / left) * (to - centre);
  }
  return centre;
}

bool lands(const Surface& surface, double radius, FingerState& state, const Vec3& tip) {
  const bool centre_enters = firstFrontCrossing(surface.tree, state.tip, tip).triangle != kNoIndex;
  if (!centre_enters && !overlapsVisibleFront(surface, tip, radius)) return false;
  state.centre = advance(surface, state.tip, tip, radius);
  const partition::NearestPoint foot = nearestFront(surface, state.centre, kUnbounded);
  if (foot.triangle == kNoIndex) return false;
  state.touching = true;
  state.slipping = false;
  state.proxy = {foot.closest.point, foot.triangle, foot.closest.feature};
  state.anchor = state.proxy;
  state.hold = state.proxy.position;
  return true;
}

// --- Descent
// ----------------------------------------------------------------------------------------------------------

/// Moves a centre that does not fit straight out of the skin. True when it fits in the end.
bool pushOut(const Task& task, Vec3& centre) {
  for (int i = 0; i < kMostPushes; ++i) {
    const partition::NearestPoint front = nearestFront(task.surface, centre, task.radius * (1.0 - kFit));
    if (front.triangle == kNoIndex) return true;
    const double distance = std::sqrt(front.closest.squared_distance);
    const SurfacePoint foot{front.closest.point, front.triangle, front.closest.feature};
    const Vec3 out = distance > directionlessDepth(task.surface) ? Vec3((centre - foot.position) / distance)
                                                                 : normalAt(task.surface, foot);
    const Vec3 next = withinPath(task, centre + (task.radius - distance) * out);
    if (!isFree(task, centre, next)) return false;
    centre = next;
  }
  return !anyFrontNearer(task.surface, centre, task.radius * (1.0 - kFit));
}

/// The centre of a sphere that touches only where a point finger's proxy would be. True when it fits and may be taken.
bool touchesInOnePoint(const Task& task, const Vec3& centre, const SurfacePoint& last, Vec3& single,
                       SurfacePoint& foot) {
  const WalkResult walk = walkToNearest(task.surface, last, task.tip, kUnbounded);
  foot = walk.at;
  const Vec3 normal = normalAt(task.surface, foot);
  const Vec3 to_tip = task.tip - foot.position;
  const double distance = to_tip.norm();
  const bool in_front = to_tip.dot(normal) > 0.0;
  if (in_front && distance >= task.radius) {
    single = task.tip;
  } else if (distance > directionlessDepth(task.surface)) {
    single = foot.position + ((in_front ? task.radius : -task.radius) / distance) * to_tip;
  } else {
    single = foot.position + task.radius * normal;
  }
  return walk.finished && (single - task.start).norm() <= task.path &&
         !anyFrontNearer(task.surface, single, task.radius * (1.0 - kTight)) && isFree(task, centre, single);
}

/// Planes of the feet for a sphere at a place that fits: what its next step has to respect.
void planFrom(const Feet& feet, double radius, HalfSpaces& planes) {
  planes.clear();
  for (int i = 0; i < feet.count; ++i) planes.add(keepOff(feet.feet[i], radius));
}

/// The place nearest to the tip that keeps off the planes, within the path. False when there is none.
///
/// With the path's ball as a further constraint the answer is the place nearest to some point between the start and the
/// tip, the farther along the longer the way: so that point is found by halving.
bool plan(const Task& task, const HalfSpaces& planes, Vec3& goal) {
  const double slack = kSlack * task.radius;
  const auto reachable = [&](double share, Vec3& place) {
    return nearestInside(planes, task.start + share * (task.tip - task.start), slack, place) &&
           (place - task.start).norm() <= task.path;
  };
  if (reachable(1.0, goal)) return true;
  bool any = false;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < kPathHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    Vec3 place;
    if (reachable(middle, place)) {
      low = middle;
      goal = place;
      any = true;
    } else {
      high = middle;
    }
  }
  return any;
}

/// Adds what is in the way of going from `from` to `to`. False when nothing is: `feet` are then those at `to`.
bool addObstacles(const Task& task, const Vec3& from, const Vec3& to, HalfSpaces& planes, Feet& feet) {
  const partition::Crossing crossing = firstFrontCrossing(task.surface.tree, from, to);
  if (crossing.triangle != kNoIndex) {
    const Vec3 normal = normalAt(task.surface, {crossing.point, crossing.triangle, partition::Feature::face});
    planes.add({normal, normal.dot(crossing.point) + task.radius});
    return true;
  }
  findFeet(task.surface, to, task.radius * (1.0 + kOutlook), feet);
  bool any = false;
  for (int i = 0; i < feet.count; ++i) {
    if (feet.feet[i].distance >= task.radius * (1.0 - kFit)) continue;
    planes.add(keepOff(feet.feet[i], task.radius));
    any = true;
  }
  return any;
}

/// Brings a centre that fits as near to the tip as the rounds allow. True when it is a local minimum.
bool descend(const Task& task, Vec3& centre) {
  Feet feet;
  HalfSpaces planes;
  findFeet(task.surface, centre, task.radius * (1.0 + kOutlook), feet);
  planFrom(feet, task.radius, planes);
  int failures = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    Vec3 goal = centre;
    if (!plan(task, planes, goal)) return false;
    if (failures > kFullTrials) goal = centre + std::exp2(kFullTrials - failures) * (goal - centre);
    if ((goal - centre).norm() <= kSettled * task.radius) return true;
    const bool nearer = (goal - task.tip).squaredNorm() < (centre - task.tip).squaredNorm();
    if (!nearer && failures == 0) return true;
    if (!nearer || addObstacles(task, centre, goal, planes, feet)) {
      ++failures;
      continue;
    }
    centre = goal;
    planFrom(feet, task.radius, planes);
    failures = 0;
  }
  return false;
}

// --- Too deep
// ---------------------------------------------------------------------------------------------------------

/// Gives the centre up for a place much nearer to the tip, or for the tip when that is outside.
void escapeTooDeep(const Task& task, Vec3& centre, FingerState& state, std::uint32_t& status) {
  status |= kTooDeep;
  const double lag = (centre - task.tip).norm() - task.radius;
  const partition::NearestPoint nearest = nearestPoint(task.surface.tree, task.tip, lag);
  if (nearest.triangle == kNoIndex) return;
  const SurfacePoint place{nearest.closest.point, nearest.triangle, nearest.closest.feature};
  const Vec3 normal = normalAt(task.surface, place);
  const bool outside = !onBorder(task.surface, place) && (task.tip - place.position).dot(normal) > 0.0;
  if (!outside && std::sqrt(nearest.closest.squared_distance) >= 0.5 * lag) return;
  const Task anywhere{task.surface, task.radius, task.tip, task.tip, kUnbounded};
  Vec3 candidate = outside ? task.tip : Vec3(place.position + task.radius * normal);
  if (!pushOut(anywhere, candidate)) return;
  centre = candidate;
  state.proxy = state.anchor = place;
  state.hold = place.position;
  state.slipping = false;
  status |= kReseeded;
}

// --- The tick
// ---------------------------------------------------------------------------------------------------------

/// Moves the centre for this tick and returns the status of how it went.
std::uint32_t moveCentre(const Task& task, Vec3& centre, SurfacePoint& last) {
  if (!pushOut(task, centre)) return kStartedInside;
  Vec3 single;
  SurfacePoint foot;
  if (touchesInOnePoint(task, centre, last, single, foot)) {
    centre = single;
    last = foot;
    return 0;
  }
  const bool settled = descend(task, centre);
  const bool used_up = (centre - task.start).norm() >= task.path * (1.0 - kSlack);
  return (settled ? 0u : kUnsettled) | (used_up ? kCatchingUp : 0u);
}

Press pressWith(const FingerSettings& settings, const Task& task, const Vec3& centre, FingerState& state,
                std::uint32_t status) {
  Press press;
  press.touching = true;
  press.status = status;
  const Vec3 out = centre - task.tip;
  press.depth_mm = out.norm();
  const partition::NearestPoint foot = nearestFront(task.surface, centre, task.radius * (1.0 + kTouches));
  if (foot.triangle != kNoIndex) state.proxy = {foot.closest.point, foot.triangle, foot.closest.feature};
  if (press.depth_mm > directionlessDepth(task.surface)) {
    press.normal = out / press.depth_mm;
  } else {
    press.normal = (centre - state.proxy.position).stableNormalized();
    press.depth_mm = 0.0;
  }
  press.proxy = centre - task.radius * press.normal;
  press.felt_depth_mm = std::min(press.depth_mm, settings.max_depth_mm + task.radius);
  state.proxy = walkToNearest(task.surface, state.proxy, press.proxy, kUnbounded).at;
  return press;
}

}  // namespace

Press pressSphere(const Surface& surface, const FingerSettings& settings, double radius, FingerState& state,
                  const Vec3& tip) noexcept {
  if (!state.touching && !lands(surface, radius, state, tip)) return {};
  const Task task{surface, radius, tip, state.centre, pathBound(settings, (tip - state.tip).norm())};
  Vec3 centre = state.centre;
  std::uint32_t status = moveCentre(task, centre, state.proxy);
  if ((centre - tip).norm() - radius > settings.max_depth_mm) escapeTooDeep(task, centre, state, status);
  state.centre = centre;
  if (centre == tip && (status & kStartedInside) == 0) {
    state.touching = false;
    return {};
  }
  return pressWith(settings, task, centre, state, status);
}

}  // namespace palpate::contact

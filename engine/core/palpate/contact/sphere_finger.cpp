// One tick of a sphere finger: when a free sphere first touches, where its centre goes from there, how it presses.
//
// Data flow: step (finger.cpp) -> pressSphere (here) -> Press -> friction and force (felt_force.cpp).
//
// The centre C is a local minimum of |x - D| over the places where the sphere fits, reached from C of the last tick.
// Nine ticks of ten on a back are settled directly: the sphere touches in one point, the place where a point finger's
// proxy would be, and the sphere stands on it exactly. The rest (valleys, folds, small bumps) descends
// (sphere_feet.h).
//
// The contact ends when C reaches D, so the force leaves as continuously as it came.
//
// Based on: Ruspini, Kolarov, Khatib, "The haptic display of complex graphical environments" (1997) for the proxy with
// a radius; Mirtich, "Impulse-based dynamic simulation of rigid body systems" (1996) for the conservative advancement
// to the first contact.
#include <algorithm>
#include <cmath>

#include "palpate/contact/border.h"
#include "palpate/contact/finger.h"
#include "palpate/contact/press.h"
#include "palpate/contact/sides.h"
#include "palpate/contact/sphere_descent.h"
#include "palpate/contact/sphere_feet.h"
#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

namespace {

// ---- first contact --------------------------------------------------------------------------------------------------

/// Steps of one advance, and the share of the radius that counts as there.
constexpr int kMaxAdvances = 32;
constexpr double kArrived = 1e-5;

/// Whether the skin lies between the centre and the foot. From inside a body the fronts of other parts may be near, but
/// only through the body. The way begins off the foot: a sheet that lies in its plane is not between.
bool isHidden(const Surface& surface, const SurfacePoint& foot, const Vec3& centre) {
  constexpr double kOffTheFoot = 1e-6;
  const Vec3 begin = foot.position + kOffTheFoot * (centre - foot.position);
  return firstFrontCrossingIf(surface.geometry->tree, begin, centre, [&](Index t) {
           return !hasFeatureAt(surface, t, foot);
         }).triangle != kNoIndex;
}

/// Whether a sphere is beside an open sheet and reaches into its edge: it comes from the side, where there is nothing
/// to stand on. A contact that began there could not be pushed out of the skin and would hang at the edge.
bool reachesIntoEdge(const Surface& surface, const Vec3& centre, double radius) {
  if (surface.geometry->closed) return false;
  const tree::NearestPoint nearest = nearestPoint(surface.geometry->tree, centre, radius * (1.0 - kFit));
  if (nearest.triangle == kNoIndex) return false;
  const SurfacePoint edge{nearest.closest.point, nearest.triangle, nearest.closest.feature};
  if (!onBorder(surface, edge)) return false;
  return beyondBorder(surface, edge, centre) > 0.0 || (centre - edge.position).dot(normalAt(surface, edge)) < 0.0;
}

bool overlapsFront(const Surface& surface, const Vec3& centre, double radius, const NearbySkin* nearby) {
  Feet feet;
  findFeet(surface, centre, radius, feet, nearby);
  for (int i = 0; i < feet.count; ++i) {
    const Foot& foot = feet.feet[i];
    // From beyond a border the sheet is not felt: passing beside it must not catch.
    const bool felt = beyondBorder(surface, foot.at, centre) == 0.0;
    if (felt && !isHidden(surface, foot.at, centre)) return true;
  }
  return false;
}

/// Where a sphere that moves from `from` to `to` first touches: steps as long as the distance to the skin allows.
Vec3 advance(const Surface& surface, const Vec3& from, const Vec3& to, double radius) {
  Vec3 centre = from;
  for (int i = 0; i < kMaxAdvances; ++i) {
    const double left = (to - centre).norm();
    if (left == 0.0) break;
    const SurfacePoint front = nearestFront(surface, centre, radius + left);
    if (front.triangle == kNoIndex) break;
    const double room = (front.position - centre).norm() - radius;
    if (room <= kArrived * radius) break;
    centre += std::min(1.0, room / left) * (to - centre);
  }
  return centre;
}

void beginContact(const Vec3& centre, const SurfacePoint& foot, FingerState& state) {
  land(foot, state);
  state.fits = false;  // to be seen
  state.centre = centre;
}

/// Decides whether a free sphere touches in this tick: when its centre's way crosses the skin, or when it overlaps the
/// front of the skin at the end. If so, starts the contact in `state` with the centre where it first touched; a sphere
/// that overlaps from the beginning starts with its centre at the tip, to be pushed out.
bool landSphere(const Surface& surface, double radius, FingerState& state, const Vec3& tip, const NearbySkin* nearby) {
  const tree::Crossing entry = firstCrossing(surface, nearby, state.tip, tip);
  const bool enters = entry.triangle != kNoIndex;
  if (!enters && !overlapsFront(surface, tip, radius, nearby)) return false;
  // A tip that was inside comes out first: then the contact starts where it is out.
  const tree::Crossing exit = tree::firstFrontCrossing(surface.geometry->tree, enters ? entry.point : tip, state.tip);
  const Vec3 outside = exit.triangle == kNoIndex ? state.tip : (enters ? exit.point : tip);
  Vec3 centre = advance(surface, outside, tip, radius);
  SurfacePoint foot = nearestFront(surface, centre, kUnbounded);
  // It comes from beside an open sheet, or from behind it round the edge: then from where it is over the sheet.
  if (foot.triangle == kNoIndex || reachesIntoEdge(surface, centre, radius)) {
    centre = enters ? entry.point : tip;
    if (reachesIntoEdge(surface, centre, radius)) return false;
    foot = nearestFront(surface, centre, kUnbounded);
  }
  if (foot.triangle == kNoIndex || (state.from_inside && isBuried(surface, centre))) return false;
  beginContact(centre, foot, state);
  return true;
}

/// The same for a tip that a border has just released: whether its sphere overlaps other skin there. Past the opening
/// it may be free.
bool landInPlace(const Surface& surface, double radius, FingerState& state, const Vec3& tip, const NearbySkin* nearby) {
  const bool lands = !isPastAnOpening(surface, tip) && !reachesIntoEdge(surface, tip, radius) &&
                     overlapsFront(surface, tip, radius, nearby);
  if (lands) beginContact(tip, nearestFront(surface, tip, radius), state);
  return lands;
}

// ---- the centre in contact ------------------------------------------------------------------------------------------

/// How the centre moved in this tick.
struct Move {
  Vec3 centre;
  SurfacePoint under_tip;  ///< the place of the skin that a point finger would press
  SurfacePoint foot;       ///< the place that the sphere stands on; the last one when it is in the air
  std::uint32_t status = 0;
  bool on_one_place = false;  ///< it stands on `under_tip` and nowhere else
};

/// The centre of a sphere that stands on `foot` only.
Vec3 centreOver(const SphereTask& task, const SurfacePoint& foot) {
  const Vec3 normal = normalAt(task.surface, foot);
  const Vec3 to_tip = task.tip - foot.position;
  const double distance = to_tip.norm();
  const double above = to_tip.dot(normal);
  if (beyondBorder(task.surface, foot, task.tip) > 0.0) return task.tip + std::max(0.0, task.radius - above) * normal;
  if (above > 0.0 && distance >= task.radius) return task.tip;
  if (distance <= directionlessDepth(task.surface)) return foot.position + task.radius * normal;
  return foot.position + ((above > 0.0 ? task.radius : -task.radius) / distance) * to_tip;
}

/// Whether the sphere fits tightly at `to` and its centre's way there from `from` is free. What may be in the way of a
/// step shorter than the radius is within the radius of its end.
bool fitsByFreeWay(const SphereTask& task, const Vec3& from, const Vec3& to) {
  const double height = task.radius * (1.0 - kTight);
  SkinList list;
  if ((to - from).squaredNorm() < height * height && listNearer(task.nearby, to, height, list)) {
    return !hasLowerFootAmong(task.surface, list, to, height) &&
           (list.count == 0 ||
            firstFrontCrossingAmong(task.surface.geometry->tree, list.all(), from, to).triangle == kNoIndex);
  }
  return !hasLowerFoot(task.surface, to, height, task.nearby) && isFreeWay(task, from, to);
}

/// Whether a sphere beyond a border has skin under it again, away from any border: the other bank of a hole. That bank
/// then holds it instead of the sheet continued flat.
bool hasSkinAgain(const SphereTask& task, const SurfacePoint& border, const Vec3& centre) {
  if (!(beyondBorder(task.surface, border, task.tip) > 0.0)) return false;
  Feet feet;
  findFeet(task.surface, centre, task.radius * (1.0 + kFit), feet, task.nearby);
  return std::any_of(feet.feet.begin(), feet.feet.begin() + feet.count,
                     [&](const Foot& foot) { return !onBorder(task.surface, foot.at); });
}

/// Whether the sphere stands on the one place that a point finger would press. If so, moves it there.
bool standsOnOnePlace(const SphereTask& task, Move& move) {
  const WalkResult walk = walkToNearest(task.surface, task.last, task.tip, kUnbounded);
  move.under_tip = walk.at;
  const Vec3 centre = centreOver(task, walk.at);
  const bool stands =
      walk.finished && (centre - task.start).norm() <= task.path && fitsByFreeWay(task, move.centre, centre);
  if (!stands || hasSkinAgain(task, walk.at, centre)) return false;
  move.centre = centre;
  move.foot = walk.at;
  move.on_one_place = true;
  return true;
}

/// A sphere that fitted in the last tick still does: the skin does not move.
Move moveCentre(const SphereTask& task, bool fits, StandingPlaces& standing) {
  Move move{task.start, task.last, task.last, 0u};
  if (!fits) standing.count = -1;
  if (!fits && !pushOut(task, move.centre)) {
    const SurfacePoint foot = nearestFront(task.surface, move.centre, task.radius);
    if (foot.triangle != kNoIndex) move.foot = foot;
    move.status = kStartedInside;
    // A sphere that is stuck must not pull the tip inwards: it goes along with a tip that is farther out.
    const bool pulls_inwards = (move.centre - task.tip).dot(normalAt(task.surface, move.foot)) < 0.0;
    if (pulls_inwards && isFreeWay(task, move.centre, task.tip)) move.centre = task.tip;
    return move;
  }
  if (standsOnOnePlace(task, move)) {
    standing.count = -1;
    return move;
  }
  if (!descend(task, move.centre, move.foot, standing)) move.status |= kUnsettled | kCatchingUp;
  constexpr double kUsedUp = 0.9;  // planes across the path's ball may leave a little of it
  if ((move.centre - task.start).norm() >= kUsedUp * task.path) move.status |= kCatchingUp;
  return move;
}

Press pressWith(const FingerSettings& settings, const SphereTask& task, const Move& move, FingerState& state) {
  Press press;
  press.touching = true;
  press.status = move.status;
  const Vec3 out = move.centre - task.tip;
  const double depth = out.norm();
  if (depth > directionlessDepth(task.surface)) {
    press.normal = out / depth;
    press.depth_mm = depth;
  } else {
    press.normal = (move.centre - move.foot.position).stableNormalized();
  }
  press.felt_depth_mm = std::min(press.depth_mm, settings.max_depth_mm + task.radius);
  const auto fade_to = [&](double felt_depth_mm) {
    press.status |= kAtBorder;
    press.felt_depth_mm = std::min(press.felt_depth_mm, felt_depth_mm);
  };
  if (onBorder(task.surface, move.foot)) {
    const SurfacePoint& place = move.under_tip;
    const double beyond = beyondBorder(task.surface, place, task.tip);
    const Vec3 normal = normalAt(task.surface, place);
    if (beyond > 0.0) fade_to(depthAtBorder(place.position, normal, task.tip, task.radius, beyond));
    // A sphere that stands on the sheet continued flat is beyond the border, wherever the tip would press.
    const double afloat = move.on_one_place ? 0.0 : beyondBorder(task.surface, move.foot, move.centre);
    if (afloat > 0.0) fade_to(depth - afloat);
  }
  press.proxy = move.centre - task.radius * press.normal;
  state.proxy = walkToNearest(task.surface, move.foot, press.proxy, kUnbounded).at;
  return press;
}

/// Whether the way to the tip begins behind the middle of a face that the proxy lies on: the tip is inside then, or has
/// skin between. What nearly every tick finds, without a search of the tree. Not told at an edge or a corner, where a
/// way may be behind one face and out of the next, nor of sheets that pierce or touch each other.
bool startsBehindFace(const SphereTask& task, const SurfacePoint& under_proxy, const Vec3& proxy) {
  const SurfaceGeometry& geometry = *task.surface.geometry;
  if (geometry.closed || geometry.self_intersecting || geometry.touches_itself) return false;
  if (under_proxy.feature != tree::Feature::face) return false;
  constexpr double kOffTheProxy = 1e-6;
  const Vec3 begin = proxy + kOffTheProxy * (task.tip - proxy);
  return (begin - under_proxy.position).norm() <= kFit * task.radius && !inFrontOf(task.surface, under_proxy, begin);
}

/// Whether a tip came out elsewhere and is in free air, seen from where the sphere is held: by an edge that two boxes
/// share, by a gap that the sphere was pressed against and that its centre has passed, or by the back of a fold. On one
/// ordinary place the tip is behind the skin, and nothing has to be asked.
/// `under_proxy`: the skin nearest to the proxy.
bool isHeldInAir(const SphereTask& task, const Move& move, const Vec3& proxy,
                 const SurfacePoint& under_proxy) noexcept {
  const Surface& surface = task.surface;
  const double reach = (move.centre - task.tip).norm() + task.radius;  // the feet are nearer
  const auto is_in_air = [&](const Vec3& place) { return isInAir(surface, place, task.tip, reach, under_proxy); };
  if (boundsTwoSectors(surface, move.under_tip) && is_in_air(move.under_tip.position)) return true;
  if ((task.tip - move.foot.position).norm() < task.radius) return false;
  const bool ordinary = surface.geometry->entangled.empty() || surface.geometry->entangled[move.foot.triangle] == 0;
  if (move.on_one_place && ordinary && !onBorder(surface, move.foot)) return false;
  return !startsBehindFace(task, under_proxy, proxy) && is_in_air(proxy);
}

/// A tip that is inside although nothing holds its sphere: between sheets that pierce each other a way may be missed.
/// The nearest skin holds it from now on.
Press heldByNearest(const Surface& surface, const FingerSettings& settings, double radius, const Vec3& tip,
                    FingerState& state) {
  const tree::NearestPoint nearest = nearestPoint(surface.geometry->tree, tip, kUnbounded);
  state.proxy = {nearest.closest.point, nearest.triangle, nearest.closest.feature};
  const Vec3 normal = normalAt(surface, state.proxy);
  state.centre = state.proxy.position + radius * normal;
  state.fits = false;
  Press press = pressTowards(surface, settings, state.proxy.position, state.proxy, tip);
  press.status = kStartedInside;  // other skin may be nearer than the radius there
  return press;
}

/// Whether a tip that its sphere has reached is inside, though it came from outside and by no opening: only between
/// sheets that pierce each other.
bool hasFallenIn(const SphereTask& task, const Move& move, const FingerState& state) {
  const SurfaceGeometry& geometry = *task.surface.geometry;
  if (geometry.closed) return !state.from_inside && isBuried(task.surface, task.tip);
  return geometry.self_intersecting && !onBorder(task.surface, move.foot) &&
         isInside(task.surface, state, task.start, task.tip, task.radius + task.path);
}

/// Why a contact ends.
enum class Ending { none, reached, at_border, in_air };

/// Moves the sphere in contact, and says whether the contact ends with that.
Ending pressOnce(const Surface& surface, const FingerSettings& settings, double radius, const Vec3& tip,
                 FingerState& state, Press& press, const NearbySkin* nearby) {
  const double path = pathBound(settings, (tip - state.tip).norm());
  const SphereTask task{surface, radius, tip, state.centre, path, state.proxy, nearby};
  Move move = moveCentre(task, state.fits, state.standing);
  const double lag = (move.centre - tip).norm();
  const bool too_deep = lag - radius > settings.max_depth_mm;
  if (too_deep) move.status |= kTooDeep;
  state.centre = move.centre;
  state.fits = (move.status & kStartedInside) == 0;
  if (lag <= directionlessDepth(surface) && state.fits) {
    if (!hasFallenIn(task, move, state)) return Ending::reached;
    press = heldByNearest(surface, settings, radius, tip, state);
    return Ending::none;
  }
  press = pressWith(settings, task, move, state);
  if ((press.status & kAtBorder) != 0 && press.felt_depth_mm <= 0.0) return Ending::at_border;
  const bool away = too_deep ? isOutside(surface, tip, lag + radius)
                             : state.fits && isHeldInAir(task, move, press.proxy, state.proxy);
  return away && !overlapsFront(surface, tip, radius, nearby) ? Ending::in_air : Ending::none;
}

}  // namespace

Press pressSphere(const Surface& surface, const FingerSettings& settings, double radius, FingerState& state,
                  const Vec3& tip, const NearbySkin* nearby) noexcept {
  if (!state.touching) {
    if (!landSphere(surface, radius, state, tip, nearby)) return {};
    noteWhereItComesFrom(surface, state);
  }
  Press press;
  Ending ending = pressOnce(surface, settings, radius, tip, state, press, nearby);
  // A tip that a border releases may have come through the skin elsewhere on its way in this tick, and so may one that
  // its sphere has reached through an opening.
  const bool leaves_border = ending == Ending::at_border || (ending == Ending::reached && !surface.geometry->closed);
  const auto came_through = [&] {
    return tree::firstFrontCrossing(surface.geometry->tree, state.tip, tip).triangle != kNoIndex;
  };
  if (leaves_border && came_through() && landSphere(surface, radius, state, tip, nearby)) {
    ending = pressOnce(surface, settings, radius, tip, state, press, nearby);
  }
  if (ending == Ending::at_border && landInPlace(surface, radius, state, tip, nearby)) {
    ending = pressOnce(surface, settings, radius, tip, state, press, nearby);
  }
  state.touching = ending == Ending::none;
  return state.touching ? press : Press{};
}

}  // namespace palpate::contact

// Data flow: the solvers of the finger's contact -> Press -> here -> FingerOutput.
//
// The tangential spring is `stiffness_ratio` of the *secant* stiffness F_n / p. So the force points from the tip to the
// anchor when the ratio is 1, A = P + (p / F_n) F_t (E1), under every force law, and the friction limits
// mu F_n / k_t = mu p / ratio are lengths that do not depend on the law.
//
// The force is continuous by construction. Tip and proxy move apart by at most feltBound in a tick, so the depth as
// a vector does not change faster either, and where it would (the contact ended far from its proxy) it follows at that
// pace; friction takes of its own change what the normal force leaves of the step.
//
// Lumps add their force last: friction knows the press without them, and acts beside them.
#include "palpate/contact/felt_force.h"

#include <algorithm>
#include <cmath>

#include "palpate/contact/friction.h"
#include "palpate/contact/lump_force.h"
#include "palpate/contact/relaxation.h"
#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

namespace {

/// A tip this many diagonals away is a broken device, and would overflow the exact predicates in the end.
constexpr double kFarthestTip = 1e6;

/// Friction divides the step by at most this. More (a mu_static above 2.3) would keep a first contact from being felt
/// whole, for which the step has to reach as far as the tip moved; friction's own steps may then pass the bound.
constexpr double kMaxFriction = 2.5;

/// A step within this share of its bound is within it: rounding of two norms.
constexpr double kStepRounding = 1e-9;

GripLimits gripLimits(const FingerSettings& settings, const tissue::Response& tissue) {
  const double tangential_stiffness = settings.stiffness_ratio * tissue.tangential * tissue.secant_n_per_mm;
  if (!(tangential_stiffness > 0.0)) return {};
  return {settings.mu_static * tissue.force_n / tangential_stiffness,
          settings.mu_dynamic * tissue.force_n / tangential_stiffness};
}

/// The most that the force grows with the depth here, N/mm: the chord's slope or the tangent's.
double maxForceSlope(const Surface& surface, const SkinHere& here, double depth_mm, const tissue::PressedPlace& place,
                     const tissue::Response& tissue) {
  if (surface.force_law.kind == tissue::ForceLaw::Kind::linear) return here.stiffness_n_per_mm;
  return std::max(tissue.secant_n_per_mm,
                  tissue::tangentStiffness(surface.force_law, here.stiffness_n_per_mm, depth_mm, place));
}

/// A press that the skin no longer gives: the tip is out of the body and what it felt fades.
Press fadingPress(const Surface& surface, const Vec3& tip, FingerState& state) {
  state.proxy = walkToNearest(surface, state.proxy, tip, kUnbounded).at;
  Press press;
  press.proxy = state.proxy.position;
  return press;
}

/// Lets what is felt follow the press, at most `most_mm` in this tick, and puts it in place of the press's own depth.
/// Almost always that changes nothing: tip and proxy cannot move apart faster. It does where the press itself leaps:
/// a tip that comes out of the far side of a limb, a proxy that finds its way round a rim. False when nothing is felt.
bool followPress(const Surface& surface, double most_mm, const Vec3& tip, Press& press, FingerState& state) {
  const Vec3 request = press.touching ? Vec3(press.felt_depth_mm * press.normal) : Vec3::Zero();
  const Vec3 change = request - state.felt;
  const double size = change.norm();
  if (size <= most_mm * (1.0 + kStepRounding) + directionlessDepth(surface)) {
    state.felt = request;
    return press.touching;
  }
  state.felt += (most_mm / size) * change;
  if (!press.touching) press = fadingPress(surface, tip, state);
  press.felt_depth_mm = state.felt.norm();
  if (press.felt_depth_mm > directionlessDepth(surface)) press.normal = state.felt / press.felt_depth_mm;
  if (!press.touching) press.depth_mm = press.felt_depth_mm;
  press.status |= kCatchingUp | kLettingGo;
  return press.felt_depth_mm > 0.0;
}

/// Adds the surface's lumps to a press; `share` is what relaxation leaves of it.
void addLumps(const Surface& surface, const LumpPlaces* places, const Press& press, double share, double normal_n,
              FingerState& state, FingerOutput& output) noexcept {
  state.lumps = {output.tip, press.normal, press.felt_depth_mm, share};
  const LumpPush push = lumpPush(*surface.lumps, places, state.lumps);
  output.lump_force = share * (push.normal_n * press.normal + push.lateral_n);
  output.lump_share = normal_n > 0.0 ? share * push.normal_n / normal_n : 0.0;
  output.force += output.lump_force;
  output.lump = push.nearest_moving;
  if (places != nullptr && output.lump != kNoIndex) output.lump_moved_mm = places->moved_mm[output.lump];
}

/// A tip that touches nothing, and what the skin makes of having been touched.
FingerOutput leftOutput(const Surface& surface, const FingerSettings& settings, const Vec3& tip, FingerState& state) {
  FingerOutput output = freeOutput(tip);
  output.finger_mm = settings.radius_mm;
  state.lumps = {};
  if (settings.relaxation.on()) {
    recover(surface, settings, state.anchor, state.memory);
    output.dent = state.memory.dent;
  } else if (remembers(state.memory)) {
    state.memory = {};
  }
  return output;
}

}  // namespace

bool usableTip(const Surface& surface, const Vec3& tip) noexcept {
  return tip.allFinite() &&
         (tip - surface.geometry->tree.center).cwiseAbs().maxCoeff() <= kFarthestTip * surface.geometry->tree.diagonal;
}

FingerOutput freeOutput(const Vec3& tip) noexcept {
  FingerOutput output;
  output.tip = output.proxy = output.anchor = output.hold = tip;
  return output;
}

FingerOutput lostOutput(const FingerState& state) noexcept {
  FingerOutput output = freeOutput(state.tip);
  output.status = kTipLost;
  output.dent = state.memory.dent;
  return output;
}

FingerOutput feltOutput(const Surface& surface, const FingerSettings& settings, Press press, const Vec3& tip,
                        double tip_moved_mm, FingerState& state, const LumpPlaces* lumps) noexcept {
  const double most_mm = feltBound(settings, tip_moved_mm);
  // Friction at its most turns and shrinks with the normal force, which it makes longer by this factor.
  const double with_friction = std::min(std::sqrt(1.0 + settings.mu_static * settings.mu_static), kMaxFriction);
  if (!followPress(surface, most_mm / with_friction, tip, press, state)) {
    state.force = Vec3::Zero();
    return leftOutput(surface, settings, tip, state);
  }
  const SkinHere here = skinAt(surface, state.proxy);
  const tissue::PressedPlace place{here.tissue_mm, settings.radius_mm};
  tissue::Response tissue = tissue::respond(surface.force_law, here.stiffness_n_per_mm, press.felt_depth_mm, place);
  double most_n = most_mm * maxForceSlope(surface, here, press.felt_depth_mm, place, tissue);
  double rest_mm = 0.0;
  double share = 1.0;
  if (settings.relaxation.on()) {
    const Relaxed now = relaxed(settings, tissue, here.stiffness_n_per_mm, press.proxy, state.memory);
    tissue = now.tissue;
    rest_mm = now.rest_mm;
    share = now.share;
    most_n += with_friction * here.stiffness_n_per_mm * now.change_mm;
  } else if (remembers(state.memory)) {
    state.memory = {};
  }
  const double sideways = settings.stiffness_ratio * tissue.tangential * tissue.secant_n_per_mm;
  const Pressure pressure{press.proxy, press.normal, tissue.force_n, sideways, press.bank};
  const Hold hold = holdOf(surface, pressure, gripLimits(settings, tissue), most_n, state);
  FingerOutput output;
  output.tip = tip;
  output.proxy = press.proxy;
  output.anchor = state.anchor.position;
  output.hold = state.hold;
  output.normal = press.normal;
  output.force = state.force = tissue.force_n * press.normal + pressure.tangential_n_per_mm * hold.pull;
  output.depth_mm = press.depth_mm;
  output.tissue_mm = here.tissue_mm;
  output.finger_mm = settings.radius_mm;
  output.touch = state.slipping && hold.settled ? Touch::slip : Touch::stick;
  output.triangle = surface.geometry->tree.source_triangle[state.proxy.triangle];
  output.anchor_triangle = surface.geometry->tree.source_triangle[state.anchor.triangle];
  output.status = press.status | (hold.settled ? 0u : kCatchingUp);
  output.rest_mm = rest_mm;
  output.dent = state.memory.dent;
  if (surface.lumps) addLumps(surface, lumps, press, share, tissue.force_n, state, output);
  return output;
}

}  // namespace palpate::contact

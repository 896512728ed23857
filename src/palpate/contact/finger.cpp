// One tick of the haptic finger: find how the tip presses the skin, hold it by friction, add up the force.
//
// Data flow: device pose -> step (here) -> the force limiter of `servo` -> device; the output also feeds `deform`.
#include "palpate/contact/finger.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "palpate/base/error.h"
#include "palpate/contact/friction.h"
#include "palpate/contact/point_finger.h"
#include "palpate/contact/sphere_finger.h"
#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

namespace {

/// A tip this many diagonals away is a broken device, and would overflow the exact predicates in the end.
constexpr double kFarthestTip = 1e6;

bool usable(const Surface& surface, const Vec3& tip) {
  return tip.allFinite() && (tip - surface.tree.center).cwiseAbs().maxCoeff() <= kFarthestTip * surface.tree.diagonal;
}

FingerOutput freeOutput(const Vec3& tip) {
  FingerOutput output;
  output.tip = output.proxy = output.anchor = output.hold = tip;
  output.normal = output.force = Vec3::Zero();
  return output;
}

FingerOutput lostOutput(const FingerState& state) {
  FingerOutput output = freeOutput(state.tip);
  output.status = kTipLost;
  return output;
}

GripLimits gripLimits(const FingerSettings& settings, double normal_force, double stiffness) {
  const double tangential_stiffness = settings.stiffness_ratio * stiffness;
  if (!(tangential_stiffness > 0.0)) return {};
  return {settings.mu_static * normal_force / tangential_stiffness,
          settings.mu_dynamic * normal_force / tangential_stiffness};
}

/// A point on a surface whose sheets pierce each other is felt as a sphere of 1e-4 of its diagonal (0.05 mm on a back):
/// the walk of a point would slide along one sheet into the inside of the other, a sphere asks all of them.
double solvedRadius(const Surface& surface, const FingerSettings& settings) {
  if (settings.radius_mm > 0.0 || !surface.self_intersecting) return settings.radius_mm;
  return 1e-4 * surface.tree.diagonal;
}

FingerOutput pressedOutput(const Surface& surface, const FingerSettings& settings, const Press& press, const Vec3& tip,
                           FingerState& state) {
  const double stiffness = stiffnessAt(surface, state.proxy);
  const double normal_force = tissue::normalForce(surface.force_law, stiffness, press.felt_depth_mm);
  const GripLimits limits = gripLimits(settings, normal_force, stiffness);
  const bool is_point = solvedRadius(surface, settings) == 0.0;
  const Vec3 pull = is_point ? holdOnSkin(surface, press, limits, state) : holdInSpace(surface, press, limits, state);
  FingerOutput output;
  output.tip = tip;
  output.proxy = press.proxy;
  output.anchor = state.anchor.position;
  output.hold = is_point ? state.anchor.position : state.hold;
  output.normal = press.normal;
  output.force = normal_force * press.normal + settings.stiffness_ratio * stiffness * pull;
  output.depth_mm = press.depth_mm;
  output.touch = state.slipping ? Touch::slip : Touch::stick;
  output.triangle = surface.tree.source_triangle[state.proxy.triangle];
  output.anchor_triangle = surface.tree.source_triangle[state.anchor.triangle];
  output.status = press.status;
  return output;
}

void require(bool holds, const char* what) {
  if (!holds) throw Error(std::string("finger settings: ") + what);
}

}  // namespace

FingerSettings scaled(FingerSettings settings, double factor) {
  settings.radius_mm *= factor;
  settings.max_depth_mm *= factor;
  settings.catch_up_mm_per_s *= factor;
  return settings;
}

void check(const FingerSettings& settings) {
  const auto not_negative = [](double value) { return std::isfinite(value) && value >= 0.0; };
  require(not_negative(settings.radius_mm), "radius_mm must be >= 0");
  require(not_negative(settings.stiffness_ratio), "stiffness_ratio must be >= 0");
  require(not_negative(settings.mu_static), "mu_static must be >= 0");
  require(not_negative(settings.mu_dynamic), "mu_dynamic must be >= 0");
  require(settings.mu_dynamic <= settings.mu_static, "mu_dynamic must not exceed mu_static");
  require(not_negative(settings.max_depth_mm) && settings.max_depth_mm > 0.0, "max_depth_mm must be > 0");
  require(not_negative(settings.tick_s) && settings.tick_s > 0.0, "tick_s must be > 0");
  require(not_negative(settings.catch_up_mm_per_s), "catch_up_mm_per_s must be >= 0");
}

FingerOutput step(const Surface& surface, const FingerSettings& settings, FingerState& state,
                  const Vec3& tip) noexcept {
  if (!usable(surface, tip)) return lostOutput(state);
  if (!state.knows_tip) state.tip = tip;
  const double radius = solvedRadius(surface, settings);
  const Press press =
      radius > 0.0 ? pressSphere(surface, settings, radius, state, tip) : pressPoint(surface, settings, state, tip);
  state.knows_tip = true;
  state.tip = tip;
  if (!press.touching) return freeOutput(tip);
  return pressedOutput(surface, settings, press, tip, state);
}

}  // namespace palpate::contact

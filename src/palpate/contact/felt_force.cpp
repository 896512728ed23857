// Data flow: the solvers of the finger's contact -> Press -> here -> FingerOutput.
//
// The tangential spring is `stiffness_ratio` of the *secant* stiffness F_n / p. So the force points from the tip to the
// anchor when the ratio is 1, A = P + (p / F_n) F_t (E1), under every force law, and the friction limits
// mu F_n / k_t = mu p / ratio are lengths that do not depend on the law.
#include "palpate/contact/felt_force.h"

#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

namespace {

/// A tip this many diagonals away is a broken device, and would overflow the exact predicates in the end.
constexpr double kFarthestTip = 1e6;

GripLimits gripLimits(const FingerSettings& settings, const tissue::Response& tissue) {
  const double tangential_stiffness = settings.stiffness_ratio * tissue.secant_n_per_mm;
  if (!(tangential_stiffness > 0.0)) return {};
  return {settings.mu_static * tissue.force_n / tangential_stiffness,
          settings.mu_dynamic * tissue.force_n / tangential_stiffness};
}

}  // namespace

bool usableTip(const Surface& surface, const Vec3& tip) noexcept {
  return tip.allFinite() && (tip - surface.tree.center).cwiseAbs().maxCoeff() <= kFarthestTip * surface.tree.diagonal;
}

FingerOutput freeOutput(const Vec3& tip) noexcept {
  FingerOutput output;
  output.tip = output.proxy = output.anchor = output.hold = tip;
  return output;
}

FingerOutput lostOutput(const FingerState& state) noexcept {
  FingerOutput output = freeOutput(state.tip);
  output.status = kTipLost;
  return output;
}

FingerOutput pressedOutput(const Surface& surface, const FingerSettings& settings, const Press& press, const Vec3& tip,
                           Hold hold, FingerState& state) noexcept {
  const double stiffness = stiffnessAt(surface, state.proxy);
  const tissue::Response tissue = tissue::respond(surface.force_law, stiffness, press.felt_depth_mm);
  const Vec3 pull = hold(surface, press, gripLimits(settings, tissue), state);
  FingerOutput output;
  output.tip = tip;
  output.proxy = press.proxy;
  output.anchor = state.anchor.position;
  output.hold = state.hold;
  output.normal = press.normal;
  output.force = tissue.force_n * press.normal + settings.stiffness_ratio * tissue.secant_n_per_mm * pull;
  output.depth_mm = press.depth_mm;
  output.touch = state.slipping ? Touch::slip : Touch::stick;
  output.triangle = surface.tree.source_triangle[state.proxy.triangle];
  output.anchor_triangle = surface.tree.source_triangle[state.anchor.triangle];
  output.status = press.status;
  return output;
}

}  // namespace palpate::contact

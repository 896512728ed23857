// One tick of the haptic finger: find how the tip presses the skin, hold it by friction, add up the force.
//
// Data flow: device pose -> step (here) -> the force limiter of `servo` -> device; the output also feeds `deform`.
#include "palpate/contact/finger.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "palpate/base/error.h"
#include "palpate/contact/finger_tick.h"

namespace palpate::contact {

namespace {

Press pressOf(const Surface& surface, const FingerSettings& settings, FingerState& state, const Vec3& tip) {
  if (settings.radius_mm > 0.0) return pressSphere(surface, settings, settings.radius_mm, state, tip);
  if (!surface.geometry->entangled.empty()) return pressGuardedPoint(surface, settings, state, tip);
  return pressPoint(surface, settings, state, tip);
}

void require(bool holds, const char* what) {
  if (!holds) throw Error(std::string("finger settings: ") + what);
}

void checkRelaxation(const Relaxation& relaxation) {
  const auto is_share = [](double value) { return value >= 0.0 && value <= kMaxRelaxation; };
  require(is_share(relaxation.share) && is_share(relaxation.share_2) && is_share(relaxation.share + relaxation.share_2),
          "the shares of relaxation must be >= 0 and together at most 0.9");
  require(relaxation.time_s > 0.0 && relaxation.time_2_s > 0.0, "the times of relaxation must be > 0");
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
  checkRelaxation(settings.relaxation);
}

FingerOutput step(const Surface& surface, const FingerSettings& settings, FingerState& state, const Vec3& tip,
                  const LumpPlaces* lumps) noexcept {
  return tickBy(surface, settings, state, tip, lumps, [&] { return pressOf(surface, settings, state, tip); });
}

void stepAll(const Surface& surface, std::span<const FingerSettings> settings, std::span<FingerState> states,
             std::span<const Vec3> tips, std::span<FingerOutput> outputs) noexcept {
  for (std::size_t i = 0; i < tips.size(); ++i) outputs[i] = step(surface, settings[i], states[i], tips[i]);
}

}  // namespace palpate::contact

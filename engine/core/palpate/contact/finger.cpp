// One tick of the haptic finger: find how the tip presses the skin, hold it by friction, add up the force.
//
// Data flow: device pose -> step (here) -> the force limiter of `servo` -> device; the output also feeds `deform`.
#include "palpate/contact/finger.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "palpate/base/error.h"
#include "palpate/contact/finger_tick.h"
#include "palpate/contact/nearby_skin.h"

namespace palpate::contact {

namespace {

/// Gathers the skin round a sphere that will be at `place` after it has moved so.
void gatherFor(const SkinPlanes& planes, double radius_mm, const Vec3& place, const Vec3& motion, double step_mm,
               FingerSkin& near) {
  if (near.rest_ticks > 0) {
    --near.rest_ticks;
    return;
  }
  near.margin_mm = std::min(std::max(near.margin_mm, profitableMargin(1, step_mm)), radius_mm);
  const Vec3 middle = place + gatheredAhead(motion, near.margin_mm);
  if (gatherSkin(planes, middle, radius_mm + near.margin_mm, near.skin)) {
    near.margin_mm = adaptedMargin(near.skin, near.margin_mm);
    return;
  }
  near.margin_mm *= 0.5;
  near.rest_ticks = kTicksOfRest;
}

/// The skin near a sphere in contact, gathered where what is known of it is used up. Null: the tree is asked.
const NearbySkin* skinNear(const Surface& surface, const FingerSettings& settings, const FingerState& state,
                           const Vec3& tip, FingerSkin* near) {
  if (near == nullptr || surface.planes == nullptr || !state.touching) return nullptr;
  const Vec3 motion = tip - state.tip;
  const Vec3 place = state.centre + motion;
  const double step_mm = motion.norm() + settings.catch_up_mm_per_s * settings.tick_s;
  const bool is_of_this = near->skin.planes == surface.planes.get();
  if (!is_of_this || !covers(near->skin, place, settings.radius_mm + step_mm)) {
    near->skin.planes = nullptr;
    gatherFor(*surface.planes, settings.radius_mm, place, motion, step_mm, *near);
  }
  return &near->skin;
}

Press pressOf(const Surface& surface, const FingerSettings& settings, FingerState& state, const Vec3& tip,
              FingerSkin* near) {
  if (settings.radius_mm > 0.0) {
    const NearbySkin* const nearby = skinNear(surface, settings, state, tip, near);
    return pressSphere(surface, settings, settings.radius_mm, state, tip, nearby);
  }
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
                  const LumpPlaces* lumps, FingerSkin* skin) noexcept {
  return tickBy(surface, settings, state, tip, lumps, [&] { return pressOf(surface, settings, state, tip, skin); });
}

void stepAll(const Surface& surface, std::span<const FingerSettings> settings, std::span<FingerState> states,
             std::span<const Vec3> tips, std::span<FingerOutput> outputs) noexcept {
  for (std::size_t i = 0; i < tips.size(); ++i) outputs[i] = step(surface, settings[i], states[i], tips[i]);
}

}  // namespace palpate::contact

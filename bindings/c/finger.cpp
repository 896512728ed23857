// A finger behind its handle: what engine::Simulator has of one, without the others.
#include <array>
#include <memory>
#include <optional>
#include <span>

#include "answers.h"
#include "palpate/engine/felt_pressure.h"
#include "palpate/engine/fingers.h"
#include "palpate/servo/finger_solver.h"
#include "structs.h"
#include "touch.h"
#include "world_handle.h"

struct palpate_finger {
  std::shared_ptr<const palpate::scene::World> world;
  palpate::servo::FingerSolver solver = {};
  palpate::contact::FingerSettings settings = {};
  palpate::contact::FingerState state = {};
  std::uint64_t ticks = 0;
  palpate::contact::FingerOutput felt = {};                    ///< in the last of them
  std::optional<palpate::engine::FeltPressure> pressure = {};  ///< made when it is first asked for
};

namespace palpate::c_api {

namespace {

palpate_finger_settings plain(const contact::FingerSettings& settings) noexcept {
  palpate_finger_settings plain = {};
  plain.size = sizeof(plain);
  plain.radius_mm = settings.radius_mm;
  plain.stiffness_ratio = settings.stiffness_ratio;
  plain.mu_static = settings.mu_static;
  plain.mu_dynamic = settings.mu_dynamic;
  plain.max_depth_mm = settings.max_depth_mm;
  plain.tick_s = settings.tick_s;
  plain.catch_up_mm_per_s = settings.catch_up_mm_per_s;
  plain.force_shading = settings.force_shading ? 1 : 0;
  plain.relaxation_share = settings.relaxation.share;
  plain.relaxation_time_s = settings.relaxation.time_s;
  plain.relaxation_share_2 = settings.relaxation.share_2;
  plain.relaxation_time_2_s = settings.relaxation.time_2_s;
  return plain;
}

contact::FingerSettings settingsOf(const palpate_finger_settings& plain) noexcept {
  contact::FingerSettings settings;
  settings.radius_mm = plain.radius_mm;
  settings.stiffness_ratio = plain.stiffness_ratio;
  settings.mu_static = plain.mu_static;
  settings.mu_dynamic = plain.mu_dynamic;
  settings.max_depth_mm = plain.max_depth_mm;
  settings.tick_s = plain.tick_s;
  settings.catch_up_mm_per_s = plain.catch_up_mm_per_s;
  settings.force_shading = plain.force_shading != 0;
  settings.relaxation = {plain.relaxation_share, plain.relaxation_time_s, plain.relaxation_share_2,
                         plain.relaxation_time_2_s};
  return settings;
}

palpate_finger* fingerOn(const palpate_world& world, const contact::FingerSettings& settings) {
  engine::checkFingers(world.world(), {&settings, 1});
  auto finger = std::make_unique<palpate_finger>();
  finger->world = world.built.world;
  finger->settings = settings;
  finger->solver =
      std::move(servo::makeSolvers(finger->world->surface, finger->world->hdb, 1, finger->world->breath).front());
  return finger.release();
}

void step(palpate_finger& finger, const double* tip_mm, palpate_touch* touch, std::size_t size) noexcept {
  const std::uint64_t tick = finger.ticks++;
  finger.felt = servo::touch(finger.solver, finger.settings, finger.state, {tip_mm[0], tip_mm[1], tip_mm[2]}, tick);
  putTouch(finger.felt, tick, touch, size);
}

/// A pad of C's numbers: room for the largest lies on the stack.
void press(const palpate_finger& finger, const contact::PressurePad& pad, float* kpa, float* shear_kpa) noexcept {
  constexpr std::size_t kMost = contact::kMaxTaxels * contact::kMaxTaxels;
  std::array<double, kMost> normal;
  std::array<Vec2, kMost> shear;
  const std::size_t count = pad.taxels * pad.taxels;
  const std::uint64_t tick = finger.ticks == 0 ? 0 : finger.ticks - 1;
  finger.pressure->at(finger.felt, tick, pad, std::span(normal).first(count),
                      std::span(shear).first(shear_kpa == nullptr ? 0 : count));
  for (std::size_t i = 0; i < count; ++i) kpa[i] = static_cast<float>(normal[i]);
  if (shear_kpa == nullptr) return;
  for (std::size_t i = 0; i < 2 * count; ++i) shear_kpa[i] = static_cast<float>(shear[i / 2][static_cast<int>(i % 2)]);
}

}  // namespace

}  // namespace palpate::c_api

using namespace palpate;

void palpate_finger_settings_init(palpate_finger_settings* settings, size_t size) noexcept {
  if (settings == nullptr || !c_api::isSize<palpate_finger_settings>(size)) return;
  c_api::toCaller(c_api::plain({}), settings, size);
}

int32_t palpate_world_finger_settings(const palpate_world* world, size_t index,
                                      palpate_finger_settings* settings) noexcept {
  return c_api::answered(nullptr, [&] {
    c_api::require(world != nullptr && c_api::isUsable(settings), "");
    const scene::Scene& scene = world->world().scene;
    const scene::Finger finger = index < scene.fingers.size() ? scene.fingers[index] : scene::Finger();
    c_api::toCaller(c_api::plain(scene::contactSettings(scene, finger)), settings);
  });
}

int32_t palpate_finger_create(palpate_world* world, const palpate_finger_settings* settings, palpate_finger** out,
                              palpate_error* error) noexcept {
  return c_api::answeredWith(out, error, [&] {
    c_api::require(world != nullptr, "the world is null");
    if (settings == nullptr) return c_api::fingerOn(*world, engine::fingerSettings(world->world().scene).front());
    c_api::require(c_api::isUsable(settings), "the settings' size is not set");
    return c_api::fingerOn(*world, c_api::settingsOf(c_api::fromCaller(settings, c_api::plain({}))));
  });
}

int32_t palpate_finger_step(palpate_finger* finger, const double tip_mm[3], palpate_touch* touch) noexcept {
  if (finger == nullptr || tip_mm == nullptr || !c_api::isUsable(touch)) return PALPATE_ARGUMENT;
  c_api::step(*finger, tip_mm, touch, touch->size);
  return PALPATE_OK;
}

int32_t palpate_finger_rollout(palpate_finger* finger, const double* tips_mm, size_t count, palpate_touch* touches,
                               size_t stride) noexcept {
  if (finger == nullptr || !c_api::isSize<palpate_touch>(stride)) return PALPATE_ARGUMENT;
  if (count > 0 && (tips_mm == nullptr || touches == nullptr)) return PALPATE_ARGUMENT;
  for (std::size_t i = 0; i < count; ++i) {
    c_api::step(*finger, tips_mm + 3 * i, c_api::at(touches, i, stride), stride);
  }
  return PALPATE_OK;
}

int32_t palpate_finger_pressure(palpate_finger* finger, size_t taxels, double pad_mm, float* kpa,
                                float* shear_kpa) noexcept {
  const contact::PressurePad pad{taxels, pad_mm};
  if (finger == nullptr || kpa == nullptr || !engine::isPad(pad)) return PALPATE_ARGUMENT;
  if (!finger->pressure) {
    const int32_t made = c_api::answered(nullptr, [&] { finger->pressure.emplace(finger->world); });
    if (made != PALPATE_OK) return made;
  }
  c_api::press(*finger, pad, kpa, shear_kpa);
  return PALPATE_OK;
}

int32_t palpate_finger_lift(palpate_finger* finger) noexcept {
  if (finger == nullptr) return PALPATE_ARGUMENT;
  servo::lift(finger->solver, finger->state);
  finger->felt = {};
  return PALPATE_OK;
}

void palpate_finger_release(palpate_finger* finger) noexcept { delete finger; }

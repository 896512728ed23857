// A finger behind its handle: what engine::Simulator has of one, without the others.
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>

#include "answers.h"
#include "palpate/base/fields.h"
#include "palpate/contact/finger_fields.h"
#include "palpate/engine/felt_pressure.h"
#include "palpate/engine/fingers.h"
#include "structs.h"
#include "touch.h"
#include "world_handle.h"

struct palpate_finger {
  std::shared_ptr<const palpate::scene::World> world;
  palpate::engine::Finger finger = {};
  palpate::contact::FingerOutput felt = {};                    ///< in its last tick
  std::optional<palpate::engine::FeltPressure> pressure = {};  ///< made on first use
};

namespace palpate::c_api {

namespace {

using Plain = palpate_finger_settings;

/// In the order of contact::kFingerFields.
constexpr std::array kPlainFields = {
    field<Plain, &Plain::radius_mm>("radius_mm"),
    field<Plain, &Plain::stiffness_ratio>("stiffness_ratio"),
    field<Plain, &Plain::mu_static>("mu_static"),
    field<Plain, &Plain::mu_dynamic>("mu_dynamic"),
    field<Plain, &Plain::max_depth_mm>("max_depth_mm"),
    field<Plain, &Plain::tick_s>("tick_s"),
    field<Plain, &Plain::catch_up_mm_per_s>("catch_up_mm_per_s"),
    field<Plain, &Plain::relaxation_share>("relaxation_share"),
    field<Plain, &Plain::relaxation_time_s>("relaxation_time_s"),
    field<Plain, &Plain::relaxation_share_2>("relaxation_share_2"),
    field<Plain, &Plain::relaxation_time_2_s>("relaxation_time_2_s"),
    field<Plain, &Plain::force_shading>("force_shading"),
};
static_assert(std::equal(kPlainFields.begin(), kPlainFields.end(), contact::kFingerFields.begin(),
                         contact::kFingerFields.end(),
                         [](const auto& plain, const auto& ours) { return plain.name == ours.name; }));

Plain plain(const contact::FingerSettings& settings) noexcept {
  Plain plain = {};
  plain.size = sizeof(plain);
  for (std::size_t i = 0; i < kPlainFields.size(); ++i) {
    kPlainFields[i].set(plain, contact::kFingerFields[i].get(settings));
  }
  return plain;
}

contact::FingerSettings settingsOf(const Plain& plain) noexcept {
  contact::FingerSettings settings;
  for (std::size_t i = 0; i < kPlainFields.size(); ++i) {
    contact::kFingerFields[i].set(settings, kPlainFields[i].get(plain));
  }
  return settings;
}

palpate_finger* fingerOn(const palpate_world& world, const contact::FingerSettings& settings) {
  engine::checkFingers(world.world(), {&settings, 1});
  auto finger = std::make_unique<palpate_finger>();
  finger->world = world.built.world;
  finger->finger = std::move(engine::fingersOn(world.world(), {&settings, 1}).front());
  return finger.release();
}

void step(palpate_finger& finger, const double* tip_mm, palpate_touch* touch, std::size_t size) noexcept {
  const std::uint64_t tick = finger.finger.ticks;
  finger.felt = finger.finger.feel({tip_mm[0], tip_mm[1], tip_mm[2]});
  putTouch(finger.felt, tick, touch, size);
}

/// A pad of C's numbers: room for the largest is on the stack.
void press(const palpate_finger& finger, const contact::PressurePad& pad, float* kpa, float* shear_kpa) noexcept {
  constexpr std::size_t kMax = contact::kMaxTaxels * contact::kMaxTaxels;
  std::array<double, kMax> normal;
  std::array<Vec2, kMax> shear;
  const std::size_t count = pad.taxels * pad.taxels;
  const std::uint64_t ticks = finger.finger.ticks;
  finger.pressure->at(finger.felt, ticks == 0 ? 0 : ticks - 1, pad, std::span(normal).first(count),
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
  finger->finger.lift();
  finger->felt = {};
  return PALPATE_OK;
}

void palpate_finger_release(palpate_finger* finger) noexcept { delete finger; }

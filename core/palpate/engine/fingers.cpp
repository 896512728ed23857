// Scene -> settings of its fingers, and the checks that a change of world makes before anything is changed. sameBody
// reads both meshes to the end; cold path.
#include "palpate/engine/fingers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "palpate/base/error.h"
#include "palpate/base/number_range.h"

namespace palpate::engine {

std::vector<contact::FingerSettings> fingerSettings(const scene::Scene& scene, std::size_t fingers) {
  std::vector<contact::FingerSettings> settings;
  for (std::size_t i = 0; i < fingers; ++i) {
    settings.push_back(scene::contactSettings(scene, i < scene.fingers.size() ? scene.fingers[i] : scene::Finger()));
  }
  return settings;
}

std::vector<contact::FingerSettings> fingerSettings(const scene::Scene& scene) {
  return fingerSettings(scene, std::max<std::size_t>(1, scene.fingers.size()));
}

namespace {

/// What a finger's settings may be: the ranges of the scene file's keys, so that no digits are lost and no fault is
/// multiplied.
struct SettingRange {
  const char* name;
  double contact::FingerSettings::*value;
  NumberRange range;
};
const std::array kSettingRanges = {
    SettingRange{"radius_mm", &contact::FingerSettings::radius_mm, {0.0, 1000.0}},
    SettingRange{"stiffness_ratio", &contact::FingerSettings::stiffness_ratio, {0.0, 100.0}},
    SettingRange{"mu_static", &contact::FingerSettings::mu_static, {0.0, 5.0}},
    SettingRange{"mu_dynamic", &contact::FingerSettings::mu_dynamic, {0.0, 5.0}},
    SettingRange{"max_depth_mm", &contact::FingerSettings::max_depth_mm, {0.0, 1e5, true}},
    SettingRange{"tick_s", &contact::FingerSettings::tick_s, {1e-6, 1.0}},
    SettingRange{"catch_up_mm_per_s", &contact::FingerSettings::catch_up_mm_per_s, {0.0, 1e6}},
};

void checkRanges(const contact::FingerSettings& settings, std::size_t finger) {
  for (const SettingRange& setting : kSettingRanges) {
    const double value = settings.*setting.value;
    if (setting.range.holds(value)) continue;
    throw Error(
        fmt::format("finger {}: {} = {}", finger, setting.name, outOfRange(fmt::format("{}", value), setting.range)));
  }
}

}  // namespace

void checkFinger(const contact::FingerSettings& settings, std::size_t number) {
  contact::check(settings);
  checkRanges(settings, number);
}

void checkFingers(const scene::World& world, std::span<const contact::FingerSettings> fingers) {
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    checkFinger(fingers[i], i);
    if (world.hdb && fingers[i].radius_mm > 0.0) {
      throw Error(fmt::format("finger {}: the detecting box touches with a point, its radius_mm must be 0, not {}", i,
                              fingers[i].radius_mm));
    }
  }
}

bool sameBody(const scene::World& one, const scene::World& other) {
  return one.body == other.body || (one.body->skin.triangles == other.body->skin.triangles &&
                                    one.body->skin.positions == other.body->skin.positions);
}

}  // namespace palpate::engine

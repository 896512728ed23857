// Scene -> settings of its fingers, and the checks that a change of world makes before anything is changed. sameBody
// reads both meshes to the end; cold path. Own.
#include "palpate/engine/fingers.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/error.h"

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

void checkFingers(const scene::World& world, std::span<const contact::FingerSettings> fingers) {
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    contact::check(fingers[i]);
    if (world.hdb && fingers[i].radius_mm > 0.0) {
      throw Error(fmt::format("finger {}: the detecting box touches with a point, its radius_mm must be 0, not {}", i,
                              fingers[i].radius_mm));
    }
  }
}

bool sameBody(const scene::World& one, const scene::World& other) {
  return &one == &other || (one.skin.triangles == other.skin.triangles && one.skin.positions == other.skin.positions);
}

}  // namespace palpate::engine

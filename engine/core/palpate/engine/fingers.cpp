// Scene -> settings of its fingers -> fingers, and the checks that a change of world makes before anything is changed.
// sameBody reads both meshes to the end; cold path.
#include "palpate/engine/fingers.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/fields.h"
#include "palpate/contact/finger_fields.h"

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

void checkRanges(const contact::FingerSettings& settings, std::size_t finger) {
  for (const Field<contact::FingerSettings>& field : contact::kFingerFields) {
    const double value = field.get(settings);
    if (field.range.holds(value)) continue;
    throw Error(
        fmt::format("finger {}: {} = {}", finger, field.name, outOfRange(fmt::format("{}", value), field.range)));
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
      throw Error(
          fmt::format("finger {}: contact source \"hdb\" supports point fingers only; radius_mm must be 0, not {}", i,
                      fingers[i].radius_mm));
    }
  }
}

void Finger::reset() {
  lift();
  ticks = 0;
  if (solver.lumps) *solver.lumps = servo::LumpLoop(solver.lumps->fingers());
}

std::vector<Finger> fingersOn(const scene::World& world, std::span<const contact::FingerSettings> fingers) {
  std::vector<Finger> alone;
  alone.reserve(fingers.size());
  for (const contact::FingerSettings& settings : fingers) {
    alone.push_back(std::move(makeRig(world, {&settings, 1}).front()));
  }
  return alone;
}

std::vector<Finger> makeRig(const scene::World& world, std::span<const contact::FingerSettings> fingers) {
  servo::FingerSolvers solvers = servo::makeSolvers(world.surface, world.hdb, fingers.size(), world.breath);
  std::vector<Finger> rig;
  rig.reserve(fingers.size());
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    if (fingers[i].radius_mm == 0.0) {
      solvers[i].source.skin.reset();  // a point would never use it: 17 kB for each of thousands
    }
    rig.push_back({std::move(solvers[i]), fingers[i]});
  }
  return rig;
}

bool sameBody(const scene::World& one, const scene::World& other) {
  return one.body == other.body || (one.body->skin.triangles == other.body->skin.triangles &&
                                    one.body->skin.positions == other.body->skin.positions);
}

}  // namespace palpate::engine

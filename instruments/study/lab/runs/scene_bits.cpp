#include "lab/runs/scene_bits.h"

#include <vector>

#include "palpate/base/hash.h"
#include "palpate/device/finger_path.h"
#include "palpate/engine/living_skin.h"
#include "palpate/servo/scripted_rig.h"
#include "palpate/servo/tick.h"

namespace palpate::bench {

namespace {

std::uint64_t bitsHash(const scene::World& world) {
  Hash hash;
  for (const Vec3& position : world.body->skin.positions) hash.add(position);
  for (const auto& triangle : world.body->skin.triangles) {
    for (const Index vertex : triangle) hash.add(std::uint64_t{vertex});
  }
  for (const double stiffness : *world.surface.stiffness_n_per_mm) hash.add(stiffness);
  return hash.value();
}

std::uint64_t bitsHash(const deform::DeformedSurface& skin) {
  Hash hash;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float x : skin.position(axis)) hash.add(double{x});
    for (const float x : skin.normal(axis)) hash.add(double{x});
  }
  for (const float x : skin.strain()) hash.add(double{x});
  return hash.value();
}

double depthOfAll(const std::vector<trace::Sample>& samples) {
  double depth = 0.0;
  for (const trace::Sample& sample : samples) depth += sample.contact.depth_mm;
  return depth;
}

}  // namespace

SceneBits bitsOf(const scene::World& world, std::uint64_t ticks) {
  const device::FingerPaths paths = device::pathsOf(world);
  servo::Rig rig = servo::scriptedRig(world, paths);
  std::vector<trace::Sample> samples(rig.fingers.size());
  std::vector<trace::Sample> deepest = samples;
  Hash forces;
  if (ticks == 0) ticks = paths.ticks;
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    servo::runTick(rig, tick % paths.ticks, servo::LoopEvent::none, samples);
    for (const trace::Sample& sample : samples) forces.add(sample.contact.force);
    if (depthOfAll(samples) > depthOfAll(deepest)) deepest = samples;
  }
  engine::LivingSkin skin(world);
  skin.follow(deepest);
  return {bitsHash(world), forces.value(), bitsHash(skin.surface())};
}

}  // namespace palpate::bench

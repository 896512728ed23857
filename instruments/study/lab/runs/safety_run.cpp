#include "lab/runs/safety_run.h"

#include <algorithm>
#include <vector>

#include "lab/counters/statistics.h"
#include "palpate/base/stopwatch.h"
#include "palpate/servo/scripted_rig.h"

namespace palpate::bench {

namespace {

/// Short enough that an interruption of the system spoils few, long enough for the clock.
constexpr std::uint64_t kBlockTicks = 250;

/// Takes forces and does nothing with them.
device::Device taking(device::Device device) {
  auto force = std::make_shared<Vec3>(Vec3::Zero());
  device.write_force = [force](const Vec3& sent) { *force = sent; };
  return device;
}

servo::Rig rigFor(const scene::World& world, const device::FingerPaths& paths) {
  servo::Rig rig = servo::scriptedRig(world, paths);
  for (servo::FingerChain& finger : rig.fingers) servo::giveDevice(finger, taking(finger.device));
  return rig;
}

/// servo::runTick without the guards between contact and hand.
void bareTick(servo::Rig& rig, std::uint64_t tick, std::span<trace::Sample> samples) {
  for (std::size_t i = 0; i < rig.fingers.size(); ++i) {
    servo::FingerChain& finger = rig.fingers[i];
    trace::Sample& sample = samples[i];
    sample.tick = tick;
    sample.finger = static_cast<std::uint32_t>(i);
    const Vec3 tip = finger.device.read_tip(tick);
    sample.contact = servo::touch(finger.solver, finger.contact_settings, finger.contact, tip, sample.tick);
    sample.device_force = sample.contact.force;
    finger.device.write_force(sample.device_force);
  }
}

template <class Tick>
double blockUs(std::uint64_t first, Tick&& tick) {
  const Clock::time_point start = Clock::now();
  for (std::uint64_t k = first; k < first + kBlockTicks; ++k) tick(k);
  return microsecondsSince(start) / static_cast<double>(kBlockTicks);
}

}  // namespace

SafetyCost measureSafety(const scene::World& world, const device::FingerPaths& paths, double seconds) {
  servo::Rig safe = rigFor(world, paths);
  servo::Rig bare = rigFor(world, paths);
  std::vector<trace::Sample> samples(safe.fingers.size());
  std::vector<double> differences;
  std::vector<double> ticks;
  const auto with = [&](std::uint64_t k) { servo::runTick(safe, k, servo::LoopEvent::none, samples); };
  const auto without = [&](std::uint64_t k) { bareTick(bare, k, samples); };
  const std::uint64_t last = std::max<std::uint64_t>(kBlockTicks, paths.ticks) - kBlockTicks;
  const auto started = Clock::now();
  std::uint64_t first = 0;
  while (secondsSince(started) < seconds || differences.empty()) {
    const bool with_first = differences.size() % 2 == 0;  // the second of two finds warm caches
    const double one = with_first ? blockUs(first, with) : blockUs(first, without);
    const double other = with_first ? blockUs(first, without) : blockUs(first, with);
    differences.push_back(with_first ? one - other : other - one);
    ticks.push_back(with_first ? one : other);
    first = first + kBlockTicks > last ? 0 : first + kBlockTicks;
  }
  const auto fingers = static_cast<double>(samples.size());
  return {lab::computePercentiles(differences).p50 / fingers, lab::computePercentiles(ticks).p50 / fingers,
          differences.size()};
}

}  // namespace palpate::bench

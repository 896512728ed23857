#include "lab/loops/stability_map.h"

#include <algorithm>
#include <map>
#include <utility>

#include "lab/loops/shared_jobs.h"

namespace palpate::lab {

namespace {

/// The loop's profile of an open device. Where it is refused, and would get no force at all, the loop is run as if it
/// were not: at the softest cap, without the controller.
const device::DeviceProfile& believedProfile(scene::DeviceModel model, bool refused) {
  static const std::map<std::pair<scene::DeviceModel, bool>, device::DeviceProfile> profiles = [] {
    std::map<std::pair<scene::DeviceModel, bool>, device::DeviceProfile> all;
    std::vector<scene::DeviceModel> models = nominalDevices();
    models.push_back(scene::DeviceModel::unknown);
    for (const scene::DeviceModel device : models) {
      device::DeviceProfile profile = device::profileOf(device);
      profile.open = true;
      all[{device, false}] = profile;
      profile.open = false;
      profile.known = true;
      all[{device, true}] = profile;
    }
    return all;
  }();
  return profiles.at({model, refused});
}

/// Random stream of one system, independent of all others.
Random makeCellRandom(const StabilityCell& cell, std::uint64_t seed, std::size_t number) {
  std::uint64_t mixed = seed;
  for (const std::uint64_t part : {static_cast<std::uint64_t>(cell.device), static_cast<std::uint64_t>(cell.hand),
                                   static_cast<std::uint64_t>(cell.ticks_per_s),
                                   static_cast<std::uint64_t>(cell.delay_ticks), static_cast<std::uint64_t>(number)}) {
    mixed = (mixed ^ part) * 6364136223846793005u + 1442695040888963407u;
    mixed ^= mixed >> 29;
  }
  return Random(mixed);
}

struct MappedSystem {
  LoopPlan plan;
  double speed_mm_per_s = 500.0;
  double phase = 0.0;
};

MappedSystem mappedSystem(const StabilityCell& cell, std::uint64_t seed, std::size_t number) {
  Random random = makeCellRandom(cell, seed, number);
  MappedSystem system;
  LoopPlan& plan = system.plan;
  const std::vector<scene::DeviceModel>& nominal = nominalDevices();
  plan.believed = &believedProfile(cell.device, !cell.refused.empty());
  plan.device =
      device::profileOf(cell.device == scene::DeviceModel::unknown ? nominal[number % nominal.size()] : cell.device);
  plan.device.mass_kg *= random.uniform(0.7, 1.3);
  plan.device.damping_n_s_per_mm *= random.uniform(0.1, 2.0);
  plan.device.friction_n *= random.uniform(0.0, number % 3 == 0 ? 0.15 : 1.5);
  plan.amplifier_lag_s = random.uniform(0.0, 0.0005);
  plan.jitter_ticks = random.uniform(0.0, 0.25);
  plan.hand = handLike(cell.hand, random);
  plan.ticks_per_s = cell.ticks_per_s;
  plan.delay_ticks = cell.delay_ticks;
  plan.plate.stiffness_n_per_mm = cell.cap_n_per_mm;
  plan.controlled_everywhere = false;
  plan.seed = number + 1;
  system.speed_mm_per_s = number % 2 == 0 ? 500.0 : random.uniform(100.0, 500.0);
  system.phase = random.uniform(0.0, 1.0);
  return system;
}

/// A mass on a spring without friction rings on for a second alone; longer ringing comes from the loop.
bool keepsOscillating(const LoopPlan& plan) {
  constexpr double kLaterS = 1.6;
  return kick(plan).oscillates(plan.device.encoder_mm) && kick(plan, kLaterS).oscillates(plan.device.encoder_mm);
}

}  // namespace

StabilityMapPlan stabilityMapPlan() {
  StabilityMapPlan plan;
  plan.devices = nominalDevices();
  plan.devices.push_back(scene::DeviceModel::unknown);
  return plan;
}

LoopPlan mappedLoop(const StabilityCell& cell, std::uint64_t seed, std::size_t number) {
  return mappedSystem(cell, seed, number).plan;
}

StabilityCell measuredCell(StabilityCell cell, std::uint64_t seed, std::size_t systems) {
  const device::DeviceProfile& believed = believedProfile(cell.device, false);
  const double tick_s = 1.0 / cell.ticks_per_s;
  scene::SafetySettings safety;
  safety.delay_ticks = cell.delay_ticks;
  cell.cap_n_per_mm = servo::stiffnessCap(safety, believed, tick_s);
  cell.refused = servo::refusalReason(believed, tick_s, cell.delay_ticks);
  for (std::size_t number = 0; number < systems; ++number) {
    MappedSystem system = mappedSystem(cell, seed, number);
    for (const bool controlled : {false, true}) {
      system.plan.protection = controlled ? Protection::assumed : Protection::none;
      const bool oscillates = keepsOscillating(system.plan);
      (controlled ? cell.oscillates_controlled : cell.oscillates_bare) += oscillates ? 1 : 0;
      double& energy = controlled ? cell.port_energy_mj_max : cell.port_energy_bare_mj_max;
      energy = std::max(energy, tap(system.plan, system.speed_mm_per_s, system.phase).port_energy_mj);
    }
  }
  return cell;
}

std::vector<StabilityCell> measureStabilityMap(const StabilityMapPlan& plan, const Progress& progress) {
  std::vector<StabilityCell> cells;
  for (const double rate : plan.rates) {
    for (const int delay : plan.delays) {
      for (const scene::DeviceModel device : plan.devices) {
        for (const device::HandKind hand : plan.hands) {
          cells.push_back({.ticks_per_s = rate, .delay_ticks = delay, .device = device, .hand = hand});
        }
      }
    }
  }
  // The fastest first, which take longest.
  std::reverse(cells.begin(), cells.end());
  std::vector<StabilityCell> measured =
      sharedJobs(cells.size(), plan.threads, "mapping rate, delay, device and hand", progress,
                 [&](std::size_t i) { return measuredCell(cells[i], plan.seed, plan.systems); });
  std::reverse(measured.begin(), measured.end());
  return measured;
}

}  // namespace palpate::lab

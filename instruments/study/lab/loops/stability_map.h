// The map of the product's own limits: at every rate and delay, with every device and hand, random systems are kicked
// and tapped at the stiffness that the product would allow there, bare and controlled.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lab/loops/random_loops.h"
#include "palpate/base/progress.h"

namespace palpate::lab {

struct StabilityMapPlan {
  std::vector<double> rates{250.0, 500.0, 1000.0, 2000.0, 4000.0};  ///< Hz
  std::vector<int> delays{0, 1, 2, 3, 4, 5, 6};                     ///< ticks
  /// `unknown` is a device of which the loop knows nothing: the mechanics of the others, in turn.
  std::vector<scene::DeviceModel> devices;
  std::vector<device::HandKind> hands{device::HandKind::stylus_x, device::HandKind::stylus_z, device::HandKind::thimble,
                                      device::HandKind::arm, device::HandKind::dead_load};
  std::size_t systems = 60;  ///< per cell
  std::uint64_t seed = 20261124;
  std::size_t threads = 0;  ///< 0: one for each core
};

/// The seven devices and an unknown one.
StabilityMapPlan stabilityMapPlan();

struct StabilityCell {
  double ticks_per_s = 1000.0;
  int delay_ticks = 1;
  scene::DeviceModel device = scene::DeviceModel::unknown;
  device::HandKind hand = device::HandKind::dead_load;
  double cap_n_per_mm = 0.0;
  std::string refused{};  ///< why a session may not start here; empty: it may
  std::size_t oscillates_bare = 0;
  std::size_t oscillates_controlled = 0;
  double port_energy_bare_mj_max = 0.0;
  double port_energy_mj_max = 0.0;  ///< controlled
};

/// The system of this number in a cell, at the cell's cap: mass +-30 %, damping 0.1 to 2 times, friction 0 to 1.5 times
/// the nominal (every third 0 to 0.15), amplifier lag up to 0.5 ms, jitter up to a quarter of a tick. `plan.believed`
/// points to a profile that lives as long as the program.
LoopPlan mappedLoop(const StabilityCell& cell, std::uint64_t seed, std::size_t number);

/// Cap and reason as the product finds them, and the systems' behaviour there. Each system is kicked bare and
/// controlled and tapped bare and controlled, every second at 0.5 m/s, else at 0.1 to 0.5. It oscillates when it swings
/// by more than two encoder steps 0.4 to 0.8 s after the kick, and still 1.6 to 2 s after.
StabilityCell measuredCell(StabilityCell cell, std::uint64_t seed, std::size_t systems);

/// Cells by rate, delay, device, hand. The same cells whatever the threads.
std::vector<StabilityCell> measureStabilityMap(const StabilityMapPlan& plan, const Progress& progress = {});

}  // namespace palpate::lab

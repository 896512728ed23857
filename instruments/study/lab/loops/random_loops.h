// Random devices and hands, off their nominal values as real ones are, which a controller that knows only the nominal
// device must still keep at rest.
#pragma once

#include <vector>

#include "lab/loops/loop_trials.h"

namespace palpate::lab {

/// Properties that all systems of one cell of the table share.
struct RandomCell {
  double stiffness_n_per_mm = 1.0;
  double delay_ticks = 1.0;
  bool dead_load = false;
  Protection protection = Protection::assumed;
  std::shared_ptr<const contact::Lumps> lumps = nullptr;  ///< under the plate; null: none
};

/// The seven nominal devices, in turn.
const std::vector<scene::DeviceModel>& nominalDevices();

/// The system of this number: mass +-30 %, damping 0.1 to 2 times, friction 0.5 to 1.5 times the nominal, amplifier lag
/// up to 0.5 ms, jitter up to a quarter of a tick, a hand within the spread of people. The same number is the same
/// system. `plan.believed` points to a profile that lives as long as the program.
LoopPlan randomLoop(const RandomCell& cell, std::uint64_t number);

/// A hand of this kind within the spread of people; the same draw for any other kind is +-30 %.
device::HandModel handLike(device::HandKind kind, Random& random);

/// Number of the first `systems` still oscillate after a kick.
std::size_t oscillating(const RandomCell& cell, std::size_t systems);

}  // namespace palpate::lab

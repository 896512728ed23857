// A failing path made short: the same fault in as few ticks as can be found.
#pragma once

#include <vector>

#include "lab/hunt/hunt_world.h"

namespace palpate::lab {

/// Ends at the fault, begins at the latest tick from which it still comes (a free one: a new finger starts there),
/// loses what can be left out between. At most about `most_ticks` ticks are replayed. A path without the fault is
/// returned as it is.
std::vector<Vec3> minimised(HuntWorld& world, const contact::FingerSettings& finger, std::vector<Vec3> tips,
                            Fault fault, std::size_t most_ticks = 400000);

}  // namespace palpate::lab

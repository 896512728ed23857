// A failing path made short: the same fault in as few ticks as can be found.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "lab/hunt/hunt_world.h"

namespace palpate::lab {

/// The tick at which a path first shows the fault that is looked for, or nothing.
using FirstFault = std::function<std::optional<std::size_t>(std::span<const Vec3>)>;

/// Ends at the fault, begins at the latest tick from which it still comes, loses what can be left out between. At most
/// about `most_ticks` ticks are tried. A path without the fault is returned as it is.
std::vector<Vec3> minimised(std::vector<Vec3> tips, const FirstFault& first_fault, std::size_t most_ticks = 400000);

/// The same for a fault of a new finger along the path.
std::vector<Vec3> minimised(HuntWorld& world, const contact::FingerSettings& finger, std::vector<Vec3> tips,
                            Fault fault);

}  // namespace palpate::lab

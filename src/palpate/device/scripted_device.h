// A device that replays positions: the same tick always gives the same tip, which makes runs repeatable.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/device/device.h"

namespace palpate::device {

/// Tip of tick k is `tips[k]`; after the last one it rests there. Takes the forces and drops them. Throws Error for no
/// tips.
Device scriptedDevice(std::string name, std::shared_ptr<const std::vector<Vec3>> tips);

}  // namespace palpate::device

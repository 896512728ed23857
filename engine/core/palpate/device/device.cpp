// A path in memory as a device: the tick is the index. The path is shared, not copied, and read without a lock.
#include "palpate/device/device.h"

#include <algorithm>
#include <utility>

#include "palpate/base/error.h"

namespace palpate::device {

Device scriptedDevice(std::string name, std::shared_ptr<const std::vector<Vec3>> tips) {
  if (tips == nullptr || tips->empty()) throw Error(name + ": a scripted device requires at least one position");
  Device device;
  device.name = std::move(name);
  device.read_tip = [tips = std::move(tips)](std::uint64_t tick) {
    return (*tips)[std::min<std::uint64_t>(tick, tips->size() - 1)];
  };
  return device;
}

}  // namespace palpate::device

// The Device of Python: one that is open, and who has it.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "busy.h"
#include "palpate/device/device.h"

namespace palpate::python {

/// Read and written by Python, or lent to a loop, which holds `busy` meanwhile.
struct DeviceHandle {
  device::Device device;
  std::uint64_t tick = 0;  ///< tick of the next reading
  bool open = true;
  Busy busy;
};
using DevicePointer = std::shared_ptr<DeviceHandle>;

/// Devices lent to a loop for as long as this lives. Throws ValueError for one that is closed, RuntimeError for one
/// that is in use.
class LentDevices {
 public:
  explicit LentDevices(std::vector<DevicePointer> handles);

  std::vector<device::Device> devices() const;
  void releaseDevices();

 private:
  std::vector<DevicePointer> handles_;
  std::vector<std::unique_ptr<Busy::Guard>> guards_;  // before the handles go
};

}  // namespace palpate::python

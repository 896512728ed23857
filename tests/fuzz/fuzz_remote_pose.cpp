// Any bytes as a datagram of the device `remote`: nothing, or a finite place that a finger can be at.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "palpate/device/detail/remote_gate.h"
#include "palpate/device/trajectory.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpate::device;
  const auto pose = parsePose({reinterpret_cast<const char*>(data), size});
  if (pose && !(pose->tip_mm.cwiseAbs().maxCoeff() <= kMaxCoordinateMm)) __builtin_trap();
  return 0;
}

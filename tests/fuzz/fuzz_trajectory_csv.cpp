// Any bytes as a trajectory: finite positions at growing times, or one Error. What was read is written and read again.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/device/trajectory.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpate::device;
  Trajectory read;
  try {
    read = parseTrajectory({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
  } catch (const palpate::Error& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    return 0;
  }
  if (read.size() == 0) __builtin_trap();
  for (std::size_t i = 0; i < read.size(); ++i) {
    if (!read.tip_mm[i].allFinite() || (i > 0 && !(read.time_s[i] > read.time_s[i - 1]))) __builtin_trap();
  }
  try {
    // Long ones are legal but would only measure memory.
    if (read.time_s.back() - read.time_s.front() < 10.0) resampled(read, 0.001);
  } catch (const palpate::Error&) {
  }
  return 0;
}

// Any bytes as an answer of Haply's service: devices whose places a hand can be at and whose names can be sent back, or
// a reason; and as its page about the version.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "palpate/device/hardware/haply_message.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpate::device::haply;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const Reply reply = parseReply(text);
  if (!reply.wrong.empty() && !reply.devices.empty()) __builtin_trap();
  if (reply.devices.size() > kMaxDevices || reply.wrong.find('\n') != std::string::npos) __builtin_trap();
  for (const DeviceReply& device : reply.devices) {
    if (device.id.empty() || device.id.find_first_of("\"\\\n") != std::string::npos) __builtin_trap();
    if (device.place_m && !(device.place_m->cwiseAbs().maxCoeff() <= kMaxReachM)) __builtin_trap();
    if (!device.speed_m_s.allFinite()) __builtin_trap();
    const DeviceOrder order{device.id, palpate::Vec3::Zero(), true, false};
    if (orderText({&order, 1}, {}).find(device.id) == std::string::npos) __builtin_trap();
  }
  const Version version = parseVersion(text);
  if (version.major < 0 || version.minor < 0) __builtin_trap();
  return 0;
}

// Any bytes as what a plugin fills in: its table, what its device can, what it reads, its words. Whatever comes of them
// is finite or a fault, and a word ends.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "palpate/device/hardware/plugin_checks.h"
#include "palpate/device/trajectory.h"

namespace {

using namespace palpate::device;

/// The next bytes as a structure; zeros where they end.
template <class Structure>
Structure next(const std::uint8_t*& data, std::size_t& size) {
  Structure structure{};
  const std::size_t bytes = size < sizeof(structure) ? size : sizeof(structure);
  std::memcpy(&structure, data, bytes);
  data += bytes;
  size -= bytes;
  return structure;
}

void expect(bool kept) {
  if (!kept) __builtin_trap();
}

bool isOneLine(const std::string& words) { return words.find_first_of("\n\r\t") == std::string::npos; }

bool isSensible(double value) { return value >= 0.0 && value <= 1e6; }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto table = next<palpate_device_table>(data, size);
  const bool whole = table.size >= sizeof(table) && table.version == PALPATE_DEVICE_VERSION && table.name != nullptr &&
                     table.about != nullptr && table.open != nullptr && table.close != nullptr &&
                     table.capabilities != nullptr && table.read != nullptr && table.write != nullptr;
  expect(plugin::findFault(&table).empty() == whole);

  const auto able = next<palpate_device_capabilities>(data, size);
  const Capabilities said = plugin::checkedCapabilities(able, {});
  expect(isSensible(said.max_force_n) && isSensible(said.continuous_force_n) && isSensible(said.rate_hz));
  expect(isSensible(said.nominal_stiffness_n_per_mm));
  expect(said.workspace_mm.isEmpty() || said.workspace_mm.sizes().allFinite());
  expect(isOneLine(said.model) && isOneLine(said.version));

  const int answer = next<int>(data, size);
  const auto reading = next<palpate_device_reading>(data, size);
  const DriverReading found = plugin::checkReading(answer, reading, {}, 0.001);
  const bool is_place = found.tip.allFinite() && found.tip.cwiseAbs().maxCoeff() <= kMaxCoordinateMm;
  expect(found.faults != 0 || (is_place && answer >= 0));
  expect(found.velocity.allFinite());
  DriverLink link({0.001, 1000.0, said.max_force_n});
  link.publish(found);
  expect(link.read(0).allFinite() == (found.faults == 0));
  link.write({1e3, 0.0, 0.0});
  expect(found.faults == 0 || link.dueForce().isZero());

  expect(isOneLine(plugin::boundedText(reinterpret_cast<const char*>(data), size)));
  return 0;
}

// Everything is compared so that a NaN fails.
#include "palpate/device/hardware/plugin_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "palpate/base/nearest_name.h"
#include "palpate/device/trajectory.h"

namespace palpate::device::plugin {

namespace {

/// Beyond these a number is a mistake in the plugin.
constexpr double kMaxForceN = 1000.0;
constexpr double kMaxStiffnessNPerMm = 1e6;
constexpr double kMaxRateHz = 1e6;
constexpr double kMaxPlaceMm = 1e9;  // in the device's own frame, with a wide margin
constexpr double kMaxSpeedMmS = 1e6;
constexpr double kMaxReachMm = 1e5;

constexpr std::uint32_t kKnownFaults = PALPATE_DEVICE_NO_POSE | PALPATE_DEVICE_NOT_CALIBRATED;
constexpr std::uint32_t kKnownNotes = kWarmMotors | kForceExceeded | kVelocityExceeded | kForceLimited;
static_assert(PALPATE_DEVICE_NO_POSE == kNoPose && PALPATE_DEVICE_NOT_CALIBRATED == kNotCalibrated);
static_assert(PALPATE_DEVICE_WARM_MOTORS == kWarmMotors && PALPATE_DEVICE_FORCE_EXCEEDED == kForceExceeded);
static_assert(PALPATE_DEVICE_VELOCITY_EXCEEDED == kVelocityExceeded && PALPATE_DEVICE_FORCE_LIMITED == kForceLimited);

double sensible(double value, double most) { return value > 0.0 && value <= most ? value : 0.0; }

Vec3 toVec3(const double (&numbers)[3]) { return {numbers[0], numbers[1], numbers[2]}; }

bool isWithin(const Vec3& vector, double most) { return vector.allFinite() && vector.cwiseAbs().maxCoeff() <= most; }

Box3 reachOf(const palpate_device_capabilities& able, const DeviceFrame& frame) {
  const Vec3 low = toVec3(able.reach_min_mm);
  const Vec3 high = toVec3(able.reach_max_mm);
  Box3 reach;
  if (!isWithin(low, kMaxReachMm) || !isWithin(high, kMaxReachMm) || !(low.array() < high.array()).all()) return reach;
  reach.extend(frame.placeInBody(low));
  reach.extend(frame.placeInBody(high));
  return reach;
}

}  // namespace

std::string boundedText(const char* room, std::size_t bytes) {
  if (room == nullptr) return {};
  return oneLine({room, static_cast<std::size_t>(std::find(room, room + bytes, '\0') - room)}, bytes);
}

std::string findFault(const palpate_device_table* table) {
  if (table == nullptr) {
    return fmt::format("it returns no table; it requires another palpate_device.h than version {}",
                       PALPATE_DEVICE_VERSION);
  }
  if (table->size < sizeof(palpate_device_table)) {
    return fmt::format("its table has {} bytes, {} are needed", table->size, sizeof(palpate_device_table));
  }
  if (table->version != PALPATE_DEVICE_VERSION) {
    return fmt::format("it was written for version {} of palpate_device.h, this program knows {}", table->version,
                       PALPATE_DEVICE_VERSION);
  }
  std::vector<const char*> missing;
  if (table->name == nullptr) missing.push_back("name");
  if (table->about == nullptr) missing.push_back("about");
  if (table->open == nullptr) missing.push_back("open");
  if (table->close == nullptr) missing.push_back("close");
  if (table->capabilities == nullptr) missing.push_back("capabilities");
  if (table->read == nullptr) missing.push_back("read");
  if (table->write == nullptr) missing.push_back("write");
  return missing.empty() ? std::string() : fmt::format("its table lacks {}", fmt::join(missing, ", "));
}

Capabilities checkedCapabilities(const palpate_device_capabilities& able, const DeviceFrame& frame) {
  Capabilities said;
  said.takes_force = true;
  said.max_force_n = sensible(able.max_force_n, kMaxForceN);
  said.continuous_force_n = sensible(able.continuous_force_n, kMaxForceN);
  said.nominal_stiffness_n_per_mm = sensible(able.stiffness_n_per_mm, kMaxStiffnessNPerMm);
  said.workspace_mm = reachOf(able, frame);
  said.rate_hz = sensible(able.rate_hz, kMaxRateHz);
  said.delay_ticks = 1;
  const bool at_once = (able.flags & PALPATE_DEVICE_ANSWERS_AT_ONCE) != 0;
  said.rhythm = at_once ? Rhythm::on_call : Rhythm::blocking;
  said.model = boundedText(able.model, sizeof(able.model));
  said.version = boundedText(able.version, sizeof(able.version));
  return said;
}

DriverReading checkReading(int answer, const palpate_device_reading& reading, const DeviceFrame& frame, double tick_s) {
  DriverReading found;
  if (answer < 0) {
    found.faults = kDriverError;
    return found;
  }
  const Vec3 tip = toVec3(reading.tip_mm);
  const Vec3 velocity = toVec3(reading.velocity_mm_s);
  found.tip = isWithin(tip, kMaxPlaceMm) ? frame.placeInBody(tip) : kNoPlace;
  found.velocity = isWithin(velocity, kMaxSpeedMmS) ? frame.motionInBody(velocity) : Vec3::Zero();
  found.buttons = reading.buttons;
  found.notes = reading.notes & kKnownNotes;
  found.faults = reading.faults & kKnownFaults;
  if (reading.faults != found.faults) found.faults |= kDriverError;  // a fault that is not known is one
  if (!found.tip.allFinite()) found.faults |= kNoPose;
  const double most_age_s = static_cast<double>(kMaxPoseTicks) * tick_s;
  if (!(reading.age_s >= 0.0 && reading.age_s <= most_age_s)) found.faults |= kStalePose;
  return found;
}

}  // namespace palpate::device::plugin

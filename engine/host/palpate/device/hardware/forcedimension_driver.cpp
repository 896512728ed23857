// due force -> dhdSetForce; dhdGetPosition -> reading. "Too soon" is not an error: nothing is published and the
// position grows old by itself. A lost device is closed and opened again by its index, on this thread, so the servo
// never waits.
#include "palpate/device/hardware/forcedimension_driver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"
#include "palpate/device/detail/each_back_end.h"

namespace palpate::device::forcedimension {

namespace {

/// Exchanges without an answer after which a device is taken for lost, and between two looks for it: 10 ms, half a
/// second.
constexpr std::uint64_t kLostAfter = 20;
constexpr std::uint64_t kLookAgainAfter = 1000;

/// Smoothing of the velocity where the library gives none, s.
constexpr double kVelocitySmoothingS = 0.02;

constexpr std::size_t kMaxDevices = 64;
constexpr double kMmPerM = 1000.0;

/// Indices that this program holds: the library opens a device any number of times.
struct Holdings {
  std::mutex mutex;
  std::array<bool, kMaxDevices> held{};
};
Holdings& holdings() {
  static Holdings all;
  return all;
}

bool tryReserve(int index) {
  const std::lock_guard lock(holdings().mutex);
  return !std::exchange(holdings().held[static_cast<std::size_t>(index)], true);
}
void releaseHolding(int index) {
  const std::lock_guard lock(holdings().mutex);
  holdings().held[static_cast<std::size_t>(index)] = false;
}

std::string libraryErrorText(const Api& api) {
  const char* words = api.last_error == nullptr ? nullptr : api.last_error();
  return words == nullptr ? "no reason given" : oneLine(words);
}

}  // namespace

Driver::Driver(const Api& api, char index, char id, const DeviceFrame& frame, const OpenOptions& options)
    : api_(api), index_(index), id_(id), frame_(frame) {
  askAbilities(options);
  link_ = std::make_unique<DriverLink>(DriverLinkSettings{options.tick_s, kExchangesPerS, capabilities_.max_force_n});
  api_.set_force(0.0, 0.0, 0.0, id_);
  api_.enable_force(1, id_);
}

void Driver::releaseDevice() noexcept {
  if (let_go_.exchange(true)) return;
  if (!lost_) {
    api_.set_force(0.0, 0.0, 0.0, id_);
    api_.enable_force(0, id_);
    api_.close(id_);
  }
  releaseHolding(index_);
}

void Driver::askAbilities(const OpenOptions& options) {
  capabilities_.takes_force = true;
  capabilities_.rate_hz = kExchangesPerS;
  capabilities_.delay_ticks = 1;
  capabilities_.rhythm = Rhythm::blocking;
  capabilities_.version = readVersion(api_).words;
  const TypeProfile* profile = api_.system_type == nullptr ? nullptr : profileOf(api_.system_type(id_));
  if (profile != nullptr) {
    capabilities_.model = profile->model;
    capabilities_.kind = profile->kind;
    capabilities_.documented = true;
    capabilities_.max_force_n = profile->max_force_n;
    capabilities_.nominal_stiffness_n_per_mm = profile->nominal_stiffness_n_per_mm;
    const Vec3 reach = Vec3::Constant(options.scale * profile->reach_mm);
    capabilities_.workspace_mm = Box3(options.origin_mm - reach, options.origin_mm + reach);
  }
  const char* name = api_.system_name == nullptr ? nullptr : api_.system_name(id_);
  if (name != nullptr && *name != '\0') capabilities_.model = oneLine(name);
}

void Driver::exchange() noexcept {
  if (let_go_.load(std::memory_order_relaxed)) return;
  const Vec3 force = frame_.forceInDevice(link_->dueForce());
  if (lost_.load(std::memory_order_relaxed)) {
    tryReopen();
    return;
  }
  const int sent = api_.set_force(force.x(), force.y(), force.z(), id_);
  Vec3 place = Vec3::Zero();
  const int got = api_.get_position(place.data(), place.data() + 1, place.data() + 2, id_);
  if (sent < 0 || got < 0) {
    refused();
    return;
  }
  refusals_ = 0;
  if (got == kTimeGuard) return;
  DriverReading reading;
  reading.tip = frame_.placeInBody(place);
  reading.velocity = frame_.motionInBody(velocityAt(place));
  reading.buttons = buttons();
  reading.notes = sent == kMotorSaturated ? kForceExceeded : 0u;
  link_->publish(reading);
}

void Driver::refused() noexcept {
  if (api_.last_error != nullptr) last_error_.store(api_.last_error(), std::memory_order_relaxed);
  has_place_ = false;
  DriverReading reading;
  reading.faults = kDriverError;
  link_->publish(reading);
  if (++refusals_ < kLostAfter) return;
  api_.close(id_);
  lost_.store(true, std::memory_order_relaxed);
  refusals_ = 0;
}

void Driver::tryReopen() noexcept {
  DriverReading reading;
  reading.faults = kDriverError;
  link_->publish(reading);
  if (++refusals_ % kLookAgainAfter != 0) return;
  const int id = api_.open(index_);
  if (id < 0) return;
  id_ = static_cast<char>(id);
  api_.set_force(0.0, 0.0, 0.0, id_);
  api_.enable_force(1, id_);
  refusals_ = 0;
  lost_.store(false, std::memory_order_relaxed);
}

/// m/s in the device's frame.
Vec3 Driver::velocityAt(const Vec3& place) noexcept {
  Vec3 speed = Vec3::Zero();
  if (api_.get_velocity != nullptr && api_.get_velocity(speed.data(), speed.data() + 1, speed.data() + 2, id_) >= 0) {
    return speed;
  }
  const double share = 1.0 / (kVelocitySmoothingS * kExchangesPerS);
  if (has_place_) {
    speed_ += share * (kExchangesPerS * (place - last_place_) - speed_);
  } else {
    speed_.setZero();
  }
  last_place_ = place;
  has_place_ = true;
  return speed_;
}

std::uint32_t Driver::buttons() const noexcept {
  if (api_.button_mask != nullptr) return api_.button_mask(id_);
  return api_.button != nullptr && api_.button(0, id_) > 0 ? 1u : 0u;
}

std::string Driver::explain() const {
  const std::uint32_t faults = link_->driverFaults();
  const char* words = last_error_.load(std::memory_order_relaxed);
  if ((faults & kDriverError) != 0) {
    return fmt::format("the library reports: {}; check cable and power supply of the device, it is looked for again",
                       words == nullptr ? "no reason given" : oneLine(words));
  }
  if ((faults & kNoPose) != 0) return "the library reports no position; check the device's cable";
  return {};
}

int devicesFound(const Api& api) { return std::max(0, api.device_count()); }

Opened openDriver(const Api& api, const OpenOptions& options) {
  Opened opened;
  const DeviceFrame frame = frameOf(options, "y,z,x", kMmPerM);
  const int count = std::min(devicesFound(api), static_cast<int>(kMaxDevices));
  opened.remedy = "plug the device and its power supply in, and end other programs that use it";
  if (count == 0) {
    opened.reason = "the library finds no device";
    return opened;
  }
  int first = 0;
  int last = count - 1;
  if (!options.which.empty()) {
    const std::optional<double> wanted = parseNumber(options.which);
    if (!wanted || *wanted < 0.0 || *wanted > last || *wanted != std::floor(*wanted)) {
      opened.reason = fmt::format("no device '{}'", oneLine(options.which));
      opened.remedy = fmt::format("use 0 to {}, or omit it for the first", last);
      return opened;
    }
    first = last = static_cast<int>(*wanted);
  }
  opened.reason = "all devices are in use by this program";
  for (int i = first; i <= last; ++i) {
    const char index = static_cast<char>(i);
    if (!tryReserve(i)) continue;
    const int id = api.open(index);
    if (id >= 0) {
      opened.reason.clear();
      opened.remedy.clear();
      opened.driver = std::make_unique<Driver>(api, index, static_cast<char>(id), frame, options);
      return opened;
    }
    releaseHolding(i);
    opened.reason = fmt::format("device {} does not open: {}", i, libraryErrorText(api));
  }
  return opened;
}

}  // namespace palpate::device::forcedimension

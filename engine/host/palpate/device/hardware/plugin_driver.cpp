// dueForce() -> write; read -> checked -> publish(). A plugin that answers at once is called by the servo, and letting
// go waits for the current call: the servo never waits.
#include "palpate/device/hardware/plugin_driver.h"

#include <fmt/format.h>

#include <array>
#include <thread>
#include <utility>

#include "palpate/device/detail/each_back_end.h"
#include "palpate/device/hardware/plugin_checks.h"

namespace palpate::device::plugin {

namespace {

/// Exchanges without an answer after which a device is closed, 10 ms.
constexpr int kLostAfter = 20;

using Room = std::array<char, kWordsRoom>;

DriverLinkSettings linkSettings(const OpenOptions& options, const Capabilities& able) {
  const bool at_once = able.rhythm == Rhythm::on_call;
  return {options.tick_s, at_once ? 1.0 / options.tick_s : kExchangesPerS, able.max_force_n};
}

palpate_device_handle openHandle(const palpate_device_table& table, const std::string& which, std::string& reason) {
  Room room{};
  palpate_device_handle device = table.open(which.c_str(), room.data(), kWordsRoom);
  if (device == nullptr) reason = boundedText(room.data(), room.size());
  if (device == nullptr && reason.empty()) reason = "it does not open, and reports no reason";
  return device;
}

}  // namespace

Driver::Driver(const palpate_device_table& table, palpate_device_handle device, const palpate_device_capabilities& able,
               const DeviceFrame& frame, const OpenOptions& options, std::string which)
    : table_(table),
      device_(device),
      frame_(frame),
      capabilities_(checkedCapabilities(able, frame)),
      link_(linkSettings(options, capabilities_)),
      which_(std::move(which)),
      tick_s_(options.tick_s) {}

int Driver::sendForce(const Vec3& force) noexcept {
  const Vec3 newtons = frame_.forceInDevice(force);
  return table_.write(device_, newtons.data());
}

bool Driver::fetchReading(int told) noexcept {
  palpate_device_reading reading{};
  reading.size = sizeof(reading);
  const int got = table_.read(device_, &reading);
  if (got == PALPATE_DEVICE_NOT_YET && told >= 0) return true;
  const bool failed = told < 0 || got < 0;
  link_.publish(checkReading(failed ? PALPATE_DEVICE_ERROR : got, reading, frame_, tick_s_));
  return !failed;
}

void Driver::exchange() noexcept {
  const std::lock_guard turn(turns_);
  const Vec3 force = link_.dueForce();
  if (device_ == nullptr) {
    DriverReading reading;
    reading.faults = kDriverError;
    link_.publish(reading);
  } else if (fetchReading(sendForce(force))) {
    refusals_ = 0;
  } else {
    refused();
  }
}

void Driver::refused() noexcept {
  {
    std::string words = pluginErrorText();
    const std::lock_guard lock(words_mutex_);
    trouble_ = std::move(words);
  }
  if (++refusals_ < kLostAfter) return;
  sendForce(Vec3::Zero());
  table_.close(device_);
  device_ = nullptr;
}

std::string Driver::pluginErrorText() noexcept {
  Room room{};
  if (table_.explain != nullptr) table_.explain(device_, room.data(), kWordsRoom);
  const std::string words = boundedText(room.data(), room.size());
  return fmt::format("the plugin reports: {}", words.empty() ? "no reason given" : words);
}

Vec3 Driver::read(std::uint64_t tick) noexcept {
  if (!isOnCall()) return link_.read(tick);
  servo_is_in_ = true;
  if (!gone_) fetchReading(told_);
  servo_is_in_ = false;
  return link_.read(tick);
}

void Driver::write(const Vec3& force) noexcept {
  link_.write(force);
  if (!isOnCall()) return;
  servo_is_in_ = true;
  if (!gone_) told_ = sendForce(link_.dueForce());
  servo_is_in_ = false;
}

void Driver::releaseDevice() noexcept {
  const std::lock_guard turn(turns_);
  if (gone_.exchange(true)) return;
  link_.mute();
  while (servo_is_in_) std::this_thread::yield();
  if (device_ == nullptr) return;
  sendForce(Vec3::Zero());
  table_.close(device_);
  device_ = nullptr;
}

bool Driver::revive() {
  const std::lock_guard turn(turns_);
  if (gone_) return false;
  if (device_ != nullptr) return link_.driverFaults() == 0;
  std::string reason;
  device_ = openHandle(table_, which_, reason);
  refusals_ = 0;
  const std::lock_guard lock(words_mutex_);
  if (device_ == nullptr) trouble_ = reason;
  return device_ != nullptr;
}

std::string Driver::explain() {
  const std::uint32_t faults = link_.driverFaults();
  if (faults == 0 || gone_) return {};
  if ((faults & kDriverError) != 0 && isOnCall()) {
    const std::lock_guard turn(turns_);
    return device_ == nullptr ? std::string() : pluginErrorText();
  }
  if ((faults & kDriverError) != 0) {
    const std::lock_guard lock(words_mutex_);
    return trouble_;
  }
  if ((faults & kNotCalibrated) != 0)
    return "the device has no position reference; calibrate it as its maker describes";
  if ((faults & kStalePose) != 0) return "the plugin's position is too old";
  return "the plugin reports no position";
}

Opened openDriver(const palpate_device_table& table, const std::string& which, const OpenOptions& options) {
  const DeviceFrame frame = frameOf(options);
  Opened opened;
  palpate_device_handle device = openHandle(table, which, opened.reason);
  if (device == nullptr) return opened;
  palpate_device_capabilities able{};
  able.size = sizeof(able);
  if (table.capabilities(device, &able) < 0) {
    opened.reason = "it does not report the device's capabilities";
    table.close(device);
    return opened;
  }
  opened.driver = std::make_unique<Driver>(table, device, able, frame, options, which);
  return opened;
}

}  // namespace palpate::device::plugin

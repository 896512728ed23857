// Driver -> Device, and the doctor's questions in their order: library, functions, version, bus, device. Cold path but
// for the three functions of a tick, which are the link's.
#include "palpate/device/detail/each_back_end.h"

#include <fmt/format.h>

#include <memory>
#include <mutex>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/device/detail/driver_thread.h"
#include "palpate/device/hardware/forcedimension_driver.h"
#include "palpate/device/hardware/library_report.h"
#include "palpate/device/hardware/usb_search.h"

namespace palpate::device {

namespace {

/// The oldest library with the functions as used here.
constexpr int kOldestMajor = 3;

UsbMarks forceDimensionMarks() { return {.words = {"force dimension", "novint"}, .numbers = {"0403:cb48"}}; }

struct DhdLibrary {
  SharedLibrary library;
  forcedimension::Api api;
};

/// Loads it and reports its faults.
DhdLibrary loadDhd(const OpenOptions& options, Probe& probe) {
  DhdLibrary loaded;
  std::vector<std::string> missing;
  loaded.library = openLibrary(forcedimension::libraryNames(options.library));
  if (loaded.library) missing = forcedimension::resolveApi(loaded.library, loaded.api);
  const LibraryRemedies remedies{.variable = forcedimension::kLibraryVariable,
                                 .install = "install the maker's SDK, 3.0 or newer (docs/reference/devices.md)",
                                 .dependencies = {{"libusb", "install the system's libusb-1.0-0"}}};
  reportLibrary({"Force Dimension SDK (libdrd, libdhd)", loaded.library, missing, remedies}, probe);
  if (!probe.reason.empty()) return loaded;
  const forcedimension::Version version = forcedimension::readVersion(loaded.api);
  probe.version = version.words;
  if (version.major != 0 && version.major < kOldestMajor) {
    probe.reason = fmt::format("{} is version {}, {}.0 is the oldest that will do", loaded.library.path, version.words,
                               kOldestMajor);
    probe.remedy = remedies.install;
  }
  return loaded;
}

/// The driver and, if it has one, the thread of its exchanges; released when the last function of the Device is gone.
class HeldDriver {
 public:
  HeldDriver(std::unique_ptr<forcedimension::Driver> driver, bool own_thread) : driver_(std::move(driver)) {
    if (!own_thread) return;
    thread_ = std::make_unique<DriverThread>([this] { driver_->exchange(); }, forcedimension::kExchangesPerS);
  }
  ~HeldDriver() { close(); }
  HeldDriver(const HeldDriver&) = delete;
  HeldDriver& operator=(const HeldDriver&) = delete;

  forcedimension::Driver& driver() { return *driver_; }

  /// A servo that still runs reads and writes the link, so that stays; the device gets one exchange of zero force.
  void close() {
    const std::lock_guard lock(mutex_);
    if (driver_->link().muted()) return;
    driver_->link().mute();
    thread_.reset();
    driver_->exchange();
    driver_->releaseDevice();
  }

 private:
  std::unique_ptr<forcedimension::Driver> driver_;
  std::unique_ptr<DriverThread> thread_;
  std::mutex mutex_;
};

}  // namespace

Probe probeForceDimension(const OpenOptions& options) {
  Probe probe;
  const DhdLibrary loaded = loadDhd(options, probe);
  const std::vector<UsbDevice> plugged = usbDevices(forceDimensionMarks(), options.system_root);
  reportPlugged("Force Dimension or Novint", plugged, probe);
  if (!probe.reason.empty()) return probe;
  const forcedimension::Opened opened = forcedimension::openDriver(loaded.api, options);
  probe.available = opened.driver != nullptr;
  probe.reason = opened.reason;
  probe.remedy = opened.remedy;
  if (probe.available) probe.devices.push_back(opened.driver->capabilities().model);
  explainByBus(plugged, "palpate-forcedimension", probe);
  return probe;
}

Device openForceDimension(const OpenOptions& options) {
  Probe probe;
  const DhdLibrary loaded = loadDhd(options, probe);
  forcedimension::Opened opened;
  if (probe.reason.empty()) {
    opened = forcedimension::openDriver(loaded.api, options);
    probe.reason = opened.reason;
    probe.remedy = opened.remedy;
    if (!opened.driver) {
      explainByBus(usbDevices(forceDimensionMarks(), options.system_root), "palpate-forcedimension", probe);
    }
  }
  if (!opened.driver) throw Error(probeFailureText(backEndNamed("forcedimension"), probe));
  Device device;
  device.name = options.which.empty() ? "forcedimension" : "forcedimension:" + options.which;
  device.capabilities = opened.driver->capabilities();
  const auto held = std::make_shared<HeldDriver>(std::move(opened.driver), options.own_thread);
  device.read_tip = [held](std::uint64_t tick) { return held->driver().link().read(tick); };
  device.write_force = [held](const Vec3& force) { held->driver().link().write(force); };
  device.state = [held] { return held->driver().link().state(); };
  device.explain = [held] { return held->driver().explain(); };
  if (!options.own_thread) device.exchange = [held] { held->driver().exchange(); };
  device.close = [held] { held->close(); };
  return device;
}

}  // namespace palpate::device

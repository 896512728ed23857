// Session's slot -> Device, and the doctor's questions in their order: library, functions, bus, device. Cold path but
// for the three functions of a tick, which are the link's.
#include "palpate/base/path_text.h"
#include "palpate/device/detail/each_back_end.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdlib>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/system/process.h"
#include "palpate/device/hardware/library_report.h"
#include "palpate/device/hardware/openhaptics_session.h"
#include "palpate/device/hardware/usb_search.h"

namespace palpate::device {

namespace {

constexpr const char* kLibraryWords = "OpenHaptics (libHD)";

LibraryRemedies remedies() {
  return {.variable = openhaptics::kLibraryVariable,
          .install = "install the maker's device driver and OpenHaptics, 3.0 or newer (docs/reference/devices.md)",
          .dependencies = {{"libncurses", "install the system's libncurses5 and libtinfo5"},
                           {"libtinfo", "install the system's libtinfo5"},
                           {"libPhantomIO", "install the maker's device driver, which contains it"},
                           {"libPHANToMIO", "install the maker's device driver, which contains it"}}};
}

UsbMarks marks() { return {.words = {"3d systems", "sensable", "geomagic"}, .numbers = {}}; }

/// A Touch shows as a serial port or as a raw input device.
std::vector<UsbDevice> pluggedIn(const OpenOptions& options) {
  std::vector<UsbDevice> found = usbDevices(marks(), options.system_root);
  if (!found.empty()) return found;
  return deviceNodes(std::array<std::string, 1>{"ttyACM"}, options.system_root);
}

void lookForConfiguration(Probe& probe) {
  std::string folder = system::variable("GTDD_HOME");
  if (folder.empty()) folder = "/usr/share/3DSystems/config";
  std::error_code error;
  probe.looked_for.push_back(
      {"the driver's settings (GTDD_HOME)", folder, std::filesystem::is_directory(pathOf(folder), error), ""});
}

/// Opens it for a moment. One that this program holds already is there.
void tryDevice(const openhaptics::Loaded& loaded, const OpenOptions& options, Probe& probe) {
  const std::shared_ptr<openhaptics::Session> session = openhaptics::sharedSession(loaded);
  probe.devices = session->heldDevices();
  probe.available = !probe.devices.empty();
  if (probe.available) return;
  const openhaptics::Added added = session->add(options);
  if (!added.slot) {
    probe.reason = added.reason;
    probe.remedy = added.remedy;
    return;
  }
  probe.available = true;
  probe.version = added.slot->capabilities.version;
  probe.devices.push_back(added.slot->capabilities.model);
  session->release(added.slot);
}

/// Releases the slot with the last function of the Device.
class HeldSlot {
 public:
  HeldSlot(std::shared_ptr<openhaptics::Session> session, std::shared_ptr<openhaptics::Slot> slot)
      : session_(std::move(session)), slot_(std::move(slot)) {}
  ~HeldSlot() { session_->release(slot_); }
  HeldSlot(const HeldSlot&) = delete;
  HeldSlot& operator=(const HeldSlot&) = delete;

  openhaptics::Session& session() { return *session_; }
  openhaptics::Slot& slot() { return *slot_; }
  void release() { session_->release(slot_); }

 private:
  std::shared_ptr<openhaptics::Session> session_;
  std::shared_ptr<openhaptics::Slot> slot_;
};

}  // namespace

Probe probeOpenHaptics(const OpenOptions& options) {
  Probe probe;
  const openhaptics::Loaded loaded = openhaptics::load(options);
  reportLibrary({kLibraryWords, loaded.library, loaded.missing, remedies()}, probe);
  const std::vector<UsbDevice> plugged = pluggedIn(options);
  reportPlugged("3D Systems, Geomagic or SensAble", plugged, probe);
  lookForConfiguration(probe);
  if (!probe.reason.empty()) return probe;
  tryDevice(loaded, options, probe);
  explainByBus(plugged, "palpate-openhaptics", probe);
  return probe;
}

Device openOpenHaptics(const OpenOptions& options) {
  const openhaptics::Loaded loaded = openhaptics::load(options);
  Probe probe;
  reportLibrary({kLibraryWords, loaded.library, loaded.missing, remedies()}, probe);
  if (!probe.reason.empty()) throw Error(probeFailureText(backEndNamed("openhaptics"), probe));
  const std::shared_ptr<openhaptics::Session> session = openhaptics::sharedSession(loaded);
  openhaptics::Added added = session->add(options);
  if (!added.slot) {
    probe.reason = added.reason;
    probe.remedy = added.remedy;
    explainByBus(pluggedIn(options), "palpate-openhaptics", probe);
    throw Error(probeFailureText(backEndNamed("openhaptics"), probe));
  }
  Device device;
  device.name = options.which.empty() ? "openhaptics" : "openhaptics:" + options.which;
  device.capabilities = added.slot->capabilities;
  const auto held = std::make_shared<HeldSlot>(session, added.slot);
  device.read_tip = [held](std::uint64_t tick) { return held->slot().link.read(tick); };
  device.write_force = [held](const Vec3& force) { held->slot().link.write(force); };
  device.state = [held] { return held->slot().link.state(); };
  device.explain = [held] { return held->session().explain(held->slot()); };
  device.revive = [held] { return held->session().revive(held->slot()); };
  device.close = [held] { held->release(); };
  return device;
}

}  // namespace palpate::device

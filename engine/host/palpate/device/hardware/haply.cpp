// Session's slot -> Device, and the doctor's questions in their order: settings, service, devices on the bus. Cold path
// but for the three functions of a tick, which are the link's.
#include "palpate/device/detail/each_back_end.h"

#include <memory>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/device/hardware/haply_session.h"
#include "palpate/device/hardware/library_report.h"

namespace palpate::device {

namespace {

/// Releases the device with the last function of the Device.
class HeldInverse {
 public:
  HeldInverse(std::shared_ptr<haply::Session> session, std::shared_ptr<haply::Slot> slot)
      : session_(std::move(session)), slot_(std::move(slot)) {}
  ~HeldInverse() { release(); }
  HeldInverse(const HeldInverse&) = delete;
  HeldInverse& operator=(const HeldInverse&) = delete;

  haply::Session& session() { return *session_; }
  haply::Slot& slot() { return *slot_; }
  void release() { session_->release(slot_); }

 private:
  std::shared_ptr<haply::Session> session_;
  std::shared_ptr<haply::Slot> slot_;
};

/// A device that this program holds is there too.
void listDevices(const haply::Service& service, const std::string& which, Probe& probe) {
  for (const haply::DeviceReply& device : service.snapshot.devices) {
    if (which.empty() || which == device.id || which == device.handedness) {
      probe.devices.push_back(haply::describeModel(device));
    }
  }
  probe.available = !probe.devices.empty();
  if (probe.available) return;
  const haply::Added none = haply::explainMissingDevice(service, which);
  probe.reason = none.reason;
  probe.remedy = none.remedy;
}

}  // namespace

Probe probeHaply(const OpenOptions& options) {
  Probe probe;
  try {
    const haply::Service service = haply::findService(haply::settingsOf(options.library), options.system_root, probe);
    reportPlugged("Haply", usbDevices({.words = {"haply"}, .numbers = {}}, options.system_root), probe);
    if (service.connection) listDevices(service, options.which, probe);
  } catch (const Error& error) {
    probe.reason = error.what();
    probe.remedy = std::string("mend or unset ") + haply::kServiceVariable;
  }
  return probe;
}

Device openHaply(const OpenOptions& options) {
  const std::shared_ptr<haply::Session> session = haply::sharedSession(haply::settingsOf(options.library));
  const haply::Added added = session->add(options);
  if (!added.slot) {
    Probe probe;
    probe.reason = added.reason;
    probe.remedy = added.remedy;
    throw Error(probeFailureText(backEndNamed("haply"), probe));
  }
  Device device;
  device.name = options.which.empty() ? "haply" : "haply:" + options.which;
  device.capabilities = added.slot->capabilities;
  const auto held = std::make_shared<HeldInverse>(session, added.slot);
  device.read_tip = [held](std::uint64_t tick) { return held->slot().link.read(tick); };
  device.write_force = [held](const Vec3& force) { held->slot().link.write(force); };
  device.state = [held] { return held->slot().link.state(); };
  device.explain = [held] { return held->session().explain(held->slot()); };
  device.revive = [held] { return held->session().revive(held->slot()); };
  if (!options.own_thread) device.exchange = [held] { held->session().exchangeByHand(held->slot()); };
  device.close = [held] { held->release(); };
  return device;
}

}  // namespace palpate::device

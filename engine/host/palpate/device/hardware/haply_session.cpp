// dueForce() of every slot -> one message -> its answer -> publish() to every slot. An invalid answer leaves no device
// a place; a connection that broke is opened again by revive(), so that this thread never waits for long.
#include "palpate/device/hardware/haply_session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/stopwatch.h"
#include "palpate/device/detail/each_back_end.h"

namespace palpate::device::haply {

namespace {

constexpr double kMmPerM = 1000.0;

/// Force and reach of the maker's tutorials for these devices; no other figure is published.
constexpr double kTutorialWallNPerMm = 1.0;
constexpr double kReachMm = 100.0;
constexpr double kSmallReachMm = 40.0;

Capabilities capabilitiesOf(const DeviceReply& device, const Service& service, double most_force_n,
                            const OpenOptions& options) {
  Capabilities able;
  able.takes_force = true;
  able.max_force_n = most_force_n;
  able.nominal_stiffness_n_per_mm = kTutorialWallNPerMm;
  const Vec3 reach = Vec3::Constant(options.scale * (device.type == "minverse" ? kSmallReachMm : kReachMm));
  able.workspace_mm = Box3(options.origin_mm - reach, options.origin_mm + reach);
  able.rate_hz = kExchangesPerS;
  able.delay_ticks = 1;
  able.rhythm = Rhythm::blocking;
  able.model = describeModel(device);
  // A Minverse is another device, whose figures are unknown.
  if (device.type.starts_with("inverse3")) able.kind = scene::DeviceModel::inverse3;
  able.version = service.version.words;
  return able;
}

std::string joinDeviceIds(const Reply& snapshot) {
  std::vector<std::string> ids;
  for (const DeviceReply& device : snapshot.devices) ids.push_back(device.id);
  return fmt::format("{}", fmt::join(ids, ", "));
}

Added refused(std::string reason, std::string remedy) { return {nullptr, std::move(reason), std::move(remedy)}; }

}  // namespace

std::string describeModel(const DeviceReply& device) {
  std::string model = device.type.empty() ? "Haply device" : device.type;
  if (model == "inverse3") model = "Inverse3";
  if (model == "inverse3x") model = "Inverse3x";
  if (model == "minverse") model = "Minverse";
  const std::string hand = device.handedness.empty() ? "" : ", " + device.handedness;
  return fmt::format("{} {}{}", model, device.id, hand);
}

Added explainMissingDevice(const Service& service, const std::string& which) {
  if (service.snapshot.devices.empty()) {
    return refused("the service knows no device",
                   "plug the device in, switch it on, and look at the service's own page");
  }
  return refused(
      fmt::format("the service has no device '{}'", oneLine(which)),
      fmt::format("use haply:left, haply:right or haply:ID with one of {}", joinDeviceIds(service.snapshot)));
}

bool Session::isHeld(const std::string& id) const {
  return std::any_of(slots_.begin(), slots_.end(), [&](const auto& slot) { return slot->id == id; });
}

Added Session::choose(const Service& service, const OpenOptions& options) {
  const std::vector<DeviceReply>& devices = service.snapshot.devices;
  const std::string& which = options.which;
  const auto is_meant = [&](const DeviceReply& device) {
    return which.empty() || device.id == which || device.handedness == which;
  };
  if (std::none_of(devices.begin(), devices.end(), is_meant)) return explainMissingDevice(service, which);
  for (const DeviceReply& device : devices) {
    if (!is_meant(device) || isHeld(device.id)) continue;
    Added added;
    added.slot = std::make_shared<Slot>(DriverLinkSettings{options.tick_s, kExchangesPerS, settings_.most_force_n},
                                        frameOf(options, "x,z,-y", kMmPerM));
    added.slot->id = device.id;
    added.slot->capabilities = capabilitiesOf(device, service, settings_.most_force_n, options);
    return added;
  }
  return refused("all of its devices that are meant are in use by this program", "name another one, or close it first");
}

void Session::adopt(Service service) {
  connection_ = std::move(service.connection);
  force_key_ = service.force_key;
  introduced_ = false;
  for (const auto& slot : slots_) {
    const auto is_it = [&](const DeviceReply& device) { return device.id == slot->id; };
    slot->configured = false;
    slot->listed = std::any_of(service.snapshot.devices.begin(), service.snapshot.devices.end(), is_it);
  }
}

Added Session::add(const OpenOptions& options) {
  const std::lock_guard lock(mutex_);
  Probe probe;
  Service service = findService(settings_, options.system_root, probe);
  if (!service.connection) return refused(probe.reason, probe.remedy);
  {
    const std::lock_guard turn(turns_);
    Added added = choose(service, options);
    if (!added.slot) return added;
    slots_.push_back(added.slot);
    tick_s_ = options.tick_s;
    by_clock_ = by_clock_ || options.own_thread;
    if (!connection_) adopt(std::move(service));
  }
  if (options.own_thread && !thread_) {
    thread_ = std::make_unique<DriverThread>([this] { exchange(); }, kExchangesPerS);
  }
  return {slots_.back(), {}, {}};
}

void Session::release(const std::shared_ptr<Slot>& slot) {
  const std::lock_guard lock(mutex_);
  {
    const std::lock_guard turn(turns_);
    const auto at = std::find(slots_.begin(), slots_.end(), slot);
    if (at == slots_.end()) return;
    slot->link.mute();
    exchangeInTurn();
    slot->leaving = true;
    exchangeInTurn();
    slots_.erase(at);
    if (!slots_.empty()) return;
    connection_.reset();
    by_clock_ = false;
  }
  thread_.reset();
}

void Session::exchangeByHand(const Slot& slot) {
  const std::lock_guard turn(turns_);
  if (by_clock_ || slots_.empty() || slots_.front().get() != &slot) return;
  exchangeInTurn();
}

void Session::exchange() noexcept {
  const std::lock_guard turn(turns_);
  exchangeInTurn();
}

void Session::exchangeInTurn() noexcept {
  try {
    exchangeWithService();
  } catch (const std::exception& error) {
    connection_.reset();
    for (const auto& slot : slots_) publishTrouble(*slot, error.what());
  }
}

void Session::exchangeWithService() {
  std::vector<DeviceOrder> orders;
  for (const auto& slot : slots_) {
    const Vec3 force = slot->frame.forceInDevice(slot->link.dueForce());
    if (slot->listed) orders.push_back({slot->id, force, !slot->configured, slot->leaving});
  }
  if (!connection_) {
    for (const auto& slot : slots_) publishTrouble(*slot, {});
    return;
  }
  const auto since = Clock::now();
  connection_->send(orderText(orders, {force_key_, !introduced_}));
  introduced_ = true;
  const Reply reply = parseReply(connection_->receive());
  const bool late = by_clock_ && secondsSince(since) > kMaxPoseTicks * tick_s_;
  for (const auto& slot : slots_) publishReply(*slot, reply, late);
}

void Session::publishReply(Slot& slot, const Reply& reply, bool late) {
  if (!reply.wrong.empty()) return publishTrouble(slot, reply.wrong);
  const auto found = std::find_if(reply.devices.begin(), reply.devices.end(),
                                  [&](const DeviceReply& device) { return device.id == slot.id; });
  slot.configured = slot.listed && found != reply.devices.end();
  slot.listed = found != reply.devices.end();
  if (!slot.listed) return publishTrouble(slot, fmt::format("the service has lost device {}", slot.id));
  if (!found->has_state) return publishTrouble(slot, fmt::format("the service does not report device {}", slot.id));
  DriverReading reading;
  reading.tip = found->place_m ? slot.frame.placeInBody(*found->place_m) : kNoPlace;
  reading.velocity = slot.frame.motionInBody(found->speed_m_s);
  reading.buttons = found->buttons;
  if (late) reading.faults = kStalePose;  // as old as the question, for all that is known
  slot.link.publish(reading);
}

/// Without words: the earlier ones still hold.
void Session::publishTrouble(Slot& slot, const std::string& trouble) noexcept {
  DriverReading reading;
  reading.faults = kDriverError;
  slot.link.publish(reading);
  if (!trouble.empty()) setTrouble(slot, trouble);
}

void Session::setTrouble(Slot& slot, const std::string& trouble) {
  const std::lock_guard lock(words_mutex_);
  slot.trouble = trouble;
}

bool Session::revive(const Slot& slot) {
  const std::lock_guard lock(mutex_);
  {
    const std::lock_guard turn(turns_);
    if (connection_) return slot.link.driverFaults() == 0;
  }
  Probe probe;
  Service service = findService(settings_, "/", probe);
  const std::lock_guard turn(turns_);
  if (!service.connection) {
    for (const auto& each : slots_) setTrouble(*each, probe.reason + "; " + probe.remedy);
    return false;
  }
  adopt(std::move(service));
  return slot.listed;
}

std::string Session::explain(const Slot& slot) {
  const std::uint32_t faults = slot.link.driverFaults();
  if ((faults & kDriverError) != 0) {
    const std::lock_guard lock(words_mutex_);
    return slot.trouble;
  }
  if ((faults & kStalePose) != 0) return "the service answers too late; is this machine overloaded?";
  if ((faults & kNoPose) != 0) return fmt::format("the service reports no position of device {}", slot.id);
  return {};
}

std::shared_ptr<Session> sharedSession(const Settings& settings) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<Session>> sessions;
  const std::lock_guard lock(mutex);
  std::weak_ptr<Session>& known = sessions[settings.words];
  std::shared_ptr<Session> session = known.lock();
  if (!session) known = session = std::make_shared<Session>(settings);
  return session;
}

}  // namespace palpate::device::haply

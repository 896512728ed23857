#include "view/viewer/devices/device_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/base/nearest_name.h"
#include "palpate/device/back_ends.h"
#include "palpate/servo/device_limits.h"

namespace palpate::viewer {

namespace {

constexpr double kTendedEveryS = 1.0;
/// For the list of messages: the banner is over the picture.
constexpr const char* kStopped = toTranslate("Emergency stop: no device gets a force");

BackEndFound describeBackEnd(const device::BackEnd& back_end) {
  const device::Probe probe = back_end.probe({});
  return {.name = std::string(back_end.name),
          .about = std::string(back_end.about),
          .available = probe.available,
          .reason = probe.reason,
          .remedy = probe.remedy,
          .version = probe.version,
          .devices = probe.devices};
}

/// Leaves out back ends that a window does not need: the mouse is there anyway, and F7 plays a script.
bool isForWindows(const device::BackEnd& back_end) { return back_end.name != "mouse" && back_end.name != "script"; }

/// Devices held in a hand are offered before playback.
std::size_t firstToOffer(const std::vector<BackEndFound>& back_ends) {
  for (std::size_t i = 0; i < back_ends.size(); ++i) {
    if (back_ends[i].available && back_ends[i].name != "playback" && back_ends[i].name != "remote") return i;
  }
  return 0;
}

bool usesBackEnd(const std::string& words, std::string_view back_end) {
  return words.substr(0, words.find(':')) == back_end;
}

/// A tick without a position must not remove a control under the mouse during a click.
void updateKnownPlace(FingerHeld& held, double now_s) {
  constexpr double kKnownS = 0.5;
  const Vec3& place = held.reading.place;
  if (!place.allFinite() && now_s - held.known_s < kKnownS) return;
  held.known_place = place;
  held.known_s = now_s;
}

}  // namespace

DeviceControl::~DeviceControl() { give_up_ = true; }

/// The scene may be another person's: access beyond this program needs consent, and a plugin of the file's own is
/// refused.
void DeviceControl::begin() {
  publishHeldDevices();
  std::string names;
  for (const scene::DeviceSettings& device : scene_.devices) {
    const auto finger = static_cast<std::size_t>(device.finger);
    if (servo_.isHeld(finger)) continue;
    try {
      if (device::deviceNamedInFile(device.name).back_end->is_inside) {
        open(finger, device.name);
      } else {
        asked_.push_back({finger, device.name});
        names += (names.empty() ? "" : ", ") + oneLine(device.name);
      }
    } catch (const Error& error) {
      user_.report(Severity::error, error.what());
    }
  }
  if (asked_.empty()) return;
  user_.ask({.kind = Question::Kind::devices,
             .words = trf("The scene wants to open {}: another program, a driver or a file. Open it only if you trust "
                          "the author of the scene.",
                          names),
             .answers = {toTranslate("Keep the mouse"), toTranslate("Open"), toTranslate("Cancel")}});
}

void DeviceControl::openAsked() {
  for (const OpenDevice& asked : std::exchange(asked_, {})) {
    if (!servo_.isHeld(asked.finger)) open(asked.finger, asked.words);
  }
}

void DeviceControl::release() {
  servo_.thread().emergencyStop().release();
  user_.report(Severity::info, "Emergency stop released: forces return once the tip has been off the skin");
}

bool DeviceControl::handle(const window::InputEvent& event, bool text_wanted) {
  using Kind = window::InputEvent::Kind;
  if (event.kind == Kind::focus && !event.down) clutch_key_ = false;
  if (event.kind != Kind::key) return false;
  const bool pause = event.key == window::findBinding(window::Action::emergency_stop).chord.key;
  const bool space = event.key == window::Key::space && servo_.anyHeld() && !text_wanted;
  if (pause || space) {
    if (event.down) stop();
    return true;
  }
  if (window::Chord{event.key, event.modifiers} != window::findBinding(window::Action::clutch).chord) return false;
  if (text_wanted || !servo_.anyHeld()) return false;
  clutch_key_ = event.down;
  return true;
}

void DeviceControl::stop() {
  servo_.thread().emergencyStop().press();
  if (!holders_.devices.stopped) user_.messages.note(kStopped, user_.now_s);
  holders_.devices.stopped = true;
}

void DeviceControl::open(std::size_t finger, const std::string& words) {
  FingerHeld& held = holders_.devices.fingers[finger];
  if (opening_[finger].busy()) return user_.report(Severity::info, trf("{} is still being opened", held.opening));
  device::OpenOptions options;
  options.tick_s = 1.0 / holders_.ticks_per_s;
  options.give_up = &give_up_;
  if (opening_[finger].start([words, options] { return device::openNamed(words, options); })) held.opening = words;
}

void DeviceControl::adoptOpened(std::size_t finger, std::size_t& active_finger, const scene::World& world) {
  auto opened = opening_[finger].collectResult();
  if (!opened) return;
  const std::string words = std::exchange(holders_.devices.fingers[finger].opening, {});
  if (!opened->value)
    return user_.report(Severity::error, trf("The mouse keeps the {} finger: {}",
                                             tr(std::string(kFingerNames[finger]).c_str()), opened->error));
  const std::string about = device::describe(*opened->value);
  OpenedDevice held{words, std::move(*opened->value), workspaceNow(finger, words, world)};
  const auto before = std::exchange(holders_.held, servo_.abilitiesWith(finger, &held));
  try {
    servo::requireStable(device::profileOf(scene_.safety.device, held.device.capabilities), scene_.safety,
                         1.0 / holders_.ticks_per_s);
    servo_.hold(finger, std::move(held), world_swap_.makePlan(scene_, holders_, user_));
  } catch (const Error& error) {
    holders_.held = before;
    return user_.report(Severity::error, error.what());
  }
  looks_[finger] = {.since_s = user_.now_s};
  holders_.devices.fingers[finger].interventions = {};
  holders_.devices.fingers[finger].known_s = -1.0;  // belonged to the earlier device, if any
  publishHeldDevices();
  if (active_finger == finger && !servo_.isHeld(1 - finger)) active_finger = 1 - finger;
  user_.report(Severity::info,
               trf("The {} finger is held by {}", tr(std::string(kFingerNames[finger]).c_str()), about));
}

void DeviceControl::close(std::size_t finger) {
  if (!servo_.isHeld(finger)) return;
  const std::string name = servo_.opened(finger).words;
  holders_.held = servo_.abilitiesWith(finger, nullptr);
  servo_.release(finger, world_swap_.makePlan(scene_, holders_, user_));
  holders_.devices.fingers[finger].trouble.clear();
  if (holders_.devices.calibration.finger == finger) holders_.devices.calibration = {};
  publishHeldDevices();
  user_.report(Severity::info,
               trf("{} is released; the mouse has the {} finger", name, tr(std::string(kFingerNames[finger]).c_str())));
}

/// The search opens a driver for a moment, so a held one is left alone.
void DeviceControl::lookForBackEnds() {
  std::vector<std::string> held;
  for (const FingerHeld& finger : holders_.devices.fingers) {
    held.push_back(finger.words);
    held.push_back(finger.opening);
  }
  const auto look = [held] {
    std::vector<BackEndFound> all;
    for (const device::BackEnd& back_end : device::backEnds()) {
      if (!isForWindows(back_end)) continue;
      const bool ours =
          std::any_of(held.begin(), held.end(), [&](const auto& h) { return usesBackEnd(h, back_end.name); });
      if (ours) {
        all.push_back({.name = std::string(back_end.name),
                       .about = std::string(back_end.about),
                       .available = true,
                       .devices = {tr("in use here")}});
      } else {
        all.push_back(describeBackEnd(back_end));
      }
    }
    return all;
  };
  holders_.devices.looking = looking_.start(look) || holders_.devices.looking;
}

device::Workspace DeviceControl::workspaceNow(std::size_t finger, const std::string& words, const scene::World& world) {
  const scene::DeviceSettings settings = device::settingsOf(scene_, words, finger).value_or(scene::DeviceSettings{});
  std::optional<Vec3>& origin = origins_[finger];
  if (!settings.origin_mm && !origin) origin = device::standardOrigin(world, words, finger);
  return device::workspaceOf(settings, origin.value_or(Vec3::Zero()));
}

/// After changes by panel, undo or another scene.
void DeviceControl::placeDevices(const scene::World& world) {
  for (std::size_t i = 0; i < kFingers; ++i) {
    if (!servo_.isHeld(i)) continue;
    const double scale = servo_.opened(i).workspace.frame.mm;
    const device::Workspace workspace = workspaceNow(i, servo_.opened(i).words, world);
    if (!servo_.place(i, workspace) || workspace.frame.mm == scale) continue;
    holders_.held = servo_.abilities();
    user_.output.changed |= kFingerChange;
  }
}

void DeviceControl::publishHeldDevices() const {
  std::string who;
  for (std::size_t i = 0; i < kFingers; ++i) {
    FingerHeld& finger = holders_.devices.fingers[i];
    finger.words = servo_.isHeld(i) ? servo_.opened(i).words : std::string();
    finger.about = servo_.isHeld(i) ? device::describe(servo_.opened(i).device) : std::string();
    finger.able = servo_.isHeld(i) ? servo_.opened(i).device.capabilities : device::Capabilities{};
    if (!servo_.isHeld(i)) finger.clutch = false;
    if (servo_.isHeld(i)) who += (who.empty() ? "" : ", ") + servo_.opened(i).device.name;
  }
  holders_.held_by = who.empty() ? "mouse" : who;
}

void DeviceControl::reportTrouble(std::size_t finger, std::string trouble) {
  if (!servo_.isHeld(finger)) return;
  const std::string was = std::exchange(holders_.devices.fingers[finger].trouble, std::move(trouble));
  const std::string& is = holders_.devices.fingers[finger].trouble;
  if (is.empty() && !was.empty()) user_.report(Severity::info, trf("{} has reconnected", servo_.opened(finger).words));
  if (!is.empty() && was.empty()) user_.report(Severity::warning, is);
}

/// Once a second, on its own thread: the search for a lost device may keep its driver busy.
void DeviceControl::tend() {
  if (const auto troubles = tending_.collectResult(); troubles && troubles->value) {
    for (std::size_t i = 0; i < kFingers; ++i) reportTrouble(i, (*troubles->value)[i]);
  }
  if (user_.now_s < tended_s_ + kTendedEveryS || !servo_.anyHeld()) return;
  std::array<device::Device, kFingers> devices;
  for (std::size_t i = 0; i < kFingers; ++i) {
    if (servo_.isHeld(i)) devices[i] = servo_.device(i);
  }
  const auto look = [devices] {
    std::array<std::string, kFingers> troubles;
    for (std::size_t i = 0; i < kFingers; ++i) {
      const std::vector<std::string> trouble = device::reviveDevices(std::span(&devices[i], 1));
      if (!trouble.empty()) troubles[i] = trouble.front();
    }
    return troubles;
  };
  if (tending_.start(look)) tended_s_ = user_.now_s;
}

void DeviceControl::noteInterventions(const trace::Sample& sample) {
  if (!servo_.isHeld(sample.finger)) return;
  holders_.devices.fingers[sample.finger].interventions.add(sample.safety, user_.now_s);
  Look& look = looks_[sample.finger];
  look.most_loss_n_mm = std::max(look.most_loss_n_mm, sample.loss_n_mm);
}

void DeviceControl::readState(std::size_t finger) {
  constexpr double kLookS = 1.0;
  FingerHeld& held = holders_.devices.fingers[finger];
  held.workspace = servo_.opened(finger).workspace;
  held.reading = servo_.reading(finger);
  updateKnownPlace(held, user_.now_s);
  Look& look = looks_[finger];
  const double seconds = user_.now_s - look.since_s;
  if (seconds < kLookS) return;
  held.positions_per_s = static_cast<double>(held.reading.fresh - look.fresh) / seconds;
  held.most_loss_n_mm = look.most_loss_n_mm;
  look = {.since_s = user_.now_s, .fresh = held.reading.fresh};
}

void DeviceControl::advance(std::size_t& active_finger, const scene::World& world) {
  DevicesShown& shown = holders_.devices;
  if (auto looked = looking_.collectResult()) {
    shown.looking = false;
    const bool first = shown.back_ends.empty();
    if (looked->value) shown.back_ends = std::move(*looked->value);
    for (FingerHeld& finger : shown.fingers) {
      if (first) finger.back_end = firstToOffer(shown.back_ends);
    }
  }
  for (std::size_t i = 0; i < kFingers; ++i) {
    adoptOpened(i, active_finger, world);
    const bool calibrated = shown.calibration.finger == i;
    servo_.clutch(i, clutch_key_ || shown.fingers[i].clutch || calibrated);
    if (servo_.isHeld(i)) readState(i);
  }
  placeDevices(world);
  tend();
  const bool pressed = servo_.thread().emergencyStop().pressed();
  // By a device's own button, or a signal.
  if (pressed && !shown.stopped) user_.messages.note(kStopped, user_.now_s);
  shown.stopped = pressed;
  if (closing_.busy()) {
    closing_.collectResult();
    return;
  }
  if (auto leaving = servo_.collectReleased(); !leaving.empty()) {
    closing_.start([devices = std::make_shared<std::vector<device::Device>>(std::move(leaving))] {
      devices->clear();
      return 0;
    });
  }
}

}  // namespace palpate::viewer

// place -> frame -> shift of the clutch -> tip; a force the other way, turned only. The clutch is two places: where the
// finger stays, and how far it is from where the device would have it.
#include "palpate/device/workspace.h"

#include <algorithm>
#include <array>
#include <utility>

#include "palpate/base/elementary.h"
#include "palpate/body/rotation.h"
#include "palpate/device/finger_path.h"

namespace palpate::device {

namespace {

std::uint32_t buttonBit(std::size_t button) { return button == 0 ? 0 : std::uint32_t{1} << (button - 1); }

}  // namespace

Mat3 rotationOf(const Vec3& turn_deg) {
  const Vec3 turn = kRadPerDeg * turn_deg;
  return body::rotationAbout(Vec3::UnitZ(), turn.z()) * body::rotationAbout(Vec3::UnitY(), turn.y()) *
         body::rotationAbout(Vec3::UnitX(), turn.x());
}

Vec3 turnOf(const Mat3& r) {
  constexpr double kUpright = 1e-9;
  const double level = elementary::hypot(r(0, 0), r(1, 0));
  Vec3 turn(elementary::atan2(r(2, 1), r(2, 2)), elementary::atan2(-r(2, 0), level),
            elementary::atan2(r(1, 0), r(0, 0)));
  // Turned by 90 degrees about y, x and z turn about one axis: x gets all of it.
  if (level < kUpright) turn = Vec3(elementary::atan2(-r(1, 2), r(1, 1)), turn.y(), 0.0);
  return turn / kRadPerDeg;
}

Workspace workspaceOf(const scene::DeviceSettings& settings, const Vec3& origin_mm) {
  Workspace workspace;
  workspace.frame.axes = rotationOf(settings.turn_deg);
  workspace.frame.mm = settings.scale;
  workspace.frame.origin_mm = settings.origin_mm.value_or(origin_mm);
  workspace.clutch_buttons = buttonBit(settings.clutch_button);
  workspace.stop_buttons = buttonBit(settings.stop_button);
  return workspace;
}

std::optional<scene::DeviceSettings> settingsOf(const scene::Scene& scene, std::string_view words, std::size_t finger) {
  std::optional<scene::DeviceSettings> found;
  for (const scene::DeviceSettings& device : scene.devices) {
    if (device.name != words) continue;
    if (static_cast<std::size_t>(device.finger) == finger) return device;
    if (!found) found = device;
  }
  return found;
}

bool givesPlacesOfTheBody(std::string_view words) {
  static constexpr std::array<std::string_view, 3> kNames = {"mouse", "script", "playback"};
  return std::find(kNames.begin(), kNames.end(), words.substr(0, words.find(':'))) != kNames.end();
}

Vec3 standardOrigin(const scene::World& world, std::string_view words, std::size_t finger) {
  constexpr double kBesideMm = 30.0;
  if (givesPlacesOfTheBody(words)) return Vec3::Zero();
  return automaticPath(world).tip_mm.front() + (finger == 0 ? -kBesideMm : kBesideMm) * Vec3::UnitX();
}

Vec3 clutchedTip(ClutchState& state, const DeviceFrame& frame, const Vec3& place, bool clutch) noexcept {
  const Vec3 tip = frame.placeInBody(place) + state.shift_mm;
  if (!tip.allFinite()) return tip;
  if (!clutch && state.held) state.shift_mm += state.tip - tip;
  const bool stays = (clutch || state.held) && state.tip.allFinite();  // in the tick of the release too
  if (!stays) state.tip = tip;
  state.held = clutch;
  return state.tip;
}

void WorkspaceLink::adoptWorkspace() noexcept {
  const Workspace& requested = workspace_.newest();
  now_.state.elsewhere = !(requested == at_work_);
  if (!now_.state.elsewhere) return;
  at_work_ = requested;
  clutch_state_ = {};
}

Vec3 WorkspaceLink::read(const Vec3& place, const DeviceState& state) noexcept {
  now_.state = state;
  adoptWorkspace();
  const bool clutch = clutch_.load(std::memory_order_relaxed) || (state.buttons & at_work_.clutch_buttons) != 0;
  const bool released = clutch_state_.held && !clutch;
  now_.place = place;
  if (place.allFinite() && state.age_ticks == 0) ++now_.fresh;
  now_.tip = clutchedTip(clutch_state_, at_work_.frame, place, clutch);
  now_.shift_mm = clutch_state_.shift_mm;
  now_.state.velocity = clutch ? Vec3(Vec3::Zero()) : at_work_.frame.motionInBody(state.velocity);
  now_.state.clutched = clutch || released || now_.state.elsewhere;
  now_.state.stops = (state.buttons & at_work_.stop_buttons) != 0;
  reading_.publish(now_);
  return now_.tip;
}

Vec3 WorkspaceLink::forceForDevice(const Vec3& force) noexcept {
  now_.force = now_.state.clutched ? Vec3(Vec3::Zero()) : force;
  return at_work_.frame.forceInDevice(now_.force);
}

std::vector<Vec3> reachOf(const Capabilities& device, const DeviceFrame& frame) {
  std::vector<Vec3> corners;
  if (device.workspace_mm.isEmpty()) return corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(frame.placeInBody(device.workspace_mm.corner(static_cast<Box3::CornerType>(i))));
  }
  return corners;
}

Device inWorkspace(const Device& device, const Workspace& workspace, const std::shared_ptr<WorkspaceLink>& link) {
  Device placed = device;
  placed.capabilities.motion_scale = workspace.frame.mm;
  placed.capabilities.workspace_mm.setEmpty();
  for (const Vec3& corner : reachOf(device.capabilities, workspace.frame)) {
    placed.capabilities.workspace_mm.extend(corner);
  }
  placed.read_tip = [link, read = device.read_tip, state = device.state](std::uint64_t tick) {
    const Vec3 place = read(tick);
    return link->read(place, state ? state() : DeviceState{});
  };
  if (device.write_force) {
    placed.write_force = [link, write = device.write_force](const Vec3& force) { write(link->forceForDevice(force)); };
  }
  placed.state = [link] { return link->state(); };
  return placed;
}

}  // namespace palpate::device

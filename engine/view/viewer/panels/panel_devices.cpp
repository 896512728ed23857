// The holders of the fingers: available devices, the reasons for unavailable ones, opening and releasing; the health of
// a finger's device; its workspace in the body.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "palpate/base/language.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr std::array<const char*, 2> kSides = {"left", "right"};

/// One finger's part of the panel; names of its controls begin with "devices/left/".
struct Part {
  const DevicePanel& panel;
  UiOutput& output;
  std::size_t finger;

  FingerHeld& held() const { return panel.devices.fingers[finger]; }
  CalibrationSteps& calibration() const { return panel.devices.calibration; }
  std::string path(const char* control) const { return fmt::format("devices/{}/{}", kSides[finger], control); }
  bool button(const char* control, const char* label, const char* meaning = "") const {
    return buttonWidget(path(control).c_str(), label, meaning);
  }
  bool number(double& value, const char* control, NumberWidget widget) const {
    const std::string name = path(control);
    widget.path = name.c_str();
    return numberWidget(value, widget);
  }
};

std::string describeFaults(std::uint32_t faults) {
  static constexpr std::array<const char*, 5> kWords = {
      toTranslate("no position"), toTranslate("position too old"), toTranslate("the driver reports a fault"),
      toTranslate("must be calibrated by hand"), toTranslate("closed")};
  std::string words;
  for (std::size_t i = 0; i < kWords.size(); ++i) {
    if ((faults >> i & 1u) != 0) words += fmt::format("{}{}", words.empty() ? "" : ", ", tr(kWords[i]));
  }
  return words;
}

std::string listButtons(std::uint32_t buttons) {
  std::string words;
  for (std::size_t i = 0; i < 32; ++i) {
    if ((buttons >> i & 1u) != 0) words += fmt::format("{}{}", words.empty() ? "" : " ", i + 1);
  }
  return words.empty() ? tr("none") : words;
}

void stopWidgets(const DevicesShown& devices, UiOutput& output) {
  if (!devices.stopped) {
    if (stopButton("devices/stop", "EMERGENCY STOP", true,
                   "No device gets a force until it is released (Space or Pause).")) {
      output.request(StopDevices{});
    }
    return;
  }
  remark("Stopped: no device gets a force.");
  if (buttonWidget("devices/release", "Release the stop", "A finger feels again once its tip has been outside.")) {
    output.request(ReleaseStop{});
  }
}

// ---- a finger of the mouse

void openWidgets(const Part& part) {
  FingerHeld& held = part.held();
  const std::vector<BackEndFound>& back_ends = part.panel.devices.back_ends;
  if (!held.opening.empty()) return remark(trf("opening {} ...", held.opening));
  if (back_ends.empty()) return;
  std::vector<std::string_view> names;
  for (const BackEndFound& back_end : back_ends) names.push_back(back_end.name);
  choiceWidget(part.path("back_end").c_str(), "device", held.back_end, names, "The device for this finger.");
  ImGui::SetNextItemWidth(0.56f * ImGui::GetContentRegionAvail().x);
  ImGui::InputText(fmt::format("{}##{}", tr("which"), part.path("which")).c_str(), &held.which);
  notePlace(part.path("which"), "Which of several devices: a number, an address or a name; empty for the first.");
  const std::string& name = back_ends[std::min(held.back_end, back_ends.size() - 1)].name;
  if (part.button("open", "Open", "Take the finger from the mouse; forces begin once its tip has been off the skin.")) {
    part.output.request(OpenDevice{part.finger, held.which.empty() ? name : name + ":" + held.which});
  }
}

// ---- a finger of a device

void liveWidgets(const Part& part) {
  const FingerHeld& held = part.held();
  const device::DeviceState& state = held.reading.state;
  const double tick_ms = 1000.0 / part.panel.ticks_per_s;
  const Vec3& tip = held.reading.tip;
  valueLine("tip", tip.allFinite() ? fmt::format("{:.0f}, {:.0f}, {:.0f} mm", tip.x(), tip.y(), tip.z()) : tr("none"));
  valueLine("force", fmt::format("{:.2f} N", held.reading.force.norm()));
  valueLine("positions", fmt::format("{:.0f} Hz", held.positions_per_s));
  valueLine("delay", state.loop_ticks == 0 ? std::string(tr("not seen"))
                                           : fmt::format("{:.1f} ms", static_cast<double>(state.loop_ticks) * tick_ms));
  valueLine("age", fmt::format("{:.1f} ms", static_cast<double>(state.age_ticks) * tick_ms));
  valueLine("buttons", listButtons(state.buttons));
  valueLine("loss, last second", fmt::format("{:.3f} mJ", held.most_loss_n_mm));
  const DevicesShown& devices = part.panel.devices;
  const std::string up_to =
      devices.ratios_kept_to_n > 0.0 ? fmt::format(" {}", trf("up to {:.2g} N", devices.ratios_kept_to_n)) : "";
  valueLine("stiffness of all", fmt::format("{:.0f} %{}", 100.0 * devices.stiffness_factor, up_to));
  // Always a line: text that appears must not move a control from under the mouse.
  const std::string faults = describeFaults(state.faults);
  valueLine("faults", faults.empty() ? tr("none") : faults);
}

void interventionWidgets(const Part& part) {
  const auto& counts = part.held().interventions.counts();
  const bool open = ImGui::TreeNode(fmt::format("{}##{}", tr("interventions"), part.path("interventions")).c_str());
  notePlace(part.path("interventions"), "Ticks in which each safety rule changed the force.");
  if (!open) return;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) valueLine(servo::safetyNames()[i], trnf("{} tick", "{} ticks", counts[i], counts[i]));
  }
  ImGui::TreePop();
}

/// The scene's table for this device on this finger, made when it is missing.
void saveDeviceSettings(const Part& part, const scene::DeviceSettings& settings) {
  auto& devices = part.panel.scene.devices;
  const auto same = [&](const scene::DeviceSettings& other) {
    return other.name == settings.name && other.finger == settings.finger;
  };
  const auto known = std::find_if(devices.begin(), devices.end(), same);
  known == devices.end() ? devices.push_back(settings) : void(*known = settings);
  part.output.changed |= kFingerChange;
}

scene::DeviceSettings settingsNow(const Part& part) {
  const FingerHeld& held = part.held();
  auto settings = device::settingsOf(part.panel.scene, held.words, part.finger).value_or(scene::DeviceSettings{});
  settings.name = held.words;
  settings.finger = static_cast<scene::HeldFinger>(part.finger);
  if (!settings.origin_mm) settings.origin_mm = held.workspace.frame.origin_mm;
  return settings;
}

bool buttonChoice(const Part& part, const char* control, const char* label, std::size_t& button) {
  static constexpr std::array<std::string_view, 5> kButtons = {"none", "1", "2", "3", "4"};
  return choiceWidget(part.path(control).c_str(), label, button, kButtons, "The device button that does it.");
}

void workspaceWidgets(const Part& part) {
  const bool open = ImGui::TreeNode(fmt::format("{}##{}", tr("workspace"), part.path("workspace")).c_str());
  notePlace(part.path("workspace"), "Where the device's workspace is in the body, and how it is turned and scaled.");
  if (!open) return;
  scene::DeviceSettings now = settingsNow(part);
  bool changed = part.number(now.scale, "scale",
                             {"", "scale", "%.2f", 0.1, 5.0, 1.0,
                              "Millimetres of the body per millimetre of the device. A larger scale feels stiffer, so "
                              "the limits are lowered with it."});
  static constexpr std::array<const char*, 3> kTurns = {"turn_x", "turn_y", "turn_z"};
  static constexpr std::array<const char*, 3> kTurnLabels = {toTranslate("turn x"), toTranslate("turn y"),
                                                             toTranslate("turn z")};
  static constexpr std::array<const char*, 3> kOrigins = {"origin_x", "origin_y", "origin_z"};
  static constexpr std::array<const char*, 3> kOriginLabels = {toTranslate("origin x"), toTranslate("origin y"),
                                                               toTranslate("origin z")};
  for (std::size_t i = 0; i < 3; ++i) {
    changed |= part.number(
        now.turn_deg[static_cast<int>(i)], kTurns[i],
        {"", kTurnLabels[i], "%.0f deg", -180.0, 180.0, 0.0, "How the device is turned relative to the body."});
  }
  for (std::size_t i = 0; i < 3; ++i) {
    changed |= part.number(
        (*now.origin_mm)[static_cast<int>(i)], kOrigins[i],
        {"", kOriginLabels[i], "%.0f mm", -600.0, 600.0, 0.0, "The place in the body of the device's origin."});
  }
  changed |= buttonChoice(part, "clutch_button", "clutch by", now.clutch_button);
  changed |= buttonChoice(part, "stop_button", "stop by", now.stop_button);
  if (part.held().reading.shift_mm.norm() > 0.5) {
    remark(trf("moved on by {:.0f} mm with the clutch", part.held().reading.shift_mm.norm()));
    if (part.button("keep_shift", "Keep it", "Make the clutched position the new origin.")) {
      *now.origin_mm += part.held().reading.shift_mm;
      changed = true;
    }
  }
  if (changed) saveDeviceSettings(part, now);
  ImGui::TreePop();
}

// ---- three places

void useCalibration(const Part& part, const device::Calibration& found) {
  scene::DeviceSettings now = settingsNow(part);
  now.scale = found.frame.mm;
  now.turn_deg = device::turnOf(found.frame.axes);
  now.origin_mm = found.frame.origin_mm;
  saveDeviceSettings(part, now);
  part.calibration() = {};
}

void calibrationPlaceWidgets(const Part& part) {
  CalibrationSteps& steps = part.calibration();
  remark(
      trf("Place {} of {}: click it on the body, hold the tip there, take it. The finger stays where it is, "
          "without force.",
          steps.of_device.size() + 1, device::kCalibrationPlaces));
  const auto& clicked = part.panel.reading;
  const Vec3& place = part.held().known_place;
  if (!clicked) return remark("No place on the body has been clicked yet.");
  valueLine("place",
            fmt::format("{:.0f}, {:.0f}, {:.0f} mm", clicked->place.x(), clicked->place.y(), clicked->place.z()));
  ImGui::BeginDisabled(!place.allFinite());
  if (part.button("take", "Take this place", "Needs a position from the device.")) steps.addPair(place, clicked->place);
  ImGui::EndDisabled();
}

void calibrationWidgets(const Part& part) {
  CalibrationSteps& steps = part.calibration();
  if (steps.finger != part.finger) {
    if (part.button("calibrate", "Calibrate by three places", "Set turn, scale and origin by touching three places.")) {
      steps = {};
      steps.finger = part.finger;
    }
    return;
  }
  if (!steps.trouble.empty()) remark(steps.trouble);
  if (steps.found) {
    remark(trf("Calibration residual {:.1f} mm; scale {:.2f}.", steps.found->residual_mm, steps.found->frame.mm));
    if (part.button("use", "Use it")) return useCalibration(part, *steps.found);
    ImGui::SameLine();
  } else {
    calibrationPlaceWidgets(part);
  }
  if (part.button("stop_calibrating", "Discard it")) steps = {};
}

void heldWidgets(const Part& part) {
  FingerHeld& held = part.held();
  remark(held.about);
  if (part.button("close", "Release it", "Give the finger back to the mouse.")) {
    part.output.request(CloseDevice{part.finger});
  }
  ImGui::SameLine();
  const std::string clutch = part.path("clutch");
  flagWidget(clutch.c_str(), "clutch", held.clutch,
             "Move the device while the finger stays, without force (key U, or the device's own button).");
  liveWidgets(part);
  interventionWidgets(part);
  workspaceWidgets(part);
  calibrationWidgets(part);
  if (!held.trouble.empty()) remark(held.trouble);
}

void backEndWidgets(const BackEndFound& back_end) {
  valueLine(back_end.name.c_str(), tr(back_end.available ? "here" : "not here"));
  if (!back_end.available) {
    remark(back_end.reason);
    if (!back_end.remedy.empty()) remark(trf("Remedy: {}", back_end.remedy));
  } else if (!back_end.devices.empty()) {
    remark(fmt::format("{}", fmt::join(back_end.devices, ", ")));
  }
}

}  // namespace

void devicePanel(const DevicePanel& panel, UiOutput& output) {
  const DevicesShown& devices = panel.devices;
  stopWidgets(devices, output);
  for (std::size_t i = 0; i < devices.fingers.size(); ++i) {
    const Part part{panel, output, i};
    ImGui::Separator();
    valueLine(i == 0 ? "left finger" : "right finger",
              devices.fingers[i].words.empty() ? tr("mouse") : devices.fingers[i].words);
    devices.fingers[i].words.empty() ? openWidgets(part) : heldWidgets(part);
  }
  ImGui::Separator();
  flagWidget("devices/reach", "show their reach", panel.reach, "The box that each device in use can reach (key J).");
  if (devices.looking) {
    remark("looking for devices ...");
  } else if (devices.back_ends.empty() || buttonWidget("devices/look", "Look again")) {
    output.request(FindDevices{});
  }
  for (const BackEndFound& back_end : devices.back_ends) backEndWidgets(back_end);
}

}  // namespace palpate::viewer

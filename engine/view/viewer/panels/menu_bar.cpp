// The menus: the same table of keys once more, for users who look before they type.
#include <fmt/format.h>
#include <imgui.h>

#include <span>

#include "palpate/base/language.h"
#include "palpate/scene/presets.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

using window::Action;

/// State of all menus, and their requests.
struct Menus {
  const MenuBar& bar;
  ViewState& state;
  UiOutput& output;
};

void item(const Menus& menus, Action action) {
  const window::KeyBinding& binding = window::findBinding(action);
  const bool on = menus.bar.on[static_cast<std::size_t>(action)];
  if (ImGui::MenuItem(tr(std::string(binding.name).c_str()), window::keysOf(binding).c_str(), on))
    menus.output.act(action);
  notePlace(fmt::format("menu/{}", binding.name), binding.does);
}

bool plainItem(const char* path, const char* label, bool on = false) {
  const bool chosen = ImGui::MenuItem(tr(label), nullptr, on);
  notePlace(path);
  return chosen;
}

void switchItem(const char* path, const char* label, bool& on) {
  if (plainItem(path, label, on)) on = !on;
}

/// Call ImGui::EndMenu if it returns true.
bool beginMenu(const char* path, const char* label, bool offered = true) {
  const bool open = ImGui::BeginMenu(tr(label), offered);
  open ? notePlaceOnly(path) : notePlace(path);  // the last item of an open one is not its name
  return open;
}

void recentFiles(const Menus& menus) {
  if (!beginMenu("menu/Recent", "Recent", !menus.state.recent.empty())) return;
  for (const std::string& file : menus.state.recent) {
    if (plainItem("menu/recent file", file.c_str())) menus.output.request(OpenFile{file});
  }
  ImGui::EndMenu();
}

void pictureItems(const Menus& menus) {
  if (plainItem("menu/Save picture", "Save picture ...")) menus.state.shown.picture_dialog = true;
  for (const Action action : {Action::screenshot, Action::screenshot_with_pop_ups, Action::clear_screenshot}) {
    item(menus, action);
  }
  if (menus.bar.filming) {
    if (plainItem("menu/Stop the film", "Stop the film")) menus.output.request(StopFilm{});
  } else if (plainItem("menu/Save film", "Save film ...")) {
    menus.state.shown.film_dialog = true;
  }
}

void fileMenu(const Menus& menus) {
  if (plainItem("menu/Start page", "Start page ...")) menus.state.shown.start = true;
  item(menus, Action::open);
  recentFiles(menus);
  if (beginMenu("menu/Examples", "Examples")) {
    for (const scene::Preset& preset : scene::presets()) {
      const bool chosen = ImGui::MenuItem(tr(std::string(preset.title).c_str()));
      notePlace(fmt::format("menu/{}", preset.name), preset.what);
      if (chosen) menus.output.request(OpenPreset{std::string(preset.name)});
    }
    ImGui::EndMenu();
  }
  for (const Action action : menus.bar.modes) item(menus, action);
  if (plainItem("menu/Class", "Class ...")) menus.state.shown.class_dialog = true;
  for (const Action action : {Action::reload, Action::save, Action::save_as}) item(menus, action);
  ImGui::Separator();
  for (const Action action : {Action::undo, Action::redo, Action::reset, Action::copy_scene}) item(menus, action);
  ImGui::Separator();
  pictureItems(menus);
  item(menus, Action::record);
  ImGui::Separator();
  item(menus, Action::quit);
}

void themeMenu(window::Theme& theme) {
  if (!beginMenu("menu/Theme", "Theme")) return;
  for (std::size_t i = 0; i < window::kThemeNames.size(); ++i) {
    const auto offered = static_cast<window::Theme>(i);
    if (plainItem("menu/Theme", std::string(window::kThemeNames[i]).c_str(), theme == offered)) theme = offered;
  }
  ImGui::EndMenu();
}

void textSizeMenu(double& text_size) {
  if (!beginMenu("menu/Text size", "Text size")) return;
  for (const double size : {0.75, 1.0, 1.25, 1.5, 2.0, 2.5}) {
    if (plainItem("menu/Text size", fmt::format("{:.0f} %", 100.0 * size).c_str(), text_size == size)) text_size = size;
  }
  ImGui::EndMenu();
}

/// Fonts and labels are made at the start.
void languageMenu(const Menus& menus) {
  if (!beginMenu("menu/Language", "Language")) return;
  std::string& chosen = menus.state.language;
  const std::string before = chosen;
  if (plainItem("menu/Language", "system language", chosen.empty())) chosen.clear();
  for (const Language& offered : languages()) {
    if (plainItem("menu/Language", std::string(offered.own_name).c_str(), chosen == offered.code))
      chosen = offered.code;
  }
  if (chosen != before) menus.output.report(Severity::info, "The language changes at the next start");
  ImGui::EndMenu();
}

void mouseMenu(window::InputSettings& input) {
  if (!beginMenu("menu/Mouse", "Mouse")) return;
  for (std::size_t i = 0; i < window::kMousePresetNames.size(); ++i) {
    const auto preset = static_cast<window::MousePreset>(i);
    if (plainItem("menu/Mouse", std::string(window::kMousePresetNames[i]).c_str(), input.preset == preset)) {
      input.preset = preset;
    }
  }
  ImGui::Separator();
  switchItem("menu/Swap left and right", "Swap left and right", input.swap_left_and_right);
  switchItem("menu/Invert the wheel", "Invert the wheel's zoom", input.invert_zoom);
  double& speed = input.speed;
  ImGui::SetNextItemWidth(110.0f);
  numberWidget(speed, {"mouse/speed", "speed of turning", "%.2f", 0.25, 4.0, 1.0, "How fast the camera turns."});
  ImGui::EndMenu();
}

void viewMenu(const Menus& menus) {
  for (const Action action : {Action::home, Action::full_screen, Action::panel, Action::plots, Action::numbers,
                              Action::performance, Action::measure, Action::find_place, Action::reach}) {
    item(menus, action);
  }
  ImGui::Separator();
  for (const Action action : {Action::freeze, Action::play_script, Action::slower, Action::faster}) {
    item(menus, action);
  }
  ImGui::Separator();
  switchItem("menu/Panel on the right", "Panel on the right", menus.state.shown.panel_right);
  ImGui::Separator();
  if (plainItem("menu/Copy the view", "Copy the view")) menus.output.request(CopyView{});
  if (plainItem("menu/Paste the view", "Paste the view")) menus.output.request(PasteView{});
  ImGui::Separator();
  themeMenu(menus.state.theme);
  textSizeMenu(menus.state.text_size);
  languageMenu(menus);
  mouseMenu(menus.state.input);
  switchItem("menu/Reduced motion", "Reduced motion", menus.state.reduced_motion);
  if (plainItem("menu/Reset the layout", "Reset the layout")) {
    menus.state.shown = {};
    menus.state.text_size = 1.0;
  }
}

void showMenu(const Menus& menus) {
  for (const Action action : {Action::show_names, Action::show_muscles, Action::skin_opacity, Action::colour_strain,
                              Action::colour_stiffness, Action::colour_ellipses}) {
    item(menus, action);
  }
  ImGui::Separator();
  for (const view::Overlay overlay : view::kTouchOverlays) item(menus, window::actionFor(overlay));
  ImGui::Separator();
  for (const view::Overlay overlay : view::kLumpOverlays) item(menus, window::actionFor(overlay));
  ImGui::Separator();
  if (beginMenu("menu/Engine", "Engine")) {
    for (const view::Overlay overlay : view::kEngineOverlays) item(menus, window::actionFor(overlay));
    ImGui::EndMenu();
  }
  ImGui::Separator();
  item(menus, Action::stereo_mode);
  item(menus, Action::swap_eyes);
}

void helpMenu(const Menus& menus) {
  item(menus, Action::help);
  if (plainItem("menu/Manual", "Manual ...")) menus.state.shown.manual = true;
  if (plainItem("menu/Hints", "Show the hints again")) {
    menus.state.hints = true;
    menus.bar.hint = 0;
  }
  const std::size_t unread = menus.bar.unread_messages;
  const std::string messages = unread == 0 ? std::string(tr("Messages")) : trf("Messages ({} new)", unread);
  if (plainItem("menu/Messages", messages.c_str())) menus.state.shown.messages = true;
}

template <class Draw>
void menu(const Menus& menus, const char* name, const Draw& draw) {
  const bool open = beginMenu(fmt::format("menu/{}", name).c_str(), name);
  if (!open) return;
  draw(menus);
  ImGui::EndMenu();
}

void recordingSign(const std::string& words) {
  if (words.empty()) return;
  constexpr ImU32 kRed = IM_COL32(226, 44, 38, 255);
  const float radius = 0.36f * ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddCircleFilled({at.x + radius, at.y + 0.5f * ImGui::GetFrameHeight()}, radius, kRed);
  ImGui::Dummy({2.0f * radius, ImGui::GetFontSize()});
  ImGui::TextUnformatted(words.c_str());
  notePlace("menu/recording");
}

void stopSign(const Menus& menus) {
  if (!menus.bar.offers_stop) return;
  if (menus.bar.stopped) {
    ImGui::TextColored({1.0f, 0.35f, 0.3f, 1.0f}, "%s", tr("STOPPED"));
    return notePlace("menu/stopped");
  }
  if (stopButton("menu/stop", "STOP", false, "Emergency stop: no device gets a force (Space or Pause).")) {
    menus.output.request(StopDevices{});
  }
}

/// At the right end: the body, its device and the rate; as much of it as there is room for.
void statusLine(std::span<const std::string> parts) {
  for (; !parts.empty(); parts = parts.subspan(1)) {
    const std::string words = fmt::format("{}", fmt::join(parts, "   "));
    const float left = ImGui::GetWindowWidth() - ImGui::CalcTextSize(words.c_str()).x - 16.0f;
    if (left <= ImGui::GetCursorPosX()) continue;
    ImGui::SameLine(left);
    ImGui::TextUnformatted(words.c_str());
    return notePlace("menu/status");
  }
}

}  // namespace

void menuBar(const MenuBar& bar, UiOutput& output) {
  if (!ImGui::BeginMainMenuBar()) return;
  const Menus menus{bar, bar.state, output};
  menu(menus, "File", fileMenu);
  menu(menus, "View", viewMenu);
  menu(menus, "Show", showMenu);
  menu(menus, "Help", helpMenu);
  if (bar.room_for_place > 0.0f) ImGui::Dummy({bar.room_for_place, 0.0f});
  stopSign(menus);
  recordingSign(bar.recording);
  statusLine(bar.status);
  ImGui::EndMainMenuBar();
}

}  // namespace palpate::viewer

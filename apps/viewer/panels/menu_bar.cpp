// The menus: the same table of keys once more, for those who look before they type.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "apps/viewer/editing/acts.h"
#include "apps/viewer/editing/dysfunction_editor.h"
#include "apps/viewer/panels/panels.h"
#include "apps/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

using window::Action;

void item(Session& session, Action action) {
  const window::KeyBinding& binding = window::bindingOf(action);
  if (ImGui::MenuItem(std::string(binding.name).c_str(), window::keysOf(binding).c_str(), isOn(action, session))) {
    perform(action, session);
  }
  notePlace(fmt::format("menu/{}", binding.name));
}

void recentFiles(Session& session) {
  if (!ImGui::BeginMenu("Recent", !session.state.recent.empty())) return;
  for (const std::string& file : session.state.recent) {
    if (ImGui::MenuItem(file.c_str())) session.wish(Wish::Kind::open, file);
  }
  ImGui::EndMenu();
}

void fileMenu(Session& session) {
  item(session, Action::open);
  recentFiles(session);
  if (ImGui::MenuItem("Built-in torso")) session.wish(Wish::Kind::default_scene);
  item(session, Action::save);
  ImGui::Separator();
  item(session, Action::undo);
  item(session, Action::redo);
  ImGui::Separator();
  item(session, Action::screenshot);
  item(session, Action::record);
  ImGui::Separator();
  item(session, Action::quit);
}

void themeMenu(Session& session) {
  if (!ImGui::BeginMenu("Theme")) return;
  for (std::size_t i = 0; i < window::kThemeNames.size(); ++i) {
    const auto theme = static_cast<window::Theme>(i);
    if (ImGui::MenuItem(std::string(window::kThemeNames[i]).c_str(), nullptr, session.state.theme == theme)) {
      session.state.theme = theme;
    }
  }
  ImGui::EndMenu();
}

void textSizeMenu(Session& session) {
  if (!ImGui::BeginMenu("Text size")) return;
  for (const double size : {0.75, 1.0, 1.25, 1.5, 2.0, 2.5}) {
    if (ImGui::MenuItem(fmt::format("{:.0f} %", 100.0 * size).c_str(), nullptr, session.state.text_size == size)) {
      session.state.text_size = size;
    }
  }
  ImGui::EndMenu();
}

void mouseMenu(Session& session) {
  if (!ImGui::BeginMenu("Mouse")) return;
  window::InputSettings& input = session.state.input;
  for (std::size_t i = 0; i < window::kMousePresetNames.size(); ++i) {
    const auto preset = static_cast<window::MousePreset>(i);
    if (ImGui::MenuItem(std::string(window::kMousePresetNames[i]).c_str(), nullptr, input.preset == preset)) {
      input.preset = preset;
    }
  }
  ImGui::Separator();
  ImGui::MenuItem("Swap left and right", nullptr, &input.swap_left_and_right);
  ImGui::MenuItem("Invert the wheel's zoom", nullptr, &input.invert_zoom);
  double& speed = input.speed;
  ImGui::SetNextItemWidth(110.0f);
  numberWidget(speed, {"mouse/speed", "speed of turning", "%.2f", 0.25, 4.0, 1.0, "Of the camera."});
  ImGui::EndMenu();
}

void viewMenu(Session& session) {
  for (const Action action : {Action::home, Action::full_screen, Action::panel, Action::plots, Action::numbers,
                              Action::performance, Action::freeze}) {
    item(session, action);
  }
  ImGui::MenuItem("Panel on the right", nullptr, &session.state.shown.panel_right);
  ImGui::Separator();
  if (ImGui::MenuItem("Copy the view")) session.wish(Wish::Kind::copy_view);
  if (ImGui::MenuItem("Paste the view")) session.wish(Wish::Kind::paste_view);
  ImGui::Separator();
  themeMenu(session);
  textSizeMenu(session);
  mouseMenu(session);
  ImGui::MenuItem("Reduced motion", nullptr, &session.state.reduced_motion);
  if (ImGui::MenuItem("Reset the layout")) {
    session.state.shown = {};
    session.state.text_size = 1.0;
  }
}

void showMenu(Session& session) {
  for (std::size_t i = 0; i < view::kOverlays; ++i) item(session, window::actionFor(static_cast<view::Overlay>(i)));
  item(session, Action::skin_opacity);
  ImGui::Separator();
  for (const Action action : {Action::colour_strain, Action::colour_stiffness, Action::colour_ellipses}) {
    item(session, action);
  }
  ImGui::Separator();
  item(session, Action::stereo_mode);
  item(session, Action::swap_eyes);
}

void helpMenu(Session& session) {
  item(session, Action::help);
  if (ImGui::MenuItem("Show the hints again")) {
    session.state.hints = true;
    session.hint = 0;
  }
  const std::string messages = session.messages.unread() == 0
                                   ? std::string("Messages")
                                   : fmt::format("Messages ({} new)", session.messages.unread());
  if (ImGui::MenuItem(messages.c_str())) session.state.shown.messages = true;
}

template <class Draw>
void menu(Session& session, const char* name, const Draw& draw) {
  const bool open = ImGui::BeginMenu(name);
  notePlace(fmt::format("menu/{}", name));
  if (!open) return;
  draw(session);
  ImGui::EndMenu();
}

/// At the right end: what is touched, by what, how fast.
void statusLine(const Session& session) {
  const std::string words = fmt::format("{}     mouse   {:.0f} Hz   {:.0f} fps", session.world.name,
                                        session.performance.servo.ticks_per_s, session.performance.frames_per_s);
  const float left = ImGui::GetWindowWidth() - ImGui::CalcTextSize(words.c_str()).x - 16.0f;
  if (left > ImGui::GetCursorPosX()) ImGui::SameLine(left);
  ImGui::TextUnformatted(words.c_str());
}

}  // namespace

void menuBar(Session& session) {
  if (!ImGui::BeginMainMenuBar()) return;
  menu(session, "File", fileMenu);
  menu(session, "View", viewMenu);
  menu(session, "Show", showMenu);
  menu(session, "Help", helpMenu);
  statusLine(session);
  ImGui::EndMainMenuBar();
}

}  // namespace palpate::viewer

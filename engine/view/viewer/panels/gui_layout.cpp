#include "view/viewer/panels/gui_layout.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "palpate/base/language.h"
#include "view/viewer/editing/acts.h"
#include "view/viewer/editing/dysfunction_editor.h"
#include "view/viewer/editing/lump_editor.h"
#include "view/viewer/modes/mode.h"
#include "view/viewer/panels/hints.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr const char* kPerformance = toTranslate("Performance");

constexpr PanelEntry kPanels[] = {
    {toTranslate("Touch"), Panel::touch, true}, {toTranslate("Devices"), Panel::devices},
    {toTranslate("Tissue"), Panel::tissue},     {toTranslate("Dysfunctions"), Panel::dysfunctions},
    {toTranslate("Lumps"), Panel::lumps},       {toTranslate("Model"), Panel::model},
    {toTranslate("Show"), Panel::show},         {toTranslate("Vertex"), Panel::vertex},
    {toTranslate("Stereo"), Panel::stereo},     {toTranslate("Record"), Panel::record},
    {kPerformance, Panel::performance},
};

/// Only one of the two editors is active: starting one ends the other.
void drawEditorPanel(Panel panel, EditedScene& edited, UiOutput& output) {
  const std::string undo = edited.history.steps().undoLabel();
  const std::string redo = edited.history.steps().redoLabel();
  const bool of_lumps = panel == Panel::lumps;
  if (of_lumps) {
    lumpPanel({edited.lumps(output), undo, redo});
  } else {
    dysfunctionPanel({edited.dysfunctions(output), undo, redo});
  }
  if (!edited.editor.active || !edited.lump_editor.active) return;
  of_lumps ? stopEditing(edited.dysfunctions(output)) : stopEditing(edited.lumps(output));
}

/// Gives each section its parts.
void drawPanel(Panel panel, ViewerState& s) {
  switch (panel) {
    case Panel::touch:
      return touchPanel({s.state.touch, s.active_finger, s.scene}, s.output);
    case Panel::devices:
      return devicePanel({s.devices, s.scene, s.reading, s.state.shown.reach, s.ticks_per_s}, s.output);
    case Panel::tissue:
      return tissuePanel({s.scene, s.profile, s.world.has_bones}, s.output);
    case Panel::dysfunctions:
    case Panel::lumps:
      return drawEditorPanel(panel, s, s.output);
    case Panel::model:
      return modelPanel({s.scene, s.world, s.state.shown.open_dialog}, s.output);
    case Panel::show:
      return showPanel({s.state.look, s.state.adapts_resolution, s.state.simpler_when_slow, s.simple_shading, s.world});
    case Panel::vertex:
      return vertexPanel({s.reading, s.mark_vertex, s.vertex_panel_open});
    case Panel::stereo:
      return stereoPanel({s.state.stereo, s.state.head, s.head, s.camera, s.world});
    case Panel::record:
      return recordPanel(s.recording, s.state.keeps_last_hour, s.now_s, s.output);
    case Panel::performance:
      return performancePanel(s.performance);
  }
}

MenuBar makeMenuBar(ViewerState& viewer, const Modes& modes) {
  MenuBar menu{.state = viewer.state,
               .hint = viewer.hint,
               .on = {},
               .unread_messages = viewer.messages.unread(),
               .status = {},
               .recording = recordingStatus(viewer.recording, viewer.now_s)};
  menu.filming = viewer.recording.film;
  if (!viewer.world.landmarks.empty()) menu.room_for_place = kPlaceFieldWidth;
  menu.offers_stop = viewer.devices.anyHeld() || viewer.devices.stopped;
  menu.stopped = viewer.devices.stopped;
  for (std::size_t i = 0; i < window::kActions; ++i) menu.on[i] = isOn(static_cast<window::Action>(i), viewer);
  for (const auto& mode : modes) {
    const auto item = mode->menuItem();
    if (!item) continue;
    menu.modes.push_back(item->action);
    menu.on[static_cast<std::size_t>(item->action)] = item->on;
  }
  menu.status.push_back(viewer.world.name + (viewer.history.changed() ? " *" : ""));
  if (viewer.simple_shading) menu.status.emplace_back(tr("smooth shading: slow"));
  menu.status.emplace_back(tr(viewer.held_by.c_str()));
  menu.status.push_back(fmt::format("{:.0f} Hz", viewer.performance.servo.ticks_per_s));
  menu.status.push_back(fmt::format("{:.0f} fps", viewer.performance.frames_per_s));
  return menu;
}

std::vector<std::string> interventionLines(const DevicesShown& devices, double now_s) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < devices.fingers.size(); ++i) {
    const FingerHeld& finger = devices.fingers[i];
    if (finger.words.empty()) continue;
    const std::string words = finger.interventions.recent(now_s);
    if (!words.empty()) lines.push_back(fmt::format("{}: {}", tr(i == 0 ? "left" : "right"), words));
  }
  return lines;
}

/// Performs the requested actions like keys, and shows the messages.
void doActions(ViewerState& viewer, const Modes& modes) {
  for (const window::Action action : std::exchange(viewer.output.actions, {})) {
    if (modes.handle({.kind = window::Command::Kind::act, .action = action}, viewer)) continue;
    perform(action, viewer);
  }
  for (const UiOutput::Words& words : std::exchange(viewer.output.words, {})) viewer.report(words.severity, words.text);
}

}  // namespace

std::span<const PanelEntry> panelList() { return kPanels; }

bool staysInPictures(std::string_view window) {
  return window == "##MainMenuBar" || window.starts_with("mode") || window.starts_with("panel") ||
         window.starts_with("plots") || window == "ruler" || window == "stop" || window == "unsafe";
}

void sidePanel(ViewerState& viewer, float width, const FreeArea& free) {
  const float left = viewer.state.shown.panel_right ? width - kSidePanelWidth : 0.0f;
  ImGui::SetNextWindowPos({left, free.top});
  ImGui::SetNextWindowSize({kSidePanelWidth, ImGui::GetIO().DisplaySize.y - free.top});
  constexpr auto kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
  viewer.vertex_panel_open = false;
  if (ImGui::Begin("panel", nullptr, kFixed)) {
    viewRow(viewer.state.look, viewer.world, viewer.output);
    for (const PanelEntry& panel : kPanels) {
      // F3 opens this section from the keyboard.
      const bool asked = viewer.state.shown.performance && panel.name == kPerformance;
      if (asked) ImGui::SetNextItemOpen(true);
      const auto flags = panel.open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None;
      const bool open = ImGui::CollapsingHeader(tr(panel.name), flags);
      notePlace(std::string("panel/") + panel.name);
      if (!open) continue;
      ImGui::PushID(panel.name);
      drawPanel(panel.panel, viewer);
      ImGui::PopID();
      ImGui::Spacing();
    }
  }
  ImGui::End();
}

namespace {

/// Side panel, plots, and everything over the body.
void drawAroundTheBody(ViewerState& viewer, float width, const FreeArea& free) {
  const Shown& shown = viewer.state.shown;
  if (shown.panel) sidePanel(viewer, width, free);
  const Replay& replay = viewer.replay;
  const std::optional<double> past_s = replay.frozen ? std::optional(replay.at_s) : std::nullopt;
  const PlotStrips strips{viewer.plots, viewer.finger_present, viewer.device_limit_n, viewer.now_s, past_s};
  if (shown.plots) plotStrips(strips, free, viewer.output);
  if (viewer.editing()) editingFrame(free);
  if (viewer.ruler.active) rulerNotice(viewer.ruler, free);
  interventionNotice(interventionLines(viewer.devices, viewer.now_s), free);
  if (viewer.replay.frozen) {
    replayBar(viewer.replay, free, viewer.output);
  } else if (viewer.state.hints && !viewer.editing() && !viewer.ruler.active) {
    hint(hintText(viewer.hint), free);
  }
}

/// The emergency stop and messages are visible in every mode.
void drawModeWindow(Mode& mode, bool stopped, Conversation& user, const FreeArea& free) {
  mode.draw(free);
  if (stopped) stopBanner(free, user.output);
  toast(user.messages, user.now_s, free);
}

/// A question has precedence.
void drawStartPage(ViewState& state, Conversation& user, ExamplePictures& pictures) {
  if (user.question) return;
  startPage({.recent = state.recent,
             .shown_at_start = state.start_page,
             .pictures = pictures,
             .activities = user.activities,
             .awaited = user.awaited},
            state.shown.start, user.output);
}

}  // namespace

void drawGui(ViewerState& viewer, const Modes& modes, const GuiPictures& pictures) {
  widgetPlaces().clear();
  Shown& shown = viewer.state.shown;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const FreeArea free = freeArea(shown, size.x, size.y);
  if (Mode* mode = modes.claimant(&Claims::window)) return drawModeWindow(*mode, viewer.devices.stopped, viewer, free);
  if (!shown.open_dialog) viewer.replay.chooses_beside = false;
  menuBar(makeMenuBar(viewer, modes), viewer.output);
  placeField({viewer.place_search, viewer.world.landmarks, viewer.place_words}, viewer.output);
  doActions(viewer, modes);
  if (Mode* mode = modes.claimant(&Claims::body)) {
    mode->draw({0.0f, kMenuBarHeight, size.x, size.y});
  } else {
    drawAroundTheBody(viewer, size.x, free);
  }
  if (viewer.devices.unsafe) unsafeBanner(viewer.devices.safety_notes, free);
  if (viewer.devices.stopped) stopBanner(free, viewer.output);
  buildProgress(viewer.building, free, viewer.output);
  doActions(viewer, modes);
  toast(viewer.messages, viewer.now_s, free);
  if (shown.help) helpPage(shown.help);
  if (shown.messages) messageList(viewer.messages, shown.messages);
  openDialog(viewer.state.recent, shown.open_dialog, pictures.preview, viewer.output);
  saveDialog(viewer.document.file, viewer.output_folder, shown.save_dialog, viewer.output);
  pictureDialog(viewer.output_folder, shown.picture_dialog, viewer.output);
  filmDialog(viewer.output_folder, shown.film_dialog, viewer.output);
  classDialog(viewer.class_shown, viewer.output_folder, shown.class_dialog, viewer.output);
  manualDialog(viewer.manual, shown.manual);
  drawStartPage(viewer.state, viewer, pictures.examples);
  questionDialog(viewer.question, viewer.output);
}

}  // namespace palpate::viewer

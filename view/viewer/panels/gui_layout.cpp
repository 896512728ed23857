#include "view/viewer/panels/gui_layout.h"

#include <fmt/format.h>
#include <imgui.h>

#include <utility>

#include "view/viewer/editing/acts.h"
#include "view/viewer/modes/mode.h"
#include "view/viewer/panels/hints.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr const char* kPerformance = "Performance";

/// Each section with the parts of the session that it is about.
constexpr PanelEntry kPanels[] = {
    {"Touch",
     [](Session& s) {
       touchPanel({s.state.touch, s.active_finger, s.scene}, s.asks);
     },
     true},
    {"Devices",
     [](Session& s) {
       devicePanel({s.devices, s.scene, s.reading, s.state.shown.reach, s.ticks_per_s}, s.asks);
     }},
    {"Tissue",
     [](Session& s) {
       tissuePanel({s.scene, s.profile, s.world.has_bones}, s.asks);
     }},
    {"Dysfunctions",
     [](Session& s) {
       dysfunctionPanel({s.dysfunctions(), s.history.steps().undoWords(), s.history.steps().redoWords()});
     }},
    {"Model",
     [](Session& s) {
       modelPanel({s.scene, s.world, s.state.shown.open_dialog}, s.asks);
     }},
    {"Show",
     [](Session& s) {
       showPanel({s.state.look, s.state.simpler_when_slow, s.simple_shading, s.world});
     }},
    {"Vertex",
     [](Session& s) {
       vertexPanel({s.reading, s.mark_vertex, s.vertex_panel_open});
     }},
    {"Stereo",
     [](Session& s) {
       stereoPanel({s.state.stereo, s.state.head, s.head, s.camera, s.world});
     }},
    {"Record", [](Session& s) { recordPanel(s.recording, s.state.keeps_last_hour, s.now_s, s.asks); }},
    {kPerformance, [](Session& s) { performancePanel(s.performance); }},
};

MenuBar menuOf(Session& session, const Modes& modes) {
  MenuBar menu{.state = session.state,
               .hint = session.hint,
               .on = {},
               .unread_messages = session.messages.unread(),
               .status = {},
               .recording = recordingWords(session.recording, session.now_s)};
  menu.offers_stop = session.devices.anyHeld() || session.devices.stopped;
  menu.stopped = session.devices.stopped;
  for (std::size_t i = 0; i < window::kActions; ++i) menu.on[i] = isOn(static_cast<window::Action>(i), session);
  for (const auto& mode : modes) {
    const auto item = mode->menuItem();
    if (!item) continue;
    menu.modes.push_back(item->action);
    menu.on[static_cast<std::size_t>(item->action)] = item->on;
  }
  menu.status.push_back(session.world.name + (session.history.changed() ? " *" : ""));
  if (session.simple_shading) menu.status.emplace_back("drawn smooth: slow");
  menu.status.push_back(session.held_by);
  menu.status.push_back(fmt::format("{:.0f} Hz", session.performance.servo.ticks_per_s));
  menu.status.push_back(fmt::format("{:.0f} fps", session.performance.frames_per_s));
  return menu;
}

PlotStrips plotsOf(Session& session) {
  const Replay& replay = session.replay;
  return {session.plots, session.finger_present, session.device_limit_n, session.now_s,
          replay.frozen ? std::optional(replay.at_s) : std::nullopt};
}

std::vector<std::string> interventionLines(const Session& session) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < session.devices.fingers.size(); ++i) {
    const FingerHeld& finger = session.devices.fingers[i];
    if (finger.words.empty()) continue;
    const std::string words = finger.interventions.recent(session.now_s);
    if (!words.empty()) lines.push_back(fmt::format("{}: {}", i == 0 ? "left" : "right", words));
  }
  return lines;
}

/// Does what was asked for as of a key and says what was told.
void doActions(Session& session, const Modes& modes) {
  for (const window::Action action : std::exchange(session.asks.actions, {})) {
    if (modes.handle({.kind = window::Command::Kind::act, .action = action}, session)) continue;
    perform(action, session);
  }
  for (Asks::Words& words : std::exchange(session.asks.words, {})) {
    session.report(words.severity, std::move(words.text));
  }
}

}  // namespace

std::span<const PanelEntry> panelList() { return kPanels; }

bool staysInPictures(std::string_view window) {
  return window == "##MainMenuBar" || window.starts_with("mode") || window.starts_with("panel") ||
         window.starts_with("plots") || window == "ruler" || window == "stop" || window == "unsafe";
}

void sidePanel(Session& session, float width, const FreeArea& free) {
  const float left = session.state.shown.panel_right ? width - kSidePanelWidth : 0.0f;
  ImGui::SetNextWindowPos({left, free.top});
  ImGui::SetNextWindowSize({kSidePanelWidth, ImGui::GetIO().DisplaySize.y - free.top});
  constexpr auto kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
  session.vertex_panel_open = false;
  if (ImGui::Begin("panel", nullptr, kFixed)) {
    for (const PanelEntry& panel : kPanels) {
      // F3 asks for this section from the keyboard.
      const bool asked = session.state.shown.performance && panel.name == kPerformance;
      if (asked) ImGui::SetNextItemOpen(true);
      const auto flags = panel.open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None;
      const bool open = ImGui::CollapsingHeader(panel.name, flags);
      notePlace(std::string("panel/") + panel.name);
      if (!open) continue;
      ImGui::PushID(panel.name);
      panel.draw(session);
      ImGui::PopID();
      ImGui::Spacing();
    }
  }
  ImGui::End();
}

namespace {

/// Side panel, plots, and what lies over the body.
void drawAroundTheBody(Session& session, float width, const FreeArea& free) {
  const Shown& shown = session.state.shown;
  if (shown.panel) sidePanel(session, width, free);
  if (shown.plots) plotStrips(plotsOf(session), free, session.asks);
  if (session.editor.active) editingFrame(free);
  if (session.ruler.active) rulerNotice(session.ruler, free);
  interventionNotice(interventionLines(session), free);
  if (session.replay.frozen) {
    replayBar(session.replay, free, session.asks);
  } else if (session.state.hints && !session.editor.active && !session.ruler.active) {
    hint(hintText(session.hint), free);
  }
}

/// The emergency stop and messages are seen whatever a mode shows.
void drawModeWindow(Mode& mode, Session& session, const FreeArea& free) {
  mode.draw(free);
  if (session.devices.stopped) stopBanner(free, session.asks);
  toast(session.messages, session.now_s, free);
}

}  // namespace

void drawGui(Session& session, const Modes& modes) {
  widgetPlaces().clear();
  Shown& shown = session.state.shown;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const FreeArea free = freeArea(shown, size.x, size.y);
  if (Mode* mode = modes.claimant(&Claims::window)) return drawModeWindow(*mode, session, free);
  if (!shown.open_dialog) session.replay.chooses_beside = false;
  menuBar(menuOf(session, modes), session.asks);
  doActions(session, modes);
  if (Mode* mode = modes.claimant(&Claims::body)) {
    mode->draw({0.0f, kMenuBarHeight, size.x, size.y});
  } else {
    drawAroundTheBody(session, size.x, free);
  }
  if (session.devices.unsafe) unsafeBanner(session.devices.safety_notes, free);
  if (session.devices.stopped) stopBanner(free, session.asks);
  buildProgress(session.building, free, session.asks);
  doActions(session, modes);
  toast(session.messages, session.now_s, free);
  if (shown.help) helpPage(shown.help);
  if (shown.messages) messageList(session.messages, shown.messages);
  if (shown.open_dialog) openDialog(session.state.recent, shown.open_dialog, session.asks);
  if (shown.save_dialog) saveDialog(session.document.file, session.output_folder, shown.save_dialog, session.asks);
  questionDialog(session.question, session.asks);
}

}  // namespace palpate::viewer

// The frame around the panels: where what stands on the screen, and the side panel with its sections.
#include <imgui.h>

#include <algorithm>

#include "apps/viewer/panels/panels.h"
#include "apps/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr float kPanelWidth = 300.0f;
constexpr float kMenuHeight = 24.0f;

constexpr PanelEntry kPanels[] = {
    {"Touch", touchPanel},
    {"Tissue", tissuePanel},
    {"Dysfunctions", dysfunctionPanel},
    {"Model", modelPanel},
    {"Show", showPanel},
    {"Stereo", stereoPanel},
    {"Record", recordPanel},
    {"Performance", performancePanel},
};

}  // namespace

std::span<const PanelEntry> panelList() { return kPanels; }

FreeArea freeArea(const Session& session, float width, float height) {
  const Shown& shown = session.state.shown;
  FreeArea free{0.0f, kMenuHeight, width, height};
  if (shown.panel) (shown.panel_right ? free.right : free.left) += shown.panel_right ? -kPanelWidth : kPanelWidth;
  if (shown.plots) free.below -= kPlotsHeight;
  return free;
}

void sidePanel(Session& session, float width, const FreeArea& free) {
  const float left = session.state.shown.panel_right ? width - kPanelWidth : 0.0f;
  ImGui::SetNextWindowPos({left, free.top});
  ImGui::SetNextWindowSize({kPanelWidth, ImGui::GetIO().DisplaySize.y - free.top});
  constexpr auto kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
  if (ImGui::Begin("panel", nullptr, kFixed)) {
    for (const PanelEntry& panel : kPanels) {
      // F3 asks for this section from the keyboard.
      const bool asked = session.state.shown.performance && panel.draw == performancePanel;
      if (asked) ImGui::SetNextItemOpen(true);
      const auto flags = panel.draw == touchPanel ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None;
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

FreeArea drawGui(Session& session) {
  widgetPlaces().clear();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const FreeArea free = freeArea(session, size.x, size.y);
  menuBar(session);
  if (session.state.shown.panel) sidePanel(session, size.x, free);
  if (session.state.shown.plots) plotStrips(session, free);
  if (session.editor.active) editingFrame(session, free);
  buildProgress(session, free);
  if (session.frozen) {
    replayBar(session, free);
  } else {
    hint(session, free);
  }
  toast(session, free);
  if (session.state.shown.help) helpPage(session);
  if (session.state.shown.messages) messageList(session);
  if (session.state.shown.open_dialog) openDialog(session);
  return free;
}

}  // namespace palpate::viewer

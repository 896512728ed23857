// The mouse is led over everything that can be used, and each thing must explain itself. Found by ImGui's own knowledge
// of what is under the cursor, so that a control which nobody named is found too.
#include <imgui.h>
#include <imgui_internal.h>

#include <map>
#include <set>

#include "stage.h"
#include "view/viewer/panels/gui_layout.h"

namespace palpate::viewer {
namespace {

constexpr double kRowStep = 13.0;                                ///< less than the lowest control is high, points
constexpr std::array<double, 3> kColumns = {22.0, 90.0, 170.0};  ///< of the panel: labels stand further right

struct Swept {
  std::size_t controls = 0;
  std::vector<std::string> silent;  ///< where, and the window
};

bool tooltipShown() {
  const ImGuiWindow* window = ImGui::FindWindowByName("##Tooltip_00");
  return window != nullptr && window->Active;
}

bool submenuShown() {
  const ImGuiWindow* window = ImGui::FindWindowByName("##Menu_01");
  return window != nullptr && window->Active;
}

bool isScrollbar(ImGuiID id) {
  const ImGuiWindow* window = ImGui::GetCurrentContext()->HoveredWindow;
  if (window == nullptr) return false;
  auto* of = const_cast<ImGuiWindow*>(window);
  return id == ImGui::GetWindowScrollbarID(of, ImGuiAxis_Y) || id == ImGui::GetWindowScrollbarID(of, ImGuiAxis_X) ||
         id == of->GetIDNoKeepAlive("#CLOSE");
}

/// Leads the mouse down a column of points.
void sweep(Stage& stage, const std::vector<double>& columns, double top, double below, Swept& swept) {
  std::set<ImGuiID> seen;
  for (const double x : columns) {
    for (double y = top; y < below; y += kRowStep) {
      stage.move(Vec2(x, y));
      const ImGuiID id = ImGui::GetCurrentContext()->HoveredId;
      if (id == 0 || isScrollbar(id) || ImGui::GetCurrentContext()->HoveredIdDisabled) continue;
      swept.controls += seen.insert(id).second ? 1 : 0;
      if (tooltipShown() || submenuShown()) continue;  // an open menu explains itself
      const ImGuiWindow* window = ImGui::GetCurrentContext()->HoveredWindow;
      swept.silent.push_back(std::to_string(static_cast<int>(x)) + ", " + std::to_string(static_cast<int>(y)) + " in " +
                             (window == nullptr ? "-" : window->Name));
    }
  }
}

void expectWords(const Swept& swept, std::size_t controls, const std::string& where) {
  EXPECT_GE(swept.controls, controls) << where;
  EXPECT_TRUE(swept.silent.empty()) << where << ": nothing is said at " << testing::PrintToString(swept.silent);
}

constexpr std::array<const char*, 11> kSections = {"Touch", "Devices", "Tissue", "Dysfunctions", "Lumps",      "Model",
                                                   "Show",  "Vertex",  "Stereo", "Record",       "Performance"};

TEST(Tooltips, EveryControlOfEveryPanelExplainsItself) {
  ASSERT_EQ(kSections.size(), panelList().size());
  for (const char* section : kSections) {
    Stage stage;
    stage.state().scene.dysfunctions.push_back({.x_mm = 10.0, .y_mm = 20.0, .radius_mm = 15.0, .change_percent = 60.0});
    stage.state().scene.lumps.push_back({.name = "node"});
    stage.state().lump_editor.selected = 0;
    stage.click("panel/Touch");  // it is open at first
    stage.click(std::string("panel/") + section);
    if (section == std::string("Show")) stage.click("show/engine");
    Swept swept;
    sweep(stage, {kColumns.begin(), kColumns.end()}, 30.0, 795.0, swept);
    expectWords(swept, 1, section);
  }
}

TEST(Tooltips, EveryItemOfEveryMenuExplainsItself) {
  for (const char* menu : {"File", "View", "Show", "Help"}) {
    Stage stage;
    stage.state().state.recent = {"/tmp/a.toml"};
    stage.click(std::string("menu/") + menu);
    const double left =
        std::map<std::string, double>{{"File", 60.0}, {"View", 90.0}, {"Show", 130.0}, {"Help", 180.0}}.at(menu);
    Swept swept;
    sweep(stage, {left}, 30.0, 700.0, swept);
    expectWords(swept, 4, menu);
  }
}

TEST(Tooltips, SoDoesEachDialogAndPage) {
  const auto rows = [](const char* name, bool Shown::*which, std::vector<double> columns) {
    Stage stage;
    stage.state().class_shown.offered = true;
    stage.state().state.shown.*which = true;
    stage.frame();
    stage.frame();
    Swept swept;
    sweep(stage, columns, 20.0, 780.0, swept);
    expectWords(swept, 1, name);
  };
  rows("picture", &Shown::picture_dialog, {400.0, 760.0, 860.0});
  rows("film", &Shown::film_dialog, {400.0, 760.0, 860.0});
  rows("open", &Shown::open_dialog, {400.0, 760.0, 860.0});
  rows("save", &Shown::save_dialog, {400.0, 760.0, 860.0});
  rows("class", &Shown::class_dialog, {400.0, 600.0});
  rows("start page", &Shown::start, {150.0, 450.0, 700.0});
}

}  // namespace
}  // namespace palpate::viewer

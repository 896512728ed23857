// F1: the table of keys and the rules of the mouse on one page.
#include <imgui.h>

#include <algorithm>

#include "palpate/base/language.h"
#include "palpate/window/keys.h"
#include "view/viewer/panels/panels.h"

namespace palpate::viewer {

namespace {

struct MouseRule {
  const char* input;
  const char* does;
};
constexpr MouseRule kMouse[] = {
    {toTranslate("Left on the skin"), toTranslate("press; move to pull the skin, wheel for the depth (Shift: finer)")},
    {toTranslate("Left beside the body, right"), toTranslate("turn about the place under the cursor")},
    {toTranslate("Left and right together"), toTranslate("up and down changes the depth")},
    {toTranslate("Middle, or Shift and left"), toTranslate("shift the view")},
    {toTranslate("Wheel"), toTranslate("nearer and farther, about the cursor")},
    {toTranslate("Double click"), toTranslate("turn about that place from now on")},
};

void row(const char* input, const char* does) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(tr(input));
  ImGui::TableNextColumn();
  ImGui::TextWrapped("%s", tr(does));
}

/// For the keys and buttons, points: those on the left of the page have long names.
constexpr float kLeftNames = 190.0f;
constexpr float kRightNames = 120.0f;

bool beginRows(const char* name, float names) {
  if (!ImGui::BeginTable(name, 2)) return false;
  ImGui::TableSetupColumn("input", ImGuiTableColumnFlags_WidthFixed, names);
  ImGui::TableSetupColumn("does");
  return true;
}

void drawKeyGroup(window::KeyGroup group, float names) {
  const auto index = static_cast<std::size_t>(group);
  ImGui::TextDisabled("%s", tr(std::string(window::kKeyGroupNames[index]).c_str()));
  if (!beginRows(std::string(window::kKeyGroupNames[index]).c_str(), names)) return;
  for (const window::KeyBinding& binding : window::keyTable()) {
    if (binding.group == group) row(window::keysOf(binding).c_str(), std::string(binding.does).c_str());
  }
  ImGui::EndTable();
}

void mouseRules() {
  ImGui::TextDisabled("%s", tr("Mouse"));
  if (!beginRows("mouse", kLeftNames)) return;
  for (const MouseRule& rule : kMouse) row(rule.input, rule.does);
  ImGui::EndTable();
}

}  // namespace

void helpPage(bool& open) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowBgAlpha(1.0f);
  ImGui::SetNextWindowSize({std::min(1100.0f, size.x - 40.0f), std::min(760.0f, size.y - 40.0f)});
  if (ImGui::Begin(tr("Keys and mouse (F1 or Esc closes)"), &open,
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                       ImGuiWindowFlags_NoSavedSettings)) {
    constexpr float kMinForTwo = 760.0f;                           // in a narrow window one column, to be scrolled
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {4.0f, 0.5f});  // all of it should fit
    if (ImGui::BeginTable("columns", size.x < kMinForTwo ? 1 : 2)) {
      ImGui::TableNextColumn();
      mouseRules();
      drawKeyGroup(window::KeyGroup::touch, kLeftNames);
      drawKeyGroup(window::KeyGroup::overlays, kLeftNames);
      ImGui::TableNextColumn();
      drawKeyGroup(window::KeyGroup::view, kRightNames);
      drawKeyGroup(window::KeyGroup::window, kRightNames);
      drawKeyGroup(window::KeyGroup::file, kRightNames);
      ImGui::EndTable();
    }
    ImGui::PopStyleVar();
  }
  ImGui::End();
}

}  // namespace palpate::viewer

// Help > Manual: the documents with a field to search them.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "palpate/base/language.h"
#include "view/viewer/manual/manual.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

// Points.
constexpr float kWidestManual = 980.0f;
constexpr float kManualMargin = 16.0f;

void goTo(ManualShown& manual, const ManualPage& page, std::string heading) {
  if (page.file != manual.page) manual.before.push_back(std::exchange(manual.page, page.file));
  manual.heading = std::move(heading);
  manual.searched.clear();
  manual.outside.clear();
}

/// A line of buttons and the field, which has the keyboard from the beginning. True for Enter.
bool searchBar(ManualShown& manual, bool& open) {
  if (buttonWidget("manual/contents", "Contents")) goTo(manual, *manualPage(kManualContents), {});
  ImGui::SameLine();
  ImGui::BeginDisabled(manual.before.empty());
  if (buttonWidget("manual/back", "Back")) {
    manual.page = manual.before.back();
    manual.before.pop_back();
    manual.searched.clear();
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-70.0f);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  const bool entered = ImGui::InputTextWithHint("##search", tr("Search the manual"), &manual.searched,
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  notePlace("manual/search");
  ImGui::SameLine();
  if (buttonWidget("manual/close", "Close")) open = false;
  return entered;
}

/// Two lines on one row.
bool resultRow(const ManualResult& result, std::size_t number) {
  std::string title = titleInLanguage(result.page->title);
  if (!result.heading.empty()) title += " - " + result.heading;
  const float height = 2.0f * ImGui::GetTextLineHeight() + 6.0f;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool chosen = ImGui::Selectable(fmt::format("##result{}", number).c_str(), number == 0, 0, {0.0f, height});
  notePlace(fmt::format("manual/result/{}", number), result.page->file);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText({at.x + 4.0f, at.y}, ImGui::GetColorU32(ImGuiCol_Text), title.c_str());
  list.AddText({at.x + 4.0f, at.y + ImGui::GetTextLineHeight() + 2.0f}, ImGui::GetColorU32(ImGuiCol_TextDisabled),
               result.excerpt.c_str());
  return chosen;
}

void results(ManualShown& manual, bool entered) {
  const std::vector<ManualResult> found = searchManual(manual.searched);
  if (found.empty()) return remark("No page contains all these words.");
  const ManualResult* chosen = entered ? &found.front() : nullptr;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (resultRow(found[i], i)) chosen = &found[i];
  }
  if (chosen != nullptr) goTo(manual, *chosen->page, headingAnchor(chosen->heading));
}

void pageShown(ManualShown& manual) {
  const ManualPage* page = manualPage(manual.page);
  if (page == nullptr) page = manualPage(kManualContents);
  static std::pair<const ManualPage*, std::vector<Block>> shown;  // used on the display's thread
  if (shown.first != page) shown = {page, blocksInLanguage(*page)};
  const std::string target = drawBlocks(shown.second, std::exchange(manual.heading, {}));
  if (target.empty()) return;
  const ManualLink link = linkFrom(*page, target);
  if (link.page != nullptr) return goTo(manual, *link.page, link.anchor);
  manual.outside = target;
}

}  // namespace

void manualDialog(ManualShown& manual, bool& open) {
  const char* const title = tr("Manual");
  if (!openCentredModal(title, open)) return;
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSize({std::min(kWidestManual, room.x - kManualMargin), room.y - kManualMargin});
  constexpr auto kFlags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                          ImGuiWindowFlags_NoSavedSettings;
  if (!ImGui::BeginPopupModal(title, &open, kFlags)) return;
  const bool entered = searchBar(manual, open);
  if (language().code != "en") remark("The manual's pages are in English.");
  if (!manual.outside.empty()) remark(trf("Not a page of the manual: {}", manual.outside));
  const bool searches = !manual.searched.empty();
  // A page keeps its own place when it is left and returned to.
  if (ImGui::BeginChild(searches ? "results" : manual.page.c_str())) {
    searches ? results(manual, entered) : pageShown(manual);
  }
  ImGui::EndChild();
  endDialog(open);
}

}  // namespace palpate::viewer

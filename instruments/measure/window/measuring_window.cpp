// In a narrow window the column is one more tab.
#include "measure/window/measuring_window.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "palpate/base/language.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr float kColumn = 292.0f;
constexpr float kNarrow = 760.0f;

constexpr std::array<const char*, 5> kTabNames = {toTranslate("Before"), toTranslate("After"), toTranslate("Result"),
                                                  toTranslate("All"), toTranslate("Numbers")};
constexpr std::array<const char*, 5> kTabPaths = {"measuring/tab/before", "measuring/tab/after", "measuring/tab/result",
                                                  "measuring/tab/all", "measuring/tab/numbers"};

/// A row of buttons and not ImGui's tab bar, which wants to keep the choice itself.
void tabs(MeasuringView& view, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto tab = static_cast<MeasuringTab>(i);
    if (i > 0) ImGui::SameLine(0.0f, 3.0f);
    const bool here = view.tab == tab;
    if (here) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (buttonWidget(kTabPaths[i], kTabNames[i])) view.tab = tab;
    if (here) ImGui::PopStyleColor();
  }
}

/// At the right end of the same row, or below it if there is not enough room.
void tools(MeasuringView& view) {
  constexpr std::array<const char*, 3> kNames = {toTranslate("Look"), toTranslate("Contact"), toTranslate("Dots")};
  constexpr std::array<const char*, 3> kPaths = {"measuring/look", "measuring/contact", "measuring/dots"};
  const ImGuiStyle& style = ImGui::GetStyle();
  float width = 0.0f;
  for (const char* name : kNames) {
    width += ImGui::CalcTextSize(tr(name)).x + ImGui::GetFrameHeight() + style.ItemInnerSpacing.x + style.ItemSpacing.x;
  }
  const float left = ImGui::GetWindowContentRegionMax().x - width;
  const float end_of_tabs = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x;
  if (left > end_of_tabs + style.ItemSpacing.x) ImGui::SameLine(left);
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    const auto tool = static_cast<MeasuringTool>(i);
    if (ImGui::RadioButton(tr(kNames[i]), view.tool == tool)) useTool(view, tool);
    notePlace(kPaths[i]);
  }
}

const measure::OverlayPanel* findPanel(const MeasuringView& view, measure::PanelPicture picture) {
  for (const measure::OverlayPanel& panel : view.overlay.panels) {
    if (panel.picture == picture) return &panel;
  }
  return nullptr;
}

void showPhotos(MeasuringView& view, const Vec2& room) {
  using measure::PanelPicture;
  const PhotoPanel panels[] = {
      {Photo::before, findPanel(view, PanelPicture::before), false, "measuring/before"},
      {Photo::after, findPanel(view, PanelPicture::after), false, "measuring/after"},
      {Photo::before, findPanel(view, PanelPicture::before_faded), true, "measuring/result"},
  };
  if (view.tab != MeasuringTab::all) return photoPanel(view, panels[static_cast<std::size_t>(view.tab)], room);
  constexpr double kGap = 4.0;
  const Vec2 third((room.x() - 2.0 * kGap) / 3.0, room.y());
  for (const PhotoPanel& panel : panels) {
    if (&panel != panels) ImGui::SameLine(0.0f, static_cast<float>(kGap));
    photoPanel(view, panel, third);
  }
}

struct Status {
  Severity severity = Severity::info;
  std::string words;
};

Status chooseStatus(const MeasuringView& view) {
  if (!view.failure.empty()) return {Severity::error, view.failure};
  if (view.measured) return {view.overlay.accepted ? Severity::info : Severity::error, view.overlay.verdict};
  return {Severity::info,
          tr("Choose a photograph of the dots before the skin is dragged, and one after; or drop them on the window.")};
}

/// With some room for more than one line, but leaves most of it to the photographs.
float statusHeight(const Status& status, const ImVec2& room) {
  const float words = ImGui::CalcTextSize(status.words.c_str(), nullptr, false, room.x).y;
  return std::clamp(words, ImGui::GetFrameHeight(), 0.3f * room.y) + ImGui::GetStyle().ItemSpacing.y;
}

/// Below the photographs: the verdict, or how far the work is.
void statusRow(const MeasuringView& view, const Status& status, MeasuringRequests& requests) {
  if (view.working) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float cancel = ImGui::CalcTextSize(tr("Cancel")).x + 2.0f * style.FramePadding.x + style.ItemSpacing.x;
    ImGui::ProgressBar(static_cast<float>(view.done), {-cancel, 0.0f}, tr(view.stage.c_str()));
    ImGui::SameLine();
    if (buttonWidget("measuring/cancel", "Cancel")) requests.emplace_back(CancelMeasuring{});
    return;
  }
  ImGui::PushTextWrapPos(0.0f);
  drawSeverityText(status.severity, status.words);
  ImGui::PopTextWrapPos();
}

void photoSide(MeasuringView& view, bool narrow, MeasuringRequests& requests) {
  tabs(view, narrow ? kTabNames.size() : kTabNames.size() - 1);
  if (view.tab != MeasuringTab::numbers) tools(view);
  if (view.tab == MeasuringTab::numbers) {
    if (ImGui::BeginChild("measuring_numbers")) measuringColumn(view, requests);
    return ImGui::EndChild();
  }
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const Status status = chooseStatus(view);
  showPhotos(view, Vec2(std::max(40.0f, room.x), std::max(40.0f, room.y - statusHeight(status, room))));
  statusRow(view, status, requests);
}

}  // namespace

void measuringWindow(MeasuringView& view, const FreeArea& free, MeasuringRequests& requests) {
  const float width = free.right - free.left;
  ImGui::SetNextWindowPos({free.left, free.top});
  ImGui::SetNextWindowSize({width, free.below - free.top});
  constexpr auto kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                          ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus |
                          ImGuiWindowFlags_NoScrollWithMouse;
  const bool narrow = width < kNarrow;
  if (!narrow && view.tab == MeasuringTab::numbers) view.tab = MeasuringTab::result;
  if (ImGui::Begin("mode_measuring", nullptr, kFlags)) {
    if (!narrow) {
      if (ImGui::BeginChild("measuring_column", {kColumn, 0.0f})) measuringColumn(view, requests);
      ImGui::EndChild();
      ImGui::SameLine();
    }
    const auto no_scroll = ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
    if (ImGui::BeginChild("measuring_photos", {0.0f, 0.0f}, false, no_scroll)) photoSide(view, narrow, requests);
    ImGui::EndChild();
  }
  ImGui::End();
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) releasePhoto(view);
  if (!view.dialog) return;
  bool open = true;
  const bool before = *view.dialog == Photo::before;
  std::string chosen = photographDialog(
      before ? toTranslate("Open the photograph before") : toTranslate("Open the photograph after"), open);
  if (!chosen.empty()) requests.emplace_back(ShowPhoto{*view.dialog, std::move(chosen)});
  if (!open || !chosen.empty()) view.dialog.reset();
}

}  // namespace palpate::viewer

#include "measure/window/measuring_window.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "palpate/base/language.h"
#include "palpate/base/path_text.h"
#include "palpate/view/overlays/place_words.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr std::array<std::string_view, 4> kHeadNames = {toTranslate("top"), toTranslate("left"), toTranslate("bottom"),
                                                        toTranslate("right")};

void photoRow(MeasuringView& view, Photo which) {
  const bool before = which == Photo::before;
  if (buttonWidget(before ? "measuring/open_before" : "measuring/open_after", before ? "Before ..." : "After ...",
                   before ? "Photograph of the dots with nothing pressing."
                          : "Photograph taken while the stick drags the skin.")) {
    view.dialog = which;
  }
  const float words = std::max(ImGui::CalcTextSize(tr("Before ...")).x, ImGui::CalcTextSize(tr("After ...")).x);
  ImGui::SameLine(std::max(84.0f, words + 4.0f * ImGui::GetStyle().FramePadding.x));
  const std::string name = std::filesystem::path(view.photo(which).file).filename().string();
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(name.empty() ? "-" : name.c_str());
  ImGui::PopTextWrapPos();
  for (const std::string& note : view.photo(which).notes) remark(note);
}

/// Both photographs by one click, where they lie ready.
void pairRow(const PhotoPair& pair, MeasuringRequests& requests) {
  const auto name = [](const std::string& file) { return pathOf(file).filename().string(); };
  ImGui::PushTextWrapPos(0.0f);
  remark(trf("In this folder: {} and {}", name(pair.before), name(pair.after)));
  ImGui::PopTextWrapPos();
  if (!buttonWidget("measuring/here", "Use both", "Open the photographs before and after with the same name.")) return;
  requests.emplace_back(ShowPhoto{Photo::before, pair.before});
  requests.emplace_back(ShowPhoto{Photo::after, pair.after});
}

void photoRows(MeasuringView& view, MeasuringRequests& requests) {
  if (ImGui::IsWindowAppearing()) view.pair_here = pairAmong(photographsInFolder());
  const bool none = view.photo(Photo::before).file.empty() && view.photo(Photo::after).file.empty();
  if (none && view.pair_here) pairRow(*view.pair_here, requests);
  photoRow(view, Photo::before);
  photoRow(view, Photo::after);
  if (view.hasPair() &&
      buttonWidget("measuring/swap", "Swap them", "Swap the photographs if they are the wrong way round.")) {
    requests.emplace_back(SwapPhotos{});
  }
}

const char* toolHint(const MeasuringView& view) {
  if (view.tool == MeasuringTool::contact)
    return toTranslate("Click where the stick touched the skin, in the photograph before.");
  if (view.tool == MeasuringTool::dots) {
    return toTranslate(
        "Click bare skin to add a dot, a dot to remove it; drag moves it. With Shift a click only selects, arrows "
        "nudge.");
  }
  return toTranslate("Drag shifts, the wheel zooms.");
}

void hintRows(MeasuringView& view) {
  remark(toolHint(view));
  if (view.settings.contact_px &&
      buttonWidget("measuring/no_contact", "Forget the contact", "The fitted contact is then not compared.")) {
    setContact(view, std::nullopt);
  }
}

void settingRows(MeasuringView& view) {
  measure::MeasureSettings& settings = view.settings;
  bool changed =
      numberWidget(settings.spacing_mm, {"measuring/spacing", "mm spacing", "%.1f", 5.0, 100.0, 30.0,
                                         "Distance from dot to dot on the stencil. All sizes follow from it."});
  changed |= numberWidget(settings.drift_mm, {"measuring/drift", "mm drift", "%.2f", 0.01, 20.0, 0.4,
                                              "How far the body may have moved between the photographs."});
  auto head = static_cast<std::size_t>(settings.head);
  if (choiceWidget("measuring/head", "head towards", head, kHeadNames,
                   "The edge of the photograph that is nearest to the head.")) {
    settings.head = static_cast<measure::HeadTowards>(head);
    changed = true;
  }
  changed |=
      flagWidget("measuring/partial", kPartialBox, settings.partial, "Accept an ellipse that is larger than the dots.");
  if (changed) settingsChanged(view);
}

void findingLines(const MeasuringView& view) {
  if (!view.measured) return;
  ImGui::PushTextWrapPos(0.0f);
  for (const measure::Finding& finding : view.measured->findings) {
    const bool refusal = finding.severity == measure::Severity::refusal;
    drawSeverityText(refusal ? Severity::error : Severity::warning,
                     fmt::format("{}: {}", tr(refusal ? "Refused" : "Warning"), findingText(finding)));
  }
  ImGui::PopTextWrapPos();
}

void numberLines(const MeasuringView& view) {
  if (!view.measured) return;
  for (const MeasuredNumber& number : measuredNumbers(*view.measured)) valueLine(number.label.c_str(), number.value);
}

void textField(const char* path, const char* label, const char* hint, std::string& text) {
  ImGui::PushID(path);
  ImGui::SetNextItemWidth(0.68f * ImGui::GetContentRegionAvail().x);
  ImGui::InputTextWithHint(tr(label), hint, &text);
  notePlace(path);
  ImGui::PopID();
}

/// Two lines, with or without text: the rows below must not move while a place is typed.
void placeRow(const std::string& words) {
  ImGui::BeginChild("place words", {0.0f, 2.0f * ImGui::GetTextLineHeight()});
  ImGui::SetCursorPosX(2.0f);  // a T begins a little before its place
  if (!words.empty()) remark(words);
  ImGui::EndChild();
}

void acceptRows(MeasuringView& view, MeasuringRequests& requests) {
  AcceptForm& form = view.form;
  textField("measuring/place", "place", view::placeInLanguage("T6 left 40 mm").c_str(), form.place);
  placeRow(form.place_words);
  textField("measuring/name", "name", form.place_name.c_str(), form.name);
  textField("measuring/table", "table", "key_points.csv", form.table);
  flagWidget("measuring/use", "the skin here follows it", form.use_in_scene,
             "The scene takes the table as its key points ([ellipses] key_points).");
  const std::string obstacle = obstacleToAccept(view);
  if (buttonWidget("measuring/accept", "Accept", "Add a row to the table (Enter).")) {
    requests.emplace_back(AcceptMeasurement{});
  }
  if (!obstacle.empty() && view.measured) remark(obstacle);
}

}  // namespace

void measuringColumn(MeasuringView& view, MeasuringRequests& requests) {
  if (buttonWidget("measuring/close", "Back to the body",
                   "Return to the body (Esc); nothing is lost, you can open it again.")) {
    view.open = false;
  }
  photoRows(view, requests);
  ImGui::Separator();
  hintRows(view);
  ImGui::Separator();
  settingRows(view);
  ImGui::Separator();
  acceptRows(view, requests);
  ImGui::Separator();
  findingLines(view);  // below all that is clicked: they come and go
  numberLines(view);
}

}  // namespace palpate::viewer

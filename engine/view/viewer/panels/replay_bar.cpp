// The bar under a frozen picture: its moment, and buttons that step it back and forth.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "palpate/base/language.h"
#include "palpate/base/path_text.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"
#include "view/viewer/state/replay.h"

namespace palpate::viewer {

namespace {

constexpr float kWidth = 460.0f;
constexpr float kButtonsWidth = 214.0f;

std::string wordsFor(const Replay& replay) {
  if (replay.table.empty()) return trf("Frozen, {:.3f} s ago", replay.to_s - replay.at_s);
  return trf("{}: {:.3f} of {:.3f} s", pathOf(replay.table).filename().string(), replay.at_s - replay.from_s,
             replay.to_s - replay.from_s);
}

void stepButtons(Replay& replay, UiOutput& output) {
  if (buttonWidget("replay/back", "<<", "Go back one picture (1/60 s): Left.")) stepReplay(replay, -kReplayStepS);
  ImGui::SameLine();
  if (buttonWidget("replay/tick_back", "<", "Go back one servo tick: Shift and Left.")) {
    stepReplay(replay, -replay.tick_s);
  }
  ImGui::SameLine();
  if (buttonWidget("replay/play", replay.playing ? "stop" : "play", "Play at the original speed.")) {
    replay.playing = !replay.playing;
    if (replay.playing && replay.at_s >= replay.to_s) replay.at_s = replay.from_s;
  }
  ImGui::SameLine();
  if (buttonWidget("replay/tick", ">", "Go forward one servo tick: Shift and Right.")) {
    stepReplay(replay, replay.tick_s);
  }
  ImGui::SameLine();
  if (buttonWidget("replay/forth", ">>", "Go forward one picture (1/60 s): Right.")) stepReplay(replay, kReplayStepS);
  ImGui::SameLine();
  if (buttonWidget("replay/live", "live", "Return to live touch: Space.")) output.act(window::Action::freeze);
}

/// Draws the marks over the slider that was drawn last.
void drawMarks(const Replay& replay) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  const double span_s = std::max(1e-9, replay.to_s - replay.from_s);
  // The grab stays inside the slider by half its width and a frame.
  const float inset = 0.5f * ImGui::GetStyle().GrabMinSize + 2.0f;
  for (const ReplayMark& mark : replay.marks) {
    const auto share = static_cast<float>((mark.at_s - replay.from_s) / span_s);
    const float x = low.x + inset + share * (high.x - low.x - 2.0f * inset);
    ImGui::GetWindowDrawList()->AddLine({x, low.y}, {x, high.y}, ImGui::GetColorU32(ImGuiCol_PlotHistogram), 2.0f);
  }
}

/// For a recording: marks, repetition, another one next to it.
void sessionButtons(Replay& replay, UiOutput& output) {
  flagWidget("replay/loop", "loop", replay.loops, "Start again at the end.");
  ImGui::SameLine();
  if (!replay.marks.empty()) {
    if (buttonWidget("replay/mark_back", "mark <", "Go to the previous mark.")) goToMark(replay, false);
    ImGui::SameLine();
    if (buttonWidget("replay/mark_forth", "mark >", "Go to the next mark.")) goToMark(replay, true);
    ImGui::SameLine();
  }
  if (replay.beside.empty()) {
    if (buttonWidget("replay/beside", "beside ...", "Show another recording next to this one, from its beginning.")) {
      replay.chooses_beside = true;
      output.act(window::Action::open);
    }
  } else if (buttonWidget("replay/alone", "alone", "Remove the other recording.")) {
    replay.beside.clear();
  }
  const std::string mark = markAt(replay);
  if (mark.empty()) return;
  ImGui::SameLine();
  ImGui::TextUnformatted(mark.c_str());
}

/// Names the recordings of the two halves.
void nameHalves(const Replay& replay, const FreeArea& free) {
  const std::array<std::string, 2> names = {pathOf(replay.table).filename().string(),
                                            pathOf(replay.beside).filename().string()};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const float left = i == 0 ? free.left : 0.5f * (free.left + free.right);
    ImGui::GetForegroundDrawList()->AddText({left + 12.0f, free.top + 8.0f}, ImGui::GetColorU32(ImGuiCol_Text),
                                            names[i].c_str());
  }
}

}  // namespace

void replayBar(Replay& replay, const FreeArea& free, UiOutput& output) {
  if (!replay.beside.empty()) nameHalves(replay, free);
  ImGui::SetNextWindowPos({0.5f * (free.left + free.right), free.below - 16.0f}, ImGuiCond_Always, {0.5f, 1.0f});
  const float width = std::min(kWidth, free.right - free.left - 8.0f);
  ImGui::SetNextWindowSize({width, 0.0f});
  ImGui::SetNextWindowBgAlpha(0.9f);
  constexpr auto kBar = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                        ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
  if (ImGui::Begin("replay", nullptr, kBar)) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(wordsFor(replay).c_str());
    if (ImGui::GetItemRectSize().x + kButtonsWidth + 16.0f < width) ImGui::SameLine(width - kButtonsWidth);
    stepButtons(replay, output);
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::SliderScalar("##moment", ImGuiDataType_Double, &replay.at_s, &replay.from_s, &replay.to_s, "")) {
      replay.playing = false;
    }
    notePlace("replay/moment");
    drawMarks(replay);
    if (!replay.table.empty()) sessionButtons(replay, output);
    notePlaceOfWindow("replay");
  }
  ImGui::End();
}

}  // namespace palpate::viewer

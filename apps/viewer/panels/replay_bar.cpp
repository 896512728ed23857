// The bar under a frozen picture: which moment it shows, and buttons that step it back and forth.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "apps/viewer/files/replay.h"
#include "apps/viewer/panels/panels.h"
#include "apps/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr float kWidth = 460.0f;
constexpr float kButtonsWidth = 214.0f;

std::string wordsFor(const Replay& replay) {
  if (replay.table.empty()) return fmt::format("Frozen, {:.3f} s ago", replay.to_s - replay.at_s);
  return fmt::format("{}: {:.3f} of {:.3f} s", std::filesystem::path(replay.table).filename().string(),
                     replay.at_s - replay.from_s, replay.to_s - replay.from_s);
}

void stepButtons(Replay& replay, Asks& asks) {
  if (buttonWidget("replay/back", "<<", "A picture back (1/60 s): Left.")) stepReplay(replay, -kReplayStepS);
  ImGui::SameLine();
  if (buttonWidget("replay/tick_back", "<", "A tick of the servo back: Shift and Left.")) {
    stepReplay(replay, -replay.tick_s);
  }
  ImGui::SameLine();
  if (buttonWidget("replay/play", replay.playing ? "stop" : "play", "As fast as it was.")) {
    replay.playing = !replay.playing;
    if (replay.playing && replay.at_s >= replay.to_s) replay.at_s = replay.from_s;
  }
  ImGui::SameLine();
  if (buttonWidget("replay/tick", ">", "A tick of the servo forth: Shift and Right.")) {
    stepReplay(replay, replay.tick_s);
  }
  ImGui::SameLine();
  if (buttonWidget("replay/forth", ">>", "A picture forth (1/60 s): Right.")) stepReplay(replay, kReplayStepS);
  ImGui::SameLine();
  if (buttonWidget("replay/live", "live", "Back to what is touched now: Space.")) asks.act(window::Action::freeze);
}

}  // namespace

void replayBar(Replay& replay, const FreeArea& free, Asks& asks) {
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
    stepButtons(replay, asks);
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::SliderScalar("##moment", ImGuiDataType_Double, &replay.at_s, &replay.from_s, &replay.to_s, "")) {
      replay.playing = false;
    }
    notePlace("replay/moment");
    notePlaceOfWindow("replay");
  }
  ImGui::End();
}

}  // namespace palpate::viewer

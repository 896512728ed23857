// Messages over the picture: hints, notices, progress, the state of editing.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

#include "palpate/base/language.h"
#include "palpate/servo/device_limits.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr auto kNotice = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                         ImGuiWindowFlags_NoNav;
/// Shorter work shows no progress.
constexpr double kProgressAfterS = 0.15;

float centreX(const FreeArea& free) { return 0.5f * (free.left + free.right); }

/// Text breaks in here, so that a notice fits into a narrow window too.
float wordsWidth(const FreeArea& free) {
  constexpr float kMax = 640.0f;
  return std::clamp(free.right - free.left - 40.0f, 120.0f, kMax);
}

void drawWrappedText(std::string_view words, const FreeArea& free) {
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wordsWidth(free));
  ImGui::TextUnformatted(tr(std::string(words).c_str()));
  ImGui::PopTextWrapPos();
}

/// Uses the same hues on a light window, darker.
ImVec4 colourOf(Severity severity) {
  const bool light_window = isLightTheme();
  if (severity == Severity::error)
    return light_window ? ImVec4{0.70f, 0.10f, 0.08f, 1.0f} : ImVec4{0.98f, 0.45f, 0.40f, 1.0f};
  if (severity == Severity::warning)
    return light_window ? ImVec4{0.55f, 0.36f, 0.0f, 1.0f} : ImVec4{0.98f, 0.80f, 0.40f, 1.0f};
  return ImGui::GetStyleColorVec4(ImGuiCol_Text);
}

std::string severityPrefix(Severity severity) {
  if (severity == Severity::error) return fmt::format("{}: ", tr("Error"));
  return severity == Severity::warning ? fmt::format("{}: ", tr("Warning")) : "";
}

}  // namespace

void hint(std::string_view words, const FreeArea& free) {
  if (words.empty()) return;
  ImGui::SetNextWindowPos({centreX(free), free.below - 16.0f}, ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::SetNextWindowBgAlpha(0.72f);
  if (ImGui::Begin("hint", nullptr, kNotice | ImGuiWindowFlags_NoInputs)) {
    drawWrappedText(words, free);
  }
  notePlaceOfWindow("hint");
  ImGui::End();
}

void toast(Messages& messages, double now_s, const FreeArea& free) {
  const Message* message = messages.toast(now_s);
  if (message == nullptr) return;
  const float width = std::min(460.0f, wordsWidth(free));
  ImGui::SetNextWindowPos({centreX(free), free.top + 12.0f}, ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {width, 400.0f});
  ImGui::SetNextWindowBgAlpha(0.92f);
  if (ImGui::Begin("toast", nullptr, kNotice)) {
    ImGui::PushTextWrapPos(width - 20.0f);
    ImGui::TextColored(colourOf(message->severity), "%s%s", severityPrefix(message->severity).c_str(),
                       message->text.c_str());
    ImGui::PopTextWrapPos();
    if (message->severity != Severity::info && buttonWidget("toast/dismiss", "Dismiss")) messages.dismiss();
  }
  notePlaceOfWindow("toast");
  ImGui::End();
}

void drawSeverityText(Severity severity, const std::string& words) {
  ImGui::PushStyleColor(ImGuiCol_Text, colourOf(severity));
  ImGui::TextUnformatted(words.c_str());
  ImGui::PopStyleColor();
}

void buildProgress(const std::optional<engine::BuildProgress>& building, const FreeArea& free, UiOutput& output) {
  if (!building || building->since_s < kProgressAfterS) return;
  ImGui::SetNextWindowPos({centreX(free), free.below - 64.0f}, ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::SetNextWindowBgAlpha(0.9f);
  if (ImGui::Begin("building", nullptr, kNotice)) {
    ImGui::TextUnformatted(tr(building->stage.c_str()));
    ImGui::ProgressBar(static_cast<float>(building->done), {260.0f, 0.0f});
    ImGui::SameLine();
    if (buttonWidget("building/cancel", "Cancel")) output.request(CancelBuild{});
  }
  ImGui::End();
}

void editingFrame(const FreeArea& free) {
  constexpr ImU32 kColour = IM_COL32(240, 170, 60, 255);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRect({free.left + 2.0f, free.top + 2.0f}, {free.right - 2.0f, free.below - 2.0f}, kColour, 0.0f, 0, 3.0f);
  ImGui::SetNextWindowPos({centreX(free), free.below - 16.0f}, ImGuiCond_Always, {0.5f, 1.0f});
  if (ImGui::Begin("editing", nullptr, kNotice | ImGuiWindowFlags_NoInputs)) {
    drawWrappedText("Editing: click places, drag moves, wheel sizes, Shift and wheel strengthens, Esc leaves", free);
  }
  notePlaceOfWindow("editing");
  ImGui::End();
}

void stopBanner(const FreeArea& free, UiOutput& output) {
  constexpr ImU32 kRed = IM_COL32(230, 30, 24, 255);
  constexpr float kWidth = 8.0f;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float inset = 0.5f * kWidth;
  list.AddRect({free.left + inset, free.top + inset}, {free.right - inset, free.below - inset}, kRed, 0.0f, 0, kWidth);
  ImGui::SetNextWindowPos({centreX(free), free.top + 0.22f * (free.below - free.top)}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32(150, 14, 10, 245));
  ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32_WHITE);
  if (ImGui::Begin("stop", nullptr, kNotice)) {
    ImGui::SetWindowFontScale(1.5f);
    ImGui::TextUnformatted(tr("EMERGENCY STOP"));
    ImGui::SetWindowFontScale(1.0f);
    drawWrappedText("No device gets a force. After the release a finger feels again once its tip has been outside.",
                    free);
    ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(90, 6, 4, 255));
    if (buttonWidget("stop/release", "Release the stop")) output.request(ReleaseStop{});
    ImGui::PopStyleColor();
  }
  notePlaceOfWindow("stop");
  ImGui::End();
  ImGui::PopStyleColor(2);
}

void unsafeBanner(std::span<const std::string> notes, const FreeArea& free) {
  constexpr ImU32 kAmber = IM_COL32(240, 130, 20, 255);
  constexpr float kWidth = 6.0f;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({free.left, free.top}, {free.right, free.top + kWidth}, kAmber);
  ImGui::SetNextWindowPos({centreX(free), free.top + kWidth}, ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32(150, 70, 0, 245));
  ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32_WHITE);
  if (ImGui::Begin("unsafe", nullptr, kNotice | ImGuiWindowFlags_NoInputs)) {
    const bool lifts = !notes.empty() && notes.front().starts_with(servo::kUnsafeMark);
    drawWrappedText(lifts ? trf("{}. Pause stops all forces.", notes.front())
                          : std::string(tr("UNSAFE STIFFNESS allowed (--unsafe-stiffness). Pause stops all forces.")),
                    free);
  }
  notePlaceOfWindow("unsafe");
  ImGui::End();
  ImGui::PopStyleColor(2);
}

void interventionNotice(std::span<const std::string> lines, const FreeArea& free) {
  if (lines.empty()) return;
  constexpr float kAboveScaleBar = 52.0f;
  ImGui::SetNextWindowPos({free.left + 12.0f, free.below - kAboveScaleBar}, ImGuiCond_Always, {0.0f, 1.0f});
  ImGui::SetNextWindowBgAlpha(0.72f);
  if (ImGui::Begin("interventions", nullptr, kNotice | ImGuiWindowFlags_NoInputs)) {
    for (const std::string& line : lines) drawWrappedText(line, free);
  }
  notePlaceOfWindow("interventions");
  ImGui::End();
}

void rulerNotice(const Ruler& ruler, const FreeArea& free) {
  constexpr float kBesideEnd = 14.0f;
  std::string words = formatRuler(ruler);
  if (words.empty()) {
    words = tr(ruler.ends.empty() ? "Measuring: click a place on the skin" : "... and another; Esc ends it");
    ImGui::SetNextWindowPos({centreX(free), free.below - 16.0f}, ImGuiCond_Always, {0.5f, 1.0f});
  } else {
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    const float x =
        std::clamp(static_cast<float>(ruler.label.x()) + kBesideEnd, free.left, free.right - size.x - 20.0f);
    const float y = std::clamp(static_cast<float>(ruler.label.y()) + kBesideEnd, free.top, free.below - size.y - 20.0f);
    ImGui::SetNextWindowPos({x, y});
  }
  ImGui::SetNextWindowBgAlpha(0.8f);
  if (ImGui::Begin("ruler", nullptr, kNotice | ImGuiWindowFlags_NoInputs)) ImGui::TextUnformatted(words.c_str());
  ImGui::End();
}

bool dialogShown() { return ImGui::GetTopMostPopupModal() != nullptr; }

bool closeMenus() {
  const ImVector<ImGuiPopupData>& popups = ImGui::GetCurrentContext()->OpenPopupStack;
  int of_dialogs = 0;
  for (int i = 0; i < popups.Size; ++i) {
    const ImGuiWindow* window = popups[i].Window;
    if (window != nullptr && (window->Flags & ImGuiWindowFlags_Modal) != 0) of_dialogs = i + 1;
  }
  if (of_dialogs == popups.Size) return false;
  ImGui::ClosePopupToLevel(of_dialogs, true);
  return true;
}

void questionDialog(const std::optional<Question>& question, UiOutput& output) {
  constexpr const char* kName = "question";
  constexpr float kQuestionWidth = 420.0f;
  if (question && !ImGui::IsPopupOpen(kName)) ImGui::OpenPopup(kName);
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.4f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(kQuestionWidth, size.x - 20.0f), 0.0f});
  if (!ImGui::BeginPopupModal(kName, nullptr, kNotice & ~ImGuiWindowFlags_AlwaysAutoResize)) return;
  if (question) {
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(tr(question->words.c_str()));
    ImGui::PopTextWrapPos();
    const std::vector<std::string>& answers = question->answers;
    for (const std::string& answer : answers) {
      if (answer != answers.front()) ImGui::SameLine();
      const std::string path = fmt::format("question/{}", answer);
      const char* means = answer == answers.front()  ? toTranslate("Enter")
                          : answer == answers.back() ? toTranslate("Esc")
                                                     : "";
      if (buttonWidget(path.c_str(), answer.c_str(), means)) {
        output.request(AnswerQuestion{answer});
      }
    }
  } else {
    ImGui::CloseCurrentPopup();  // a popup that is only not drawn would continue to capture the mouse
  }
  ImGui::EndPopup();
}

void messageList(Messages& messages, bool& open) {
  messages.markRead();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_FirstUseEver, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(560.0f, size.x - 20.0f), std::min(320.0f, size.y - 60.0f)},
                           ImGuiCond_FirstUseEver);
  if (ImGui::Begin(tr("Messages"), &open, ImGuiWindowFlags_NoSavedSettings)) {
    if (buttonWidget("messages/copy", "Copy all")) {
      std::string all;
      for (const Message& message : messages.all()) {
        all += fmt::format("{}{}\n", severityPrefix(message.severity), message.text);
      }
      ImGui::SetClipboardText(all.c_str());
    }
    if (messages.all().empty()) remark("No messages yet.");
    for (const Message& message : messages.all()) {
      ImGui::TextColored(colourOf(message.severity), "%s  %s", trf("{:.1f} s", message.at_s).c_str(),
                         severityPrefix(message.severity).c_str());
      ImGui::SameLine(0.0f, 0.0f);
      ImGui::TextWrapped("%s", message.text.c_str());
    }
  }
  ImGui::End();
}

}  // namespace palpate::viewer

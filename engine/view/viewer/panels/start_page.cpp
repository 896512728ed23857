#include "view/viewer/panels/start_page.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "palpate/base/language.h"
#include "palpate/base/path_text.h"
#include "palpate/scene/presets.h"
#include "palpate/view/image.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

// Points.
constexpr float kMaxWidth = 1100.0f;
constexpr float kMaxHeight = 700.0f;
constexpr float kMargin = 24.0f;
constexpr float kChoices = 270.0f;  ///< width of the column of choices
constexpr float kMinForTwo = 700.0f;
constexpr float kChoiceHeight = 46.0f;
const ImVec2 kPicture(168.0f, 105.0f);  ///< half the size of tools/draw-pictures
constexpr std::size_t kRecentShown = 5;

ImDrawList& pageList() { return *ImGui::GetWindowDrawList(); }

float smaller() { return 0.87f * ImGui::GetFontSize(); }

/// Text over earlier drawing, cut at the width.
void wordsAt(const ImVec2& at, float size, ImGuiCol colour, std::string_view words, float width) {
  pageList().AddText(ImGui::GetFont(), size, at, ImGui::GetColorU32(colour), words.data(), words.data() + words.size(),
                     width);
}

struct Choice {
  const char* path;
  const char* title;
  std::string_view what;  ///< translated
  bool offered = true;
};

/// Two lines on one button. True when it was pressed.
bool choiceButton(const Choice& choice) {
  constexpr float kInset = 10.0f;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::BeginDisabled(!choice.offered);
  const bool pressed = ImGui::Button(fmt::format("##{}", choice.path).c_str(), {width, kChoiceHeight});
  ImGui::EndDisabled();
  notePlace(choice.path, std::string(choice.what));
  const ImGuiCol ink = choice.offered ? ImGuiCol_Text : ImGuiCol_TextDisabled;
  wordsAt({at.x + kInset, at.y + 5.0f}, ImGui::GetFontSize(), ink, tr(choice.title), 0.0f);
  wordsAt({at.x + kInset, at.y + 25.0f}, smaller(), ImGuiCol_TextDisabled, choice.what, 0.0f);
  return pressed;
}

/// A choice whose program may be another, still being built, or missing.
struct ActivityChoice {
  Activity activity;
  const char* path;
  const char* title;
  const char* what;
  const char* package;  ///< package that has it
};

std::string describeActivity(const ActivityChoice& choice, const ActivityState& state, bool awaited) {
  switch (state.kind) {
    case ActivityState::Kind::missing:
      return trf("Not here: install the package {}", choice.package);
    case ActivityState::Kind::being_built:
      if (state.of == 0) return tr(awaited ? "Opens when it is built" : "Being built");
      return awaited ? trf("Opens when it is built: {} of {}", state.done, state.of)
                     : trf("Being built: {} of {}", state.done, state.of);
    default:
      return tr(choice.what);
  }
}

/// True when it should open in this window. A choice that is being built can be awaited, and cancelled.
bool activityChoice(const ActivityChoice& choice, const StartPage& page, bool& open, UiOutput& output) {
  using Kind = ActivityState::Kind;
  const ActivityState& state = activityState(choice.activity, page.activities);
  const bool awaited = page.awaited == choice.activity;
  const std::string what = describeActivity(choice, state, awaited);
  const bool pressed = choiceButton({choice.path, choice.title, what, state.kind != Kind::missing});
  if (state.kind == Kind::being_built) {
    if (pressed) page.awaited = awaited ? std::nullopt : std::optional(choice.activity);
    return false;
  }
  if (!pressed && !(awaited && state.kind != Kind::missing)) return false;
  page.awaited.reset();
  open = false;
  if (state.kind == Kind::here) return true;
  output.request(GiveWay{choice.activity});
  return false;
}

void choices(const StartPage& page, bool& open, UiOutput& output) {
  if (choiceButton({"start/touch", "Touch", tr("Press the built-in back with the mouse")})) open = false;
  constexpr ActivityChoice kTrain = {Activity::training, "start/train", toTranslate("Train"),
                                     toTranslate("Find what is stiffer, and be measured"), "palpate-teach"};
  activityChoice(kTrain, page, open, output);  // always another program
  if (choiceButton({"start/open", "Open my mesh ...", tr("A scan, a scene or a recording")})) {
    output.act(window::Action::open);
    open = false;
  }
  constexpr ActivityChoice kMeasure = {Activity::measuring, "start/measure", toTranslate("Measure a person ..."),
                                       toTranslate("How far skin follows, from two photographs"), "palpate-measure"};
  if (activityChoice(kMeasure, page, open, output)) output.act(window::Action::measure_person);
  constexpr ActivityChoice kClass = {Activity::classes, "start/class", toTranslate("Class ..."),
                                     toTranslate("Teach several trainees, watch, or take part"), "palpate-class"};
  if (activityChoice(kClass, page, open, output)) output.request(ShowClass{});
}

/// A line that opens a file. True when it was pressed.
bool fileLine(const std::string& path, const std::string& file, UiOutput& output) {
  const bool chosen = ImGui::Selectable(fmt::format("{}##{}", pathOf(file).filename().string(), path).c_str());
  notePlace(path, file);
  if (chosen) output.request(OpenFile{file});
  return chosen;
}

void recentFiles(const StartPage& page, bool& open, UiOutput& output) {
  if (page.recent.empty()) return;
  ImGui::Spacing();
  ImGui::TextDisabled("%s", tr("Recent"));
  for (std::size_t i = 0; i < std::min(page.recent.size(), kRecentShown); ++i) {
    if (fileLine(fmt::format("start/recent/{}", i), page.recent[i], output)) open = false;
  }
}

/// Files in the working folder, except recent ones. Read when the page appears.
void drawFolderFiles(const StartPage& page, bool& open, UiOutput& output) {
  static std::vector<std::filesystem::path> here;  // used on the display's thread, like ImGui's own state
  if (ImGui::IsWindowAppearing()) here = newestFilesInFolder();
  bool titled = false;
  for (const std::filesystem::path& file : here) {
    if (std::ranges::find(page.recent, file.string()) != page.recent.end()) continue;
    if (!titled) {
      ImGui::Spacing();
      ImGui::TextDisabled("%s", tr("In this folder"));
      titled = true;
    }
    if (fileLine(fmt::format("start/here/{}", file.filename().string()), file.string(), output)) open = false;
  }
}

/// The picture with its words below. True when it was pressed.
bool exampleTile(const StartPage& page, const scene::Preset& preset) {
  const float line = ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size(kPicture.x, kPicture.y + line + 6.0f);
  const bool pressed = ImGui::InvisibleButton(std::string(preset.name).c_str(), size);
  notePlace(fmt::format("start/{}", preset.name), preset.what);
  const bool hovered = ImGui::IsItemHovered();
  const ImVec2 high(at.x + kPicture.x, at.y + kPicture.y);
  if (const view::GlId picture = page.pictures.of(preset.name); picture != 0) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): ImGui's own way
    pageList().AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture)), at, high);
  } else {
    pageList().AddRectFilled(at, high, ImGui::GetColorU32(ImGuiCol_FrameBg));
  }
  pageList().AddRect(at, high, ImGui::GetColorU32(hovered ? ImGuiCol_CheckMark : ImGuiCol_Border), 2.0f, 0,
                     hovered ? 2.0f : 1.0f);
  wordsAt({at.x, high.y + 2.0f}, smaller(), ImGuiCol_Text, tr(std::string(preset.title).c_str()), 0.0f);
  return pressed;
}

void examples(const StartPage& page, bool& open, UiOutput& output) {
  ImGui::TextDisabled("%s", tr("Examples"));
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const int columns = std::max(1, static_cast<int>((ImGui::GetContentRegionAvail().x + gap) / (kPicture.x + gap)));
  int column = 0;
  for (const scene::Preset& preset : scene::presets()) {
    if (column++ % columns != 0) ImGui::SameLine();
    if (!exampleTile(page, preset)) continue;
    output.request(OpenPreset{std::string(preset.name)});
    open = false;
  }
}

void heading() {
  ImGui::SetWindowFontScale(1.6f);
  ImGui::TextUnformatted("Palpate");
  ImGui::SetWindowFontScale(1.0f);
  ImGui::TextWrapped("%s", tr("Feel, see and measure touch on a soft human body."));
  ImGui::Spacing();
}

void footer(const StartPage& page, bool& open) {
  ImGui::Spacing();
  flagWidget("start/again", "show this page at start", page.shown_at_start, "File > Start page shows it at any time.");
  if (page.building) {
    ImGui::ProgressBar(static_cast<float>(page.building->done), {-1.0f, 0.0f}, tr(page.building->stage.c_str()));
  } else if (buttonWidget("start/close", "Close", "Esc")) {
    open = false;
  }
}

}  // namespace

std::string_view pictureBytes(std::string_view preset) {
  for (const view::EmbeddedFile& picture : startPictures()) {
    if (picture.name == std::string(preset) + ".jpg") return picture.bytes;
  }
  return {};
}

view::GlId ExamplePictures::of(std::string_view preset) {
  auto shown = shown_.find(preset);
  if (shown == shown_.end()) {
    const std::string_view bytes = pictureBytes(preset);
    if (bytes.empty()) return 0;
    shown = shown_.try_emplace(preset, view::decodeImage(bytes)).first;
  }
  return shown->second.texture();
}

void startPage(const StartPage& page, bool& open, UiOutput& output) {
  constexpr const char* kName = "start";
  if (!openCentredModal(kName, open)) return;
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSize({std::min(kMaxWidth, room.x - kMargin), std::min(kMaxHeight, room.y - kMargin)});
  if (!ImGui::BeginPopupModal(kName, nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove)) return;
  const bool two = ImGui::GetWindowWidth() >= kMinForTwo;
  if (ImGui::BeginChild("choices", {two ? kChoices : 0.0f, two ? 0.0f : 0.55f * ImGui::GetWindowHeight()})) {
    heading();
    choices(page, open, output);
    recentFiles(page, open, output);
    drawFolderFiles(page, open, output);
    footer(page, open);
  }
  ImGui::EndChild();
  if (two) ImGui::SameLine(0.0f, kMargin);
  if (ImGui::BeginChild("examples")) examples(page, open, output);
  ImGui::EndChild();
  if (!page.building && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) open = false;
  if (!open) {
    page.awaited.reset();  // a closed page means another choice
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace palpate::viewer

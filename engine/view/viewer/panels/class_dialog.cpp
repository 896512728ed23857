// A class from the window: run one on this computer, watch one, or take part in one. The commands of `palpate class` do
// the work (class_run.h).
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>

#include "palpate/base/language.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/process.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr double kMaxStations = 30.0;  ///< more are made by `palpate class init`

/// The typed text; stays while the window is open.
struct ClassFields {
  StartClass start;
  double stations = 2.0;
  std::string watched;
  std::string station;
  std::string offered_of;  ///< the class whose first station is in the line
};

std::filesystem::path inFolder(const std::filesystem::path& folder, const std::string& typed) {
  return typed.empty() ? std::filesystem::path() : folder / pathOf(typed);  // a full path stays one
}

bool textLine(const char* path, const char* label, std::string& text) {
  ImGui::SetNextItemWidth(-150.0f);
  const bool entered = ImGui::InputText(tr(label), &text, ImGuiInputTextFlags_EnterReturnsTrue);
  notePlace(path);
  return entered;
}

/// The reason why the class cannot be started with this input; empty: it can.
std::string findInputFault(const ClassFields& fields, bool exists) {
  if (fields.start.folder.empty()) return tr("Type a folder");
  if (exists) return {};
  if (fields.start.name.empty()) return tr("Type a name for the class");
  if (fields.start.computer.empty()) return tr("Type this computer's name or address");
  return {};
}

void runPart(const ClassShown& shown, const std::filesystem::path& folder, ClassFields& fields, UiOutput& output) {
  ImGui::TextDisabled("%s", tr("Teach on this computer"));
  if (shown.runs) {
    ImGui::TextWrapped("%s", trf("{} runs. {}", shown.folder, shown.words).c_str());
    remark(trf("Give each station its folder of {}/stations; there: start page > Class > Take part.", shown.folder));
    if (buttonWidget("class/end", "End the class")) output.request(EndClass{});
    return;
  }
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  bool starts = textLine("class/folder", "folder", fields.start.folder);
  const std::filesystem::path whole = inFolder(folder, fields.start.folder);
  std::error_code ignored;
  const bool exists = !whole.empty() && std::filesystem::exists(whole / "class.toml", ignored);
  ImGui::BeginDisabled(exists);
  starts = textLine("class/name", "name of the class", fields.start.name) || starts;
  starts = textLine("class/computer", "this computer", fields.start.computer) || starts;
  numberWidget(fields.stations, {"class/stations", "stations", "%.0f", 1.0, kMaxStations, 2.0,
                                 "How many trainees can take part at once; more can be added later."});
  ImGui::EndDisabled();
  const std::string fault = findInputFault(fields, exists);
  ImGui::BeginDisabled(!fault.empty());
  starts = buttonWidget("class/start", exists ? "Start this class again" : "Make and start the class") || starts;
  ImGui::EndDisabled();
  if (!fault.empty()) remark(fault);
  if (!starts || !fault.empty()) return;
  StartClass request = fields.start;
  request.folder = whole.string();
  request.stations = static_cast<int>(fields.stations);
  output.request(request);
}

void watchPart(const ClassShown& shown, const std::filesystem::path& folder, ClassFields& fields, UiOutput& output) {
  ImGui::TextDisabled("%s", tr("Watch a class"));
  if (fields.watched.empty()) fields.watched = shown.folder;
  const bool entered = textLine("class/watched", "class or instructor", fields.watched);
  ImGui::BeginDisabled(shown.watched || fields.watched.empty());
  const bool pressed = buttonWidget("class/watch", shown.watched ? "It is open" : "Open the teacher's window");
  ImGui::EndDisabled();
  if (entered || pressed) output.request(WatchClass{inFolder(folder, fields.watched).string()});
}

void joinPart(const ClassShown& shown, const std::filesystem::path& folder, ClassFields& fields, UiOutput& output) {
  ImGui::TextDisabled("%s", tr("Take part at this computer"));
  if (shown.runs && fields.offered_of != shown.folder) {  // once: typed text stays
    fields.offered_of = shown.folder;
    fields.station = shown.folder + "/stations/s01";
  }
  const bool entered = textLine("class/station", "folder of the station", fields.station);
  ImGui::BeginDisabled(shown.joined || fields.station.empty());
  const bool pressed = buttonWidget("class/join", shown.joined ? "It is open" : "Open the training");
  ImGui::EndDisabled();
  if (entered || pressed) output.request(JoinClass{inFolder(folder, fields.station).string()});
}

}  // namespace

void classDialog(const ClassShown& shown, const std::filesystem::path& folder, bool& open, UiOutput& output) {
  static ClassFields fields{{"class", "class-1", 2, system::identity().computer}, 2.0, {}, {}, {}};
  if (!beginDialog("A class", open)) return;
  if (shown.offered) {
    runPart(shown, folder, fields, output);
    ImGui::Separator();
    watchPart(shown, folder, fields, output);
    ImGui::Separator();
    joinPart(shown, folder, fields, output);
    ImGui::Separator();
  } else {
    remark("Classes are not installed here: the program palpate-class is missing.");
  }
  if (!shown.trouble.empty()) {
    ImGui::PushTextWrapPos(0.0f);
    drawSeverityText(Severity::warning, shown.trouble);
    ImGui::PopTextWrapPos();
  }
  if (!shown.folder.empty() && !shown.runs && shown.trouble.empty()) remark("Making the class ...");
  if (buttonWidget("class/close", "Close", "Esc")) open = false;
  ImGui::SameLine();
  remark(trf("Step by step in the manual: {}.", tr("Run a class over the network")));
  endDialog(open);
}

}  // namespace palpate::viewer

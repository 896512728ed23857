// Files written during palpation: forces, pictures, the scene.
#include <fmt/format.h>

#include "palpate/base/language.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

std::string recordingStatus(const Recording& recording, double now_s) {
  std::string words;
  if (recording.forces) {
    const int seconds = static_cast<int>(now_s - recording.since_s);
    words = trf("recording {}:{:02}", seconds / 60, seconds % 60);
  }
  if (recording.sequence) {
    words = words.empty() ? trf("recording {} pictures", recording.pictures)
                          : trf("{}, {} pictures", words, recording.pictures);
  }
  if (recording.film) {
    const int seconds = static_cast<int>(now_s - recording.film_since_s);
    words += fmt::format("{}{}", words.empty() ? "" : ", ", trf("filming {}:{:02}", seconds / 60, seconds % 60));
  }
  return words;
}

namespace {

/// Controls of the automatic recording.
void sessionPart(const Recording& recording, bool& keeps_last_hour, UiOutput& output) {
  flagWidget("record/session", "Record the last hour automatically", keeps_last_hour,
             "Record every tick of both fingers in a file that stays readable after a crash.");
  if (!recording.viewer) return;
  const int seconds = static_cast<int>(recording.length_s);
  const std::string recorded = trf("{}:{:02} recorded", seconds / 60, seconds % 60);
  remark(recording.dropped == 0 ? recorded : trf("{}, {} samples missing", recorded, recording.dropped));
  if (buttonWidget("record/keep", recording.keeping ? "Keeping ..." : "Keep the recording (Shift+R)",
                   "Copy the last hour to a recording file, to replay it, verify it or send it with a bug report.")) {
    output.request(KeepRecording{});
  }
  if (buttonWidget("record/mark", "Set a mark (Shift+M)", "Mark this moment in the recording, to find it again.")) {
    output.request(SetMark{});
  }
  if (!recording.kept_file.empty() &&
      buttonWidget("record/play", "Show the kept recording", "Play it on the body it was felt on; Space ends it.")) {
    output.request(OpenFile{recording.kept_file});
  }
}

}  // namespace

void recordPanel(const Recording& recording, bool& keeps_last_hour, double now_s, UiOutput& output) {
  sessionPart(recording, keeps_last_hour, output);
  if (buttonWidget("record/forces", recording.forces ? "Stop recording (R)" : "Record forces (R)",
                   "Record every finger in every tick as a CSV table.")) {
    output.request(ToggleForces{});
  }
  if (recording.forces) {
    remark(trf("{:.1f} s into {}", now_s - recording.since_s, recording.forces_file));
  }
  if (!recording.forces && !recording.forces_file.empty() &&
      buttonWidget(
          "record/replay", "Replay what was recorded",
          "Press the same places again and step through tick by tick. Open other tables, or drop them here.")) {
    output.request(OpenFile{recording.forces_file});
  }
  if (buttonWidget("record/sequence", recording.sequence ? "Stop the pictures" : "Record pictures",
                   "Save every frame as a PNG file in a new folder.")) {
    output.request(ToggleSequence{});
  }
  if (recording.sequence) remark(trf("{} pictures in {}", recording.pictures, recording.sequence_folder));
  if (buttonWidget("record/picture", "Save a picture (F12)")) output.request(TakeScreenshot{});
  if (buttonWidget("record/clear_picture", "... without background (Ctrl+F12)",
                   "The body alone; the rest of the PNG file is transparent.")) {
    output.request(TakeClearScreenshot{});
  }
  if (buttonWidget("record/csv", "Save the plots as CSV")) output.request(SavePlots{});
  if (buttonWidget("record/scene", "Save the scene (Ctrl+S)")) output.request(SaveScene{});
  if (buttonWidget("record/copy_scene", "Copy as a scene (Ctrl+C)",
                   "Copy what you see and feel now as the text of a scene file, for emails, notes and bug reports.")) {
    output.act(window::Action::copy_scene);
  }
}

}  // namespace palpate::viewer

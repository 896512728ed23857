// The window's automatic recording: the last hour of every finger, in a file that stays readable after a crash.
//
//   servo ─► engine::Recorder ─► FOLDER/2026-11-21T23-05-12.session ─ Shift+R ─► a copy among the user's files
//
// A run without a touch leaves nothing. The next run finishes the file of one that was killed.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/engine/recorder.h"
#include "view/viewer/state/async_task.h"
#include "view/viewer/state/viewer_state.h"
#include "view/viewer/world/live_servo.h"

namespace palpate::viewer {

/// Folder of automatic recordings: $XDG_STATE_HOME/palpate/sessions or ~/.local/state/...; empty without a home.
std::filesystem::path recordingsFolder();

/// Kept length of a run, s, and number of runs.
inline constexpr double kLastHourS = 3600.0;
inline constexpr std::size_t kKeptRuns = 10;

/// Finishes the recordings in the folder that are no longer written (their program was killed), and removes all but the
/// newest. Returns the finished ones.
std::vector<std::filesystem::path> tidySessions(const std::filesystem::path& folder);

class RecordingKeeper {
 public:
  /// An empty folder: nothing is recorded. Servo and user must outlive it.
  RecordingKeeper(LiveServo& servo, std::filesystem::path folder, Conversation& user);

  /// Once a frame: begins and ends with the recording's switch, notes who holds the fingers, reports failures.
  void advance(bool switched_on, const std::string& title, const DevicesShown& devices);
  /// Copies the last hour to a fresh name in the folder.
  void save(const std::filesystem::path& folder);
  void mark(std::string words);
  /// Attaches a saved picture at the newest tick.
  void attachPicture(const std::filesystem::path& file);
  /// Call when the run is over and the servo has stopped.
  void finish(std::string_view ended_by);

 private:
  void begin(const std::string& title, const DevicesShown& devices);
  void followDevices(const DevicesShown& devices);

  LiveServo& servo_;
  std::filesystem::path folder_;
  Conversation& user_;
  std::unique_ptr<engine::Recorder> recorder_;
  bool failed_ = false;  ///< until it is switched off and on again
  std::array<std::string, kFingers> held_by_;
  AsyncTask<std::vector<std::filesystem::path>> tidying_;
};

}  // namespace palpate::viewer

#include "view/viewer/files/recording_keeper.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/base/output_file.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/process.h"
#include "palpate/base/text.h"
#include "palpate/device/back_ends.h"
#include "view/viewer/files/outputs.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExtension = ".session";

/// A live file changes every 150 ms; one that has not for so long has lost its program.
constexpr std::chrono::seconds kAbandoned{10};

bool isAbandoned(const fs::path& file) {
  std::error_code error;
  auto newest = fs::last_write_time(file, error);
  if (error) return false;
  const auto log = fs::last_write_time(withEnding(file, "-wal"), error);
  if (!error) newest = std::max(newest, log);
  return fs::file_time_type::clock::now() - newest > kAbandoned;
}

void removeSession(const fs::path& file) {
  std::error_code ignored;
  for (const char* companion : {"", "-wal", "-shm"}) fs::remove(withEnding(file, companion), ignored);
}

/// 2026-11-21T23-05-12: names sort as times do.
std::string nameNow() {
  std::string name = trace::utcNow();
  std::replace(name.begin(), name.end(), ':', '-');
  return name.substr(0, name.size() - 1);
}

}  // namespace

fs::path recordingsFolder() {
  const fs::path state = system::stateFolder();
  return state.empty() ? fs::path() : state / "palpate" / "sessions";
}

std::vector<fs::path> tidySessions(const fs::path& folder) {
  std::vector<fs::path> finished;
  std::vector<fs::path> all;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& file = entry.path();
    const std::string name = file.filename().string();
    const std::size_t stem = name.find(kExtension);
    if (stem == std::string::npos) continue;
    if (name.ends_with(kExtension)) all.push_back(file);
    if (!name.ends_with(kPartialExtension) || !isAbandoned(file)) continue;
    fs::path target = folder / pathOf(name.substr(0, stem) + std::string(kExtension));
    if (fs::exists(target)) target = freshFile(folder, name.substr(0, stem), std::string(kExtension));
    try {
      trace::copyRecording(file, target, "interrupted");
      removeSession(file);
      finished.push_back(target);
      all.push_back(target);
    } catch (const Error&) {
      // It stays, for `palpate body repair`.
    }
  }
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i + kKeptRuns < all.size(); ++i) removeSession(all[i]);
  return finished;
}

RecordingKeeper::RecordingKeeper(LiveServo& servo, fs::path folder, Conversation& user)
    : servo_(servo), folder_(std::move(folder)), user_(user) {
  if (!folder_.empty()) tidying_.start([folder = folder_] { return tidySessions(folder); });
}

void RecordingKeeper::begin(const std::string& title, const DevicesShown& devices) {
  std::vector<trace::RecordingFinger> fingers;
  for (std::size_t i = 0; i < kFingers; ++i) {
    held_by_[i] = devices.fingers[i].words;
    std::string name(kFingerNames[i]);
    if (servo_.isHeld(i)) {
      fingers.push_back(engine::recordingFinger(std::move(name), servo_.device(i), &servo_.opened(i).workspace.frame));
    } else {
      fingers.push_back({std::move(name), "mouse"});
    }
  }
  engine::RecorderSettings settings;
  settings.header = engine::recordingHeader(servo_.thread().ticksPerS());
  settings.header.notes = title;
  settings.fingers = std::move(fingers);
  settings.keep_s = kLastHourS;
  try {
    fs::create_directories(folder_);
    settings.file = freshFile(folder_, nameNow(), std::string(kExtension));
    recorder_ = std::make_unique<engine::Recorder>(servo_.thread(), std::move(settings));
  } catch (const std::exception& error) {
    failed_ = true;
    user_.report(Severity::warning, trf("The last hour is not recorded: {}", error.what()));
  }
}

void RecordingKeeper::finish(std::string_view ended_by) {
  if (!recorder_) return;
  user_.recording.viewer = false;
  try {
    recorder_->anyTouch() ? recorder_->finish(ended_by) : recorder_->discard();
  } catch (const std::exception& error) {
    user_.report(Severity::error, trf("The recording ended: {}; what was written is kept in {}", error.what(),
                                      recorder_->partial().string()));
  }
  recorder_.reset();
}

void RecordingKeeper::advance(bool switched_on, const std::string& title, const DevicesShown& devices) {
  if (const auto finished = tidying_.collectResult(); finished && finished->value) {
    for (const fs::path& file : *finished->value) {
      user_.messages.note(trf("An interrupted run was saved as {} (File > Open)", file.string()), user_.now_s);
    }
  }
  const bool wanted = !folder_.empty() && switched_on;
  if (!wanted) {
    failed_ = false;
    return finish("switched off");
  }
  if (!recorder_ && !failed_) begin(title, devices);
  if (!recorder_) return;
  followDevices(devices);
  const engine::RecorderState state = recorder_->state();
  Recording& recording = user_.recording;
  recording.viewer = true;
  recording.length_s = state.seconds;
  if (state.dropped > std::exchange(recording.dropped, state.dropped)) {
    user_.report(Severity::warning,
                 trf("The disk is too slow: {} samples are missing in the recording", state.dropped));
  }
  if (const auto kept = recorder_->collectSaved()) {
    recording.keeping = false;
    if (kept->failure.empty()) {
      recording.kept_file = kept->file.string();
      user_.report(Severity::info, trf("The last {:.1f} s are saved as {}", kept->seconds, recording.kept_file));
    } else {
      user_.report(Severity::error, trf("The recording could not be saved: {}", kept->failure));
    }
  }
  if (state.failure.empty()) return;
  failed_ = true;
  finish({});
}

void RecordingKeeper::followDevices(const DevicesShown& devices) {
  for (std::size_t i = 0; i < kFingers; ++i) {
    const std::string& now = devices.fingers[i].words;
    if (std::exchange(held_by_[i], now) == now) continue;
    const std::string words = now.empty() ? "the mouse" : device::describe(servo_.opened(i).device);
    recorder_->event("device", fmt::format("held by {}", words), static_cast<std::uint32_t>(i));
  }
}

void RecordingKeeper::save(const fs::path& folder) {
  if (!recorder_) {
    return user_.report(Severity::warning, "Automatic recording is off: switch it on under Record");
  }
  if (!recorder_->save(freshFile(folder, "session-" + nameNow(), std::string(kExtension)))) return;
  user_.recording.keeping = true;
}

void RecordingKeeper::mark(std::string words) {
  if (!recorder_) {
    return user_.report(Severity::warning, "Automatic recording is off, so there is nothing to mark");
  }
  if (words.empty()) words = fmt::format("mark {}", user_.recording.marks + 1);
  ++user_.recording.marks;
  user_.report(Severity::info, trf("Marked: {}", words));
  recorder_->mark(std::move(words));
}

void RecordingKeeper::attachPicture(const fs::path& file) {
  constexpr std::size_t kMaxPictureBytes = std::size_t{1} << 26;
  if (!recorder_) return;
  try {
    recorder_->attach({0, "picture", file.filename().string(), "image/png", readFile(file, kMaxPictureBytes)});
  } catch (const Error&) {
    // It was saved, or its own message has the reason.
  }
}

}  // namespace palpate::viewer

// What the viewer writes while it runs: forces, pictures, plots, the scene. Every success and failure becomes a
// message.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "palpate/trace/forces_csv.h"
#include "palpate/view/image.h"
#include "view/viewer/files/film_recorder.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

// Files written while one palpates: the forces of every tick, and frames as PNG files.
//
// Pictures are compressed and written by a thread of their own; the display waits only when it is many pictures ahead,
// the servo never.

class ForceRecorder {
 public:
  /// Throws Error when the file cannot be written.
  void start(const std::filesystem::path& file, double ticks_per_s);
  /// A finger that is nowhere is left out. Throws Error when the disk is full or gone.
  void add(const trace::Sample& sample);
  /// The file is complete. Throws Error when it cannot be: then `abandon` it.
  void stop();
  /// Ends without completing the file; where its rows are, or empty when there are none.
  std::string abandon();
  bool running() const { return writer_ != nullptr; }

 private:
  std::unique_ptr<trace::ForcesCsvWriter> writer_;
  std::optional<std::uint64_t> first_tick_;
};

class PictureWriter {
 public:
  PictureWriter();
  /// Finishes what is waiting.
  ~PictureWriter();

  void write(std::filesystem::path file, view::Image image);
  /// What went wrong since the last call, or empty.
  std::string takeError();
  void finish();

 private:
  struct Job {
    std::filesystem::path file;
    view::Image image;
  };
  void run();

  std::mutex mutex_;
  std::condition_variable change_;
  std::deque<Job> jobs_;
  bool working_ = false;
  bool quit_ = false;
  std::string error_;
  std::thread thread_;
};

/// A file that does not exist yet: "palpate.png", "palpate-2.png", ... in a folder that is made when it is first
/// needed; that it cannot be is told by the writing.
std::filesystem::path freshFile(const std::filesystem::path& folder, const std::string& stem, const std::string& kind);

class Outputs {
 public:
  explicit Outputs(const std::filesystem::path& folder)
      : folder_(std::filesystem::absolute(folder).lexically_normal()) {}
  ~Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  /// Into the recording that runs, if any. A disk that is full or gone ends it, with what was recorded kept.
  void addSample(ViewerState& viewer, const trace::Sample& sample);
  void toggleForces(ViewerState& viewer);
  void toggleSequence(ViewerState& viewer);
  void savePlots(ViewerState& viewer);
  enum class Saving : std::uint8_t { done, asked, failed };
  /// To the request's file, else to where the scene came from, else to a fresh name in the folder. Asks before it
  /// writes over what this window has neither read nor written, unless the request is sure.
  Saving saveScene(ViewerState& viewer, const SaveScene& request);
  /// Writes the drawn displacement profile to a file and has the scene use it.
  void useProfile(ViewerState& viewer);
  void askForScreenshot(TakeScreenshot request) { screenshot_ = std::move(request); }
  /// Throws nothing: what goes wrong becomes a message. Does not wait for the disk.
  void startFilm(ViewerState& viewer, const std::string& file);
  void stopFilm(ViewerState& viewer);
  /// The body alone, without a background.
  void askForClearPicture() { clear_picture_ = true; }
  /// It was asked for in this frame; once.
  bool takeClearPicture() { return std::exchange(clear_picture_, false); }
  /// The picture of this frame is kept, and pop-ups are no part of it. Pictures of a sequence never have them.
  bool wantsNoPopUps(const ViewerState& viewer) const {
    if (screenshot_) return !screenshot_->with_pop_ups;
    return viewer.recording.sequence || film_.wants(viewer.now_s);
  }
  /// The picture of this frame is kept.
  bool wantsFrame(const ViewerState& viewer) const {
    return screenshot_ || viewer.recording.sequence || film_.wants(viewer.now_s);
  }
  /// The picture that was saved since the last call, or empty.
  std::filesystem::path takeSavedPicture() { return std::exchange(saved_picture_, {}); }
  void saveClearPicture(ViewerState& viewer, const view::CutOut& picture);
  const std::filesystem::path& folder() const { return folder_; }

  /// A frame has been drawn; `read` fetches it when somebody wants it.
  template <class Read>
  void frameDrawn(ViewerState& viewer, const Read& read) {
    if (wantsFrame(viewer)) keepFrame(viewer, read());
    followFilm(viewer);
    tellErrors(viewer);
  }

  /// A changed scene that nobody could be asked about goes beside the one it came from, to a fresh name
  /// (scene-backup.toml): which, or empty when nothing was changed. Throws Error.
  std::filesystem::path keepChanges(const ViewerState& viewer) const;

  /// Completes what is being recorded.
  void finish(ViewerState& viewer);

 private:
  void endBrokenForces(ViewerState& viewer, const std::string& why);
  void keepFrame(ViewerState& viewer, view::Image image);
  void tellErrors(ViewerState& viewer);
  void followFilm(ViewerState& viewer);

  std::filesystem::path folder_;
  ForceRecorder forces_;
  PictureWriter pictures_;
  std::filesystem::path saved_picture_;
  FilmRecorder film_;
  std::optional<TakeScreenshot> screenshot_;  // is taken of the next frame
  bool clear_picture_ = false;
};

}  // namespace palpate::viewer

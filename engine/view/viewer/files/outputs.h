// Files that the viewer writes while it runs: forces, pictures, plots, the scene. Every success and failure becomes a
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

/// A table of the forces of every tick.
class ForceRecorder {
 public:
  /// Throws Error when the file cannot be written.
  void start(const std::filesystem::path& file, double ticks_per_s);
  /// Leaves out a finger that is nowhere. Throws Error when the disk is full or gone.
  void add(const trace::Sample& sample);
  /// Completes the file. Throws Error when it cannot: then `abandon` it.
  void stop();
  /// Ends without completing the file; returns the file with its rows, or empty without any.
  std::string abandon();
  bool running() const { return writer_ != nullptr; }

 private:
  std::unique_ptr<trace::ForcesCsvWriter> writer_;
  std::optional<std::uint64_t> first_tick_;
};

/// Pictures are compressed and written on a thread of their own; the display waits only when it is many pictures ahead,
/// the servo never.
class PictureWriter {
 public:
  PictureWriter();
  /// Finishes the waiting pictures.
  ~PictureWriter();

  void write(std::filesystem::path file, view::Image image);
  /// The failure since the last call, or empty.
  std::string popError();
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

/// A name of a new file: "palpate.png", "palpate-2.png", ... in a folder that is made when first needed; if it cannot
/// be, writing fails.
std::filesystem::path freshFile(const std::filesystem::path& folder, const std::string& stem, const std::string& kind);

class Outputs {
 public:
  /// The user must outlive it.
  Outputs(const std::filesystem::path& folder, Conversation& user)
      : folder_(std::filesystem::absolute(folder).lexically_normal()), user_(user) {}
  ~Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  /// Adds to the running recording, if any. A full or missing disk ends it, and keeps the ticks so far.
  void addSample(const trace::Sample& sample);
  void toggleForces(double ticks_per_s);
  void toggleSequence();
  void savePlots(const Plots& plots);
  enum class Saving : std::uint8_t { done, asked, failed };
  /// Saves to the request's file, else to the scene's own, else to a fresh name in the folder. Asks before it
  /// overwrites a file that this window has neither read nor written, unless the request is sure.
  Saving saveScene(const SaveScene& request, EditedScene& edited, BodyView& seen);
  /// Writes the drawn displacement profile to a file and has the scene use it.
  void useProfile(EditedScene& edited);
  void askForScreenshot(TakeScreenshot request) { screenshot_ = std::move(request); }
  /// Never throws: a failure becomes a message. Does not wait for the disk.
  void startFilm(const std::string& file);
  void stopFilm();
  /// The body alone, without a background.
  void askForClearPicture() { clear_picture_ = true; }
  /// Whether it was requested in this frame; resets the request.
  bool popClearPictureRequest() { return std::exchange(clear_picture_, false); }
  /// Whether the picture of this frame is saved without pop-ups. Pictures of a sequence never have them.
  bool wantsNoPopUps() const {
    if (screenshot_) return !screenshot_->with_pop_ups;
    return user_.recording.sequence || film_.wants(user_.now_s);
  }
  /// Whether the picture of this frame is saved.
  bool wantsFrame() const { return screenshot_ || user_.recording.sequence || film_.wants(user_.now_s); }
  /// The picture saved since the last call, or empty.
  std::filesystem::path popSavedPicture() { return std::exchange(saved_picture_, {}); }
  void saveClearPicture(const view::CutOut& picture);
  const std::filesystem::path& folder() const { return folder_; }

  /// Call after a frame was drawn; `read` fetches it if it is needed.
  template <class Read>
  void frameDrawn(const Read& read) {
    if (wantsFrame()) saveFrame(read());
    followFilm();
    reportErrors();
  }

  /// Saves a changed scene without a question next to its source, under a fresh name (scene-backup.toml). Returns the
  /// file, or empty without changes. Throws Error.
  std::filesystem::path saveBackup(const EditedScene& edited, const BodyView& seen) const;

  /// Completes the running recordings.
  void finish();

 private:
  void stopForces();
  void endBrokenForces(const std::string& why);
  void saveFrame(view::Image image);
  void reportErrors();
  void followFilm();

  std::filesystem::path folder_;
  Conversation& user_;
  ForceRecorder forces_;
  PictureWriter pictures_;
  std::filesystem::path saved_picture_;
  FilmRecorder film_;
  std::optional<TakeScreenshot> screenshot_;  // taken of the next frame
  bool clear_picture_ = false;
};

}  // namespace palpate::viewer

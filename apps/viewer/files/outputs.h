// What the viewer writes while it runs: forces, pictures, plots, the scene. Every success and failure becomes a
// message.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "apps/viewer/session.h"
#include "palpate/trace/forces_csv.h"
#include "palpate/view/image.h"

namespace palpate::viewer {

// Files written while one palpates: the forces of every tick, and frames as PNG files.
//
// Pictures are compressed and written by a thread of their own; the display waits only when it is many pictures ahead,
// the servo never.

/// A file that does not exist yet: "palpate.png", "palpate-2.png", ... in the folder.
std::filesystem::path freshName(const std::filesystem::path& folder, const std::string& stem, const std::string& kind);

class ForceRecorder {
 public:
  /// Throws Error when the file cannot be written.
  void start(const std::filesystem::path& file, double ticks_per_s);
  void add(const trace::Sample& sample);
  /// The file is complete. Throws Error when it cannot be.
  void stop();
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
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

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

class Outputs {
 public:
  explicit Outputs(std::filesystem::path folder) : folder_(std::move(folder)) {}
  ~Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  void addSample(const trace::Sample& sample) { forces_.add(sample); }
  void toggleForces(Session& session);
  void toggleSequence(Session& session);
  void savePlots(Session& session);
  /// To `file`, else to where the scene came from, else to a fresh name in the folder.
  void saveScene(Session& session, const std::string& file);
  /// Writes the drawn displacement profile to a file and has the scene use it.
  void useProfile(Session& session);
  void askForScreenshot() { screenshot_ = true; }

  /// A frame has been drawn; `read` fetches it when somebody wants it.
  template <class Read>
  void frameDrawn(Session& session, const Read& read) {
    if (screenshot_ || session.recording.sequence) keepFrame(session, read());
    tellErrors(session);
  }

  /// Completes what is being recorded.
  void finish(Session& session);

 private:
  void keepFrame(Session& session, view::Image image);
  void tellErrors(Session& session);

  std::filesystem::path folder_;
  ForceRecorder forces_;
  PictureWriter pictures_;
  bool screenshot_ = false;
};

}  // namespace palpate::viewer

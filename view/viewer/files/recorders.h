// Files written while one palpates: the forces of every tick, and frames as PNG files.
//
// Pictures are compressed and written by a thread of their own; the display waits only when it is many pictures ahead,
// the servo never.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "palpate/trace/forces_csv.h"
#include "palpate/view/image.h"

namespace palpate::viewer {

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

}  // namespace palpate::viewer

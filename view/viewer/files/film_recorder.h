// A film of the window: pictures at a fixed rate, compressed and written by a thread of their own. The display never
// waits: where the thread is too slow, pictures are left out, and the film keeps its time.
//
//   frame ─► wants, add ─► a few waiting pictures ─► thread: film::Film ─► file, whole at its end
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "palpate/view/image.h"

namespace palpate::viewer {

inline constexpr double kFilmFramesPerS = 20.0;

class FilmRecorder {
 public:
  FilmRecorder() = default;
  /// A film that was not stopped is finished.
  ~FilmRecorder();

  /// Waits for the end of an earlier one. The file is made with the first picture, which says how large all are.
  void start(std::filesystem::path file);
  /// A picture is due.
  bool wants(double now_s) const { return filming_ && now_s >= next_s_; }
  /// One of another size, because the window was resized, is cut or gets a black edge.
  void add(const view::Image& picture, double now_s);
  /// The thread finishes what waits.
  void stop();
  /// For the thread; after `stop`.
  void wait();

  struct Ending {
    std::filesystem::path file;
    std::string trouble;  ///< empty: it is whole
  };
  /// Once, when the film has ended, by `stop` or by what went wrong.
  std::optional<Ending> takeEnding();

 private:
  struct Waiting {
    view::Image picture;
    double at_s;
  };
  void run(const std::filesystem::path& file, view::ImageSize size);

  // Of the display's thread.
  bool filming_ = false;
  double next_s_ = 0.0;
  std::filesystem::path file_;
  view::ImageSize size_;
  std::thread thread_;

  std::mutex mutex_;
  std::condition_variable change_;
  std::deque<Waiting> waiting_;
  bool stopped_ = false;
  std::optional<Ending> ending_;
};

}  // namespace palpate::viewer

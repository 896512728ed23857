// A film of the window: pictures at a fixed rate, compressed and written on a thread of their own. The display never
// waits: if the thread is too slow, pictures are left out, and the film keeps its time.
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
  /// Finishes a film that was not stopped.
  ~FilmRecorder();

  /// Waits for the end of an earlier one. The first picture creates the file, and sets the size of all.
  void start(std::filesystem::path file);
  /// Whether a picture is due.
  bool wants(double now_s) const { return filming_ && now_s >= next_s_; }
  /// A picture of another size, because the window was resized, is cropped or gets a black edge.
  void add(const view::Image& picture, double now_s);
  /// The thread finishes the waiting pictures.
  void stop();
  /// Waits for the thread; after `stop`.
  void wait();

  struct Ending {
    std::filesystem::path file;
    std::string trouble;  ///< empty: it is whole
  };
  /// Returns the ending once, after `stop` or a failure.
  std::optional<Ending> popEnding();

 private:
  struct Waiting {
    view::Image picture;
    double at_s;
  };
  void run(const std::filesystem::path& file, view::ImageSize size);

  // Used on the display's thread.
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

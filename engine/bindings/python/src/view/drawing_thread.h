// The one thread that draws: it owns the OpenGL context, so that any thread of Python may request pictures.
//
//   any thread ─ PictureJob ─► DrawingThread [ context, painter of the newest world, target ] ─► TakenPicture
//
// Started by the first picture, ended by `close`. A process forked from one that has drawn has neither the thread nor
// the driver's own ones: it gets an error instead of waiting for them.
#pragma once

#include <sys/types.h>

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "palpate/view/picture.h"

namespace palpate::python {

/// The inputs of a picture; may outlive the call that requested it.
struct PictureJob {
  std::shared_ptr<const scene::World> world;
  deform::DeformedSurface surface;
  std::vector<view::FingerMark> fingers;
  double lift_mm = 0.0;
  view::PictureSettings settings;
  view::PictureSize size;
};

class DrawingThread {
 public:
  DrawingThread();
  /// Ends the thread after the current picture; waiting ones are dropped.
  ~DrawingThread();
  DrawingThread(const DrawingThread&) = delete;
  DrawingThread& operator=(const DrawingThread&) = delete;

  /// Any thread. The future throws Error where nothing can be drawn.
  std::future<view::TakenPicture> draw(std::shared_ptr<const PictureJob> job);
  /// This process is not the one that started it.
  bool isOfAnotherProcess() const;

 private:
  struct Studio;
  using Work = std::packaged_task<view::TakenPicture(Studio&)>;
  void run();

  const pid_t process_;
  std::mutex mutex_;
  std::condition_variable more_;
  std::deque<Work> waiting_;  // with the mutex, like what follows
  bool ends_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace palpate::python

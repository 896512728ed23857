#include "drawing_thread.h"

#include <unistd.h>

#include <optional>
#include <utility>

#include "palpate/view/offscreen.h"
#include "palpate/view/painter.h"

namespace palpate::python {

/// Lives on the drawing thread. After a failure (no driver) the next picture tries again.
struct DrawingThread::Studio {
  std::optional<view::OffscreenContext> context;
  std::unique_ptr<view::Painter> painter;
  std::shared_ptr<const scene::World> world;  ///< the painter's world
  std::unique_ptr<view::Target> target;
  double time_s = 0.0;

  void show(const std::shared_ptr<const scene::World>& wanted) {
    if (!context) context.emplace();
    if (!painter) {
      painter = std::make_unique<view::Painter>(wanted);
    } else if (world != wanted) {
      painter->setWorld(wanted);
    }
    world = wanted;
  }

  void makeRoom(int width, int height) {
    if (target && target->width() == width && target->height() == height) return;
    target.reset();
    target = std::make_unique<view::Target>(width, height);
  }

  view::TakenPicture capture(const PictureJob& job) {
    show(job.world);
    const view::PictureSize& size = job.size;
    makeRoom(size.width * size.supersampling, size.height * size.supersampling);
    view::Canvas canvas;
    canvas.framebuffer = target->framebuffer();
    canvas.width = target->width();
    canvas.height = target->height();
    canvas.supersampling = size.supersampling;
    canvas.pixels_per_point = size.supersampling;
    painter->renderer().updateAll(job.surface);
    time_s -= 1.0;  // time that goes back makes the skin forget where it was pressed in earlier pictures
    const view::Frame frame{.fingers = job.fingers, .time_s = time_s, .lift_mm = job.lift_mm};
    view::Painted painted = painter->paint(frame, job.surface, job.settings, canvas);
    const view::Image image = target->read();
    return {size.supersampling == 1 ? image : view::reduced(image, size.supersampling), std::move(painted.notes),
            view::rendererName()};
  }
};

DrawingThread::DrawingThread() : process_(::getpid()), thread_([this] { run(); }) {}

DrawingThread::~DrawingThread() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    waiting_.clear();  // waiting callers get a broken promise
  }
  more_.notify_one();
  thread_.join();
}

bool DrawingThread::isOfAnotherProcess() const { return ::getpid() != process_; }

std::future<view::TakenPicture> DrawingThread::draw(std::shared_ptr<const PictureJob> job) {
  Work work([job = std::move(job)](Studio& studio) { return studio.capture(*job); });
  std::future<view::TakenPicture> picture = work.get_future();
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(work));
  }
  more_.notify_one();
  return picture;
}

void DrawingThread::run() {
  Studio studio;
  for (;;) {
    std::unique_lock lock(mutex_);
    more_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
    if (ends_) return;
    Work work = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    work(studio);
  }
}

}  // namespace palpate::python

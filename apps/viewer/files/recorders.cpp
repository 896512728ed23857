#include "apps/viewer/files/recorders.h"

#include <utility>

#include "palpate/base/background.h"
#include "palpate/view/image.h"

namespace palpate::viewer {

namespace {

/// Pictures that may wait; a picture of 1280 x 800 takes 3 MB.
constexpr std::size_t kMostWaiting = 16;

}  // namespace

void ForceRecorder::start(const std::filesystem::path& file, double ticks_per_s) {
  trace::ForcesCsvSettings settings;
  settings.finger_names = {"left", "right"};
  settings.ticks_per_s = ticks_per_s;
  writer_ = std::make_unique<trace::ForcesCsvWriter>(file, settings);
  first_tick_.reset();
}

void ForceRecorder::add(const trace::Sample& sample) {
  if (!writer_) return;
  if (!first_tick_) first_tick_ = sample.tick;
  trace::Sample shifted = sample;  // a recording begins at time 0
  shifted.tick -= *first_tick_;
  writer_->add(shifted);
}

void ForceRecorder::stop() {
  if (!writer_) return;
  const auto writer = std::move(writer_);
  writer->commit();
}

PictureWriter::PictureWriter() : thread_([this] { run(); }) {}

PictureWriter::~PictureWriter() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  change_.notify_all();
  thread_.join();
}

void PictureWriter::write(std::filesystem::path file, view::Image image) {
  std::unique_lock lock(mutex_);
  change_.wait(lock, [this] { return jobs_.size() < kMostWaiting; });
  jobs_.push_back({std::move(file), std::move(image)});
  change_.notify_all();
}

std::string PictureWriter::takeError() {
  const std::lock_guard lock(mutex_);
  return std::exchange(error_, {});
}

void PictureWriter::finish() {
  std::unique_lock lock(mutex_);
  change_.wait(lock, [this] { return jobs_.empty() && !working_; });
}

void PictureWriter::run() {
  lowerPriority(5);  // behind what draws; not far, or the queue fills and drawing waits after all
  std::unique_lock lock(mutex_);
  while (true) {
    change_.wait(lock, [this] { return quit_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    const Job job = std::move(jobs_.front());
    jobs_.pop_front();
    working_ = true;
    lock.unlock();
    std::string error;
    try {
      view::writePng(job.file, job.image);
    } catch (const std::exception& failure) {
      error = failure.what();
    }
    lock.lock();
    working_ = false;
    if (!error.empty()) error_ = std::move(error);
    change_.notify_all();
  }
}

}  // namespace palpate::viewer

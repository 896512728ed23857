#include "view/viewer/files/outputs.h"

#include <utility>

#include "palpate/base/output_file.h"
#include "palpate/base/system/thread.h"
#include "palpate/device/mouse_finger.h"
#include "palpate/view/image.h"
#include "view/viewer/world/live_servo.h"

namespace palpate::viewer {

namespace {

/// Pictures that may wait; a picture of 1280 x 800 takes 3 MB.
constexpr std::size_t kMaxWaiting = 16;

/// Whether the finger was not put on the body yet.
bool isOffBody(const Vec3& tip) { return tip.z() > 0.5 * device::kNowhere.z(); }

}  // namespace

void ForceRecorder::start(const std::filesystem::path& file, double ticks_per_s) {
  trace::ForcesCsvSettings settings;
  settings.finger_names.assign(kFingerNames.begin(), kFingerNames.end());
  settings.ticks_per_s = ticks_per_s;
  writer_ = std::make_unique<trace::ForcesCsvWriter>(file, settings, OutputFile::Unfinished::keep);
  first_tick_.reset();
}

void ForceRecorder::add(const trace::Sample& sample) {
  if (!writer_) return;
  if (!first_tick_) first_tick_ = sample.tick;
  if (isOffBody(sample.contact.tip)) return;
  trace::Sample shifted = sample;  // a recording begins at time 0
  shifted.tick -= *first_tick_;
  writer_->add(shifted);
}

void ForceRecorder::stop() {
  if (!writer_) return;
  writer_->commit();
  writer_.reset();
}

std::string ForceRecorder::abandon() {
  if (!writer_) return {};
  const std::filesystem::path partial = writer_->partial();
  writer_.reset();
  std::error_code error;
  return std::filesystem::exists(partial, error) ? partial.string() : std::string();
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
  change_.wait(lock, [this] { return jobs_.size() < kMaxWaiting; });
  jobs_.push_back({std::move(file), std::move(image)});
  change_.notify_all();
}

std::string PictureWriter::popError() {
  const std::lock_guard lock(mutex_);
  return std::exchange(error_, {});
}

void PictureWriter::finish() {
  std::unique_lock lock(mutex_);
  change_.wait(lock, [this] { return jobs_.empty() && !working_; });
}

void PictureWriter::run() {
  system::lowerPriority(5);  // behind drawing; not far, or the queue fills and drawing waits after all
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

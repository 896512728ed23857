#include "view/viewer/files/film_recorder.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "palpate/base/system/thread.h"
#include "palpate/film/film.h"

namespace palpate::viewer {

namespace {

/// Pictures that may wait; a picture of 1280 x 800 takes 3 MB.
constexpr std::size_t kMaxFilmWaiting = 8;

/// The common part of both sizes, from the upper left.
view::Image fitted(const view::Image& picture, const view::ImageSize& size) {
  if (picture.width == size.width && picture.height == size.height) return picture;
  view::Image fits(size.width, size.height);
  const int width = std::min(size.width, picture.width);
  for (int y = 0; y < std::min(size.height, picture.height); ++y) {
    std::copy_n(&picture.at(0, y), width, &fits.at(0, y));
  }
  return fits;
}

}  // namespace

FilmRecorder::~FilmRecorder() {
  stop();
  wait();
}

void FilmRecorder::start(std::filesystem::path file) {
  stop();
  wait();
  file_ = std::move(file);
  waiting_.clear();
  ending_.reset();
  stopped_ = false;
  filming_ = true;
  next_s_ = 0.0;
}

void FilmRecorder::add(const view::Image& picture, double now_s) {
  constexpr double kPeriodS = 1.0 / kFilmFramesPerS;
  // From the due moment, so that the rate holds; after a pause from now.
  next_s_ = std::max(next_s_ + kPeriodS, now_s + 0.5 * kPeriodS);
  if (!thread_.joinable()) {
    size_ = {picture.width, picture.height};
    thread_ = std::thread([this] { run(file_, size_); });
  }
  view::Image fits = fitted(picture, size_);
  const std::lock_guard lock(mutex_);
  if (waiting_.size() >= kMaxFilmWaiting) return;
  waiting_.push_back({std::move(fits), now_s});
  change_.notify_all();
}

void FilmRecorder::stop() {
  if (!std::exchange(filming_, false)) return;
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  if (!thread_.joinable()) ending_ = {file_, "it has no picture"};
  change_.notify_all();
}

void FilmRecorder::wait() {
  if (thread_.joinable()) thread_.join();
}

std::optional<FilmRecorder::Ending> FilmRecorder::popEnding() {
  const std::lock_guard lock(mutex_);
  if (!ending_) return std::nullopt;
  filming_ = false;
  return std::exchange(ending_, std::nullopt);
}

void FilmRecorder::run(const std::filesystem::path& file, view::ImageSize size) {
  system::lowerPriority(5);  // behind drawing
  Ending ending{file, {}};
  try {
    const auto film = film::beginFilm(file, {size, kFilmFramesPerS, film::Effort::live});
    for (;;) {
      std::unique_lock lock(mutex_);
      change_.wait(lock, [this] { return stopped_ || !waiting_.empty(); });
      if (waiting_.empty()) break;
      const Waiting next = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      film->add(next.picture, next.at_s);
    }
    film->finish();
  } catch (const std::exception& error) {
    ending.trouble = error.what();
  }
  const std::lock_guard lock(mutex_);
  ending_ = std::move(ending);
}

}  // namespace palpate::viewer

#include "palpate/servo/background_build.h"

#include <exception>
#include <utility>

#include "palpate/base/error.h"

namespace palpate::servo {

namespace {

/// Thrown through the build by its progress report; never leaves this file.
struct Superseded {};

}  // namespace

BackgroundBuild::BackgroundBuild() : thread_([this] { work(); }) {}

BackgroundBuild::~BackgroundBuild() {
  cancel();
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

std::uint64_t BackgroundBuild::request(std::shared_ptr<const mesh::TriangleMesh> mesh,
                                       const hdb::BuildSettings& settings) {
  std::optional<BuildResult> unwanted;  // freed after the lock
  const std::lock_guard lock(mutex_);
  const std::uint64_t number = latest_.load(std::memory_order_relaxed) + 1;
  latest_.store(number, std::memory_order_release);
  progress_.store(0.0, std::memory_order_relaxed);
  std::swap(unwanted, result_);
  next_ = Request{number, std::move(mesh), settings};
  wake_.notify_one();
  return number;
}

void BackgroundBuild::cancel() {
  std::optional<BuildResult> unwanted;
  const std::lock_guard lock(mutex_);
  latest_.fetch_add(1, std::memory_order_acq_rel);
  progress_.store(1.0, std::memory_order_relaxed);
  std::swap(unwanted, result_);
  next_.reset();
}

std::optional<BuildResult> BackgroundBuild::take() noexcept {
  std::optional<BuildResult> taken;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock.owns_lock()) std::swap(taken, result_);
  return taken;
}

void BackgroundBuild::work() {
  for (;;) {
    Request request;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return stop_ || next_.has_value(); });
      if (stop_) return;
      request = *std::exchange(next_, std::nullopt);
    }
    try {
      handOver(build(request));
    } catch (const Superseded&) {
      handOver({});
    }
  }
}

BuildResult BackgroundBuild::build(const Request& request) {
  std::erase_if(handed_over_, [](const auto& one) { return one.use_count() == 1; });
  BuildResult result;
  result.request = request.number;
  try {
    const auto report_or_stop = [&](std::string_view, double done) {
      if (!isLatest(request.number)) throw Superseded();
      progress_.store(done, std::memory_order_relaxed);
    };
    report_or_stop({}, 0.0);
    if (!request.mesh) throw Error("partition: no mesh was given");
    result.partition =
        std::make_shared<const hdb::Partition>(hdb::buildPartition(*request.mesh, request.settings, report_or_stop));
  } catch (const std::exception& error) {
    result.error = error.what();
  }
  return result;
}

void BackgroundBuild::handOver(BuildResult result) {
  const std::lock_guard lock(mutex_);
  if (!next_) progress_.store(1.0, std::memory_order_relaxed);
  if (!isLatest(result.request)) return;
  if (result.partition) handed_over_.push_back(result.partition);
  result_ = std::move(result);
}

}  // namespace palpate::servo

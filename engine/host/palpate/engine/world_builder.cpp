// One worker, one request at a time, under one lock that is never held while a world is built or freed. Requests are
// numbered; a build that is not the newest any more throws GivenUp out of its own progress report. That is not a
// std::exception, so no handler on its way takes it for a failure.
#include "palpate/engine/world_builder.h"

#include <exception>
#include <utility>

#include "palpate/base/error_text.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/system/thread.h"

namespace palpate::engine {

namespace {

/// Thrown through the library by its progress reports; caught here alone.
struct GivenUp {};

/// Well behind what draws, but not starved.
constexpr int kPatience = 10;

}  // namespace

WorldBuilder::WorldBuilder(Check check, bool patient)
    : check_(std::move(check)), patient_(patient), thread_([this] { run(); }) {}

WorldBuilder::~WorldBuilder() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    ++newest_;
  }
  wake_.notify_all();
  thread_.join();
}

void WorldBuilder::request(BuildRequest request) {
  replaceRequest(std::move(request));
  wake_.notify_all();
}

void WorldBuilder::cancel() { replaceRequest(std::nullopt); }

void WorldBuilder::replaceRequest(std::optional<BuildRequest> request) {
  std::optional<BuildResult> unwanted;  // whole worlds: freed after the lock
  const std::lock_guard lock(mutex_);
  std::swap(next_, request);
  std::swap(result_, unwanted);
  ++newest_;
}

std::optional<BuildResult> WorldBuilder::collectResult() {
  const std::lock_guard lock(mutex_);
  return std::exchange(result_, std::nullopt);
}

std::optional<BuildProgress> WorldBuilder::progress() const {
  const std::lock_guard lock(mutex_);
  if (!busy_ && !next_) return std::nullopt;
  BuildProgress progress = progress_;
  progress.since_s = busy_ ? secondsSince(began_) : 0.0;
  return progress;
}

void WorldBuilder::run() {
  if (patient_) system::lowerPriority(kPatience);
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return quit_ || next_; });
    if (quit_) return;
    BuildRequest request = *std::exchange(next_, std::nullopt);
    const std::uint64_t number = newest_;
    busy_ = true;
    began_ = Clock::now();
    progress_ = {"starting", 0.0, 0.0};
    lock.unlock();
    std::optional<BuildResult> result;
    try {
      result = build(std::move(request), number);
    } catch (const GivenUp&) {
    }
    lock.lock();
    busy_ = false;
    if (number == newest_) result_ = std::move(result);
    if (!result) continue;
    lock.unlock();
    result.reset();  // unwanted: freed outside the lock
    lock.lock();
  }
}

BuildResult WorldBuilder::build(BuildRequest request, std::uint64_t number) {
  BuildResult result{std::move(request), nullptr, {}};
  const palpate::Progress listen = [&](std::string_view stage, double done) { note(number, stage, done); };
  try {
    scene::Scene& scene = result.request.scene;
    if (result.request.read) scene = result.request.read();
    result.world =
        result.request.body ? scene::rebuilt(*result.request.body, scene, listen) : scene::build(scene, listen);
    if (check_) check_(*result.world);
  } catch (const std::exception& error) {
    result.world = nullptr;
    result.error = textOf(error);
  }
  return result;
}

void WorldBuilder::note(std::uint64_t number, std::string_view stage, double done) {
  if (number != newest_) throw GivenUp{};
  const std::lock_guard lock(mutex_);
  progress_.stage = stage;
  progress_.done = done;
}

}  // namespace palpate::engine

#include "apps/viewer/world_builder.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/scene/scene_file.h"
#include "palpate/servo/pacing.h"
#include "palpate/view/layers/skin_picture.h"

namespace palpate::viewer {

namespace {

/// Thrown through the library by its progress reports; nobody else sees it.
struct GivenUp {};

/// Nice value of the worker's thread: whatever draws or touches goes first.
constexpr int kPatience = 10;

double nowS() { return static_cast<double>(servo::monotonicNs()) * 1e-9; }

}  // namespace

scene::Scene sceneFromFile(const std::string& file, const scene::Scene& like) {
  const std::filesystem::path path(file);
  std::string kind = path.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  if (kind == ".toml") return scene::load(path);
  scene::Scene scene = like;
  scene.title = path.filename().string();
  scene.file.clear();
  scene.dysfunctions.clear();  // they belong to the body they were placed on
  scene.ellipses.key_points.clear();
  scene.body = {};
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = path;
  return scene;
}

WorldBuilder::WorldBuilder() : thread_([this] { run(); }) {}

WorldBuilder::~WorldBuilder() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    ++newest_;
  }
  wake_.notify_all();
  thread_.join();
}

void WorldBuilder::wish(BuildWish wish) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(wish);
    result_.reset();
    ++newest_;
  }
  wake_.notify_all();
}

void WorldBuilder::cancel() {
  const std::lock_guard lock(mutex_);
  next_.reset();
  ++newest_;
}

std::optional<BuildResult> WorldBuilder::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(result_, std::nullopt);
}

std::optional<WorldBuilder::Progress> WorldBuilder::progress() const {
  const std::lock_guard lock(mutex_);
  if (!busy_ && !next_) return std::nullopt;
  Progress progress = progress_;
  progress.since_s = busy_ ? nowS() - began_s_ : 0.0;
  return progress;
}

void WorldBuilder::run() {
  setpriority(PRIO_PROCESS, 0, kPatience);  // of this thread, on Linux
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return quit_ || next_; });
    if (quit_) return;
    const BuildWish wish = std::move(*next_);
    next_.reset();
    const std::uint64_t number = newest_;
    busy_ = true;
    began_s_ = nowS();
    progress_ = {"starting", 0.0, 0.0};
    lock.unlock();
    std::optional<BuildResult> result;
    try {
      result = build(wish, number);
    } catch (const GivenUp&) {
    }
    lock.lock();
    busy_ = false;
    if (number == newest_) result_ = std::move(result);
  }
}

BuildResult WorldBuilder::build(const BuildWish& wish, std::uint64_t number) {
  BuildResult result{wish, nullptr, {}};
  const palpate::Progress listen = [&](std::string_view stage, double done) { note(number, stage, done); };
  try {
    if (!wish.open.empty()) result.wish.scene = sceneFromFile(wish.open, wish.scene);
    result.world =
        wish.body ? scene::rebuilt(*wish.body, result.wish.scene, listen) : scene::build(result.wish.scene, listen);
    if (result.world->texture) view::decodedPicture(*result.world->texture);  // a broken one must not reach the display
  } catch (const std::exception& error) {
    result.world = nullptr;
    result.error = error.what();
  }
  return result;
}

void WorldBuilder::note(std::uint64_t number, std::string_view stage, double done) {
  if (number != newest_) throw GivenUp{};
  const std::lock_guard lock(mutex_);
  progress_.stage = stage;
  progress_.done = done;
}

}  // namespace palpate::viewer

#include "apps/viewer/live_model.h"

#include "palpate/base/stopwatch.h"

namespace palpate::viewer {

namespace {

double sinceMs(std::int64_t start_ns) { return static_cast<double>(monotonicNs() - start_ns) * 1e-6; }

}  // namespace

LiveModel::LiveModel(std::shared_ptr<const scene::World> world)
    : world_(std::move(world)), skin_(std::in_place, *world_), painter_(world_) {}

void LiveModel::setWorld(std::shared_ptr<const scene::World> world) {
  painter_.setWorld(world);
  skin_.emplace(*world);
  world_ = std::move(world);
}

LiveModel::Times LiveModel::follow(std::span<const trace::Sample> contacts) {
  Times times;
  const std::int64_t start = monotonicNs();
  skin_->follow(contacts);
  times.deform_ms = sinceMs(start);
  const std::int64_t uploading = monotonicNs();
  painter_.renderer().update(skin_->surface());
  times.upload_ms = sinceMs(uploading);
  return times;
}

}  // namespace palpate::viewer

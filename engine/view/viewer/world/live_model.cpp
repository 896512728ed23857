#include "view/viewer/world/live_model.h"

#include "palpate/base/stopwatch.h"

namespace palpate::viewer {

LiveModel::LiveModel(std::shared_ptr<const scene::World> world)
    : world_(std::move(world)), skin_(std::in_place, *world_), painter_(world_) {}

void LiveModel::setWorld(std::shared_ptr<const scene::World> world) {
  painter_.setWorld(world);
  skin_.emplace(*world);
  world_ = std::move(world);
}

LiveModel::Times LiveModel::follow(std::span<const trace::Sample> contacts) {
  Times times;
  const Clock::time_point start = Clock::now();
  skin_->follow(contacts);
  times.deform_ms = millisecondsSince(start);
  const Clock::time_point uploading = Clock::now();
  painter_.renderer().update(skin_->surface());
  times.upload_ms = millisecondsSince(uploading);
  return times;
}

}  // namespace palpate::viewer

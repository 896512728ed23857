#include "apps/viewer/live_model.h"

#include "palpate/scene/skin_contact.h"

namespace palpate::viewer {

namespace {

deform::FormSettings formsFor(const scene::World& world) {
  deform::FormSettings forms = world.deformation;
  forms.common.strain = true;
  return forms;
}

double sinceMs(std::int64_t start_ns) { return static_cast<double>(servo::monotonicNs() - start_ns) * 1e-6; }

}  // namespace

LiveModel::LiveModel(std::shared_ptr<const scene::World> world)
    : world_(std::move(world)),
      deformer_(std::in_place, world_->deformable, formsFor(*world_)),
      surface_(world_->deformable),
      painter_(world_) {}

void LiveModel::setWorld(std::shared_ptr<const scene::World> world) {
  painter_.setWorld(world);
  deformer_.emplace(world->deformable, formsFor(*world));
  surface_ = deform::DeformedSurface(world->deformable);
  world_ = std::move(world);
}

LiveModel::Times LiveModel::follow(std::span<const trace::Sample> contacts) {
  Times times;
  const std::int64_t start = servo::monotonicNs();
  touching_.clear();
  for (const trace::Sample& sample : contacts) {
    const auto contact = scene::contactOf(*world_, sample.contact);
    if (contact) touching_.push_back(*contact);
  }
  deformer_->apply(touching_, surface_);
  times.deform_ms = sinceMs(start);
  const std::int64_t uploading = servo::monotonicNs();
  painter_.renderer().update(surface_);
  times.upload_ms = sinceMs(uploading);
  return times;
}

}  // namespace palpate::viewer

// Contacts are gathered in a list whose room is reserved once; fingers beyond it are left out and reported. One
// template serves outputs of a tick and samples of a trace. 60 times a second, no allocation.
#include "palpate/engine/living_skin.h"

#include "palpate/engine/touching.h"

namespace palpate::engine {

namespace {

const contact::FingerOutput& contactOutput(const contact::FingerOutput& finger) { return finger; }
const contact::FingerOutput& contactOutput(const trace::Sample& sample) { return sample.contact; }

}  // namespace

LivingSkin::LivingSkin(const scene::World& world, const LivingSkinSettings& settings)
    : LivingSkin(world, formsForFingers(world, settings.strain, settings.fingers)) {}

LivingSkin::LivingSkin(const scene::World& world, const deform::FormSettings& forms)
    : world_(world), deformer_(*world.deformable, forms), surface_(*world.deformable) {
  touching_.reserve(forms.common.max_contacts);
}

template <class Finger>
deform::Report LivingSkin::followAny(std::span<const Finger> fingers, std::uint64_t tick) noexcept {
  lift_mm_ = liftAt(world_, tick);
  touching_.clear();
  std::uint32_t left_out = 0;
  for (const Finger& finger : fingers) {
    if (!addTouching(world_, contactOutput(finger), lift_mm_, touching_)) left_out = deform::kIgnoredOverCapacity;
  }
  deform::Report report = deformer_.apply(touching_, surface_);
  report.status |= left_out;
  return report;
}

deform::Report LivingSkin::follow(std::span<const contact::FingerOutput> fingers, std::uint64_t tick) noexcept {
  return followAny(fingers, tick);
}

deform::Report LivingSkin::follow(std::span<const trace::Sample> samples) noexcept {
  return followAny(samples, samples.empty() ? 0 : samples.front().tick);
}

}  // namespace palpate::engine

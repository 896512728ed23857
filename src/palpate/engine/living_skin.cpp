// Contacts are gathered in a list whose room is reserved once; fingers beyond it are left out and reported. One
// template serves what a tick gave and what a trace holds. 60 times a second, no allocation. Own.
#include "palpate/engine/living_skin.h"

#include <algorithm>

#include "palpate/scene/skin_contact.h"
#include "palpate/servo/finger_solver.h"

namespace palpate::engine {

namespace {

deform::FormSettings formsOf(const scene::World& world, const LivingSkinSettings& settings) {
  deform::FormSettings forms = world.deformation;
  forms.common.strain = settings.strain;
  // Each finger may have left a dent.
  const std::size_t places = 2 * std::max(world.scene.fingers.size(), settings.fingers);
  forms.common.max_contacts = std::max(forms.common.max_contacts, places);
  return forms;
}

const contact::FingerOutput& outputOf(const contact::FingerOutput& finger) { return finger; }
const contact::FingerOutput& outputOf(const trace::Sample& sample) { return sample.contact; }

}  // namespace

LivingSkin::LivingSkin(const scene::World& world, const LivingSkinSettings& settings)
    : LivingSkin(world, formsOf(world, settings)) {}

LivingSkin::LivingSkin(const scene::World& world, const deform::FormSettings& forms)
    : world_(world), deformer_(world.deformable, forms), surface_(world.deformable) {
  touching_.reserve(forms.common.max_contacts);
}

template <class Finger>
deform::Report LivingSkin::followAny(std::span<const Finger> fingers, std::uint64_t tick) noexcept {
  lift_mm_ = world_.breath ? world_.breath->lift(static_cast<double>(tick) / world_.scene.ticks_per_s) : 0.0;
  touching_.clear();
  std::uint32_t left_out = 0;
  const auto add = [&](const std::optional<deform::Contact>& contact) {
    if (!contact) return;
    if (touching_.size() < touching_.capacity()) {
      touching_.push_back(*contact);
    } else {
      left_out = deform::kIgnoredOverCapacity;
    }
  };
  for (const Finger& finger : fingers) {
    const contact::FingerOutput& output = outputOf(finger);
    const contact::FingerOutput felt = world_.breath ? servo::atRest(*world_.breath, output, lift_mm_) : output;
    add(scene::contactOf(world_, felt));
    add(scene::dentOf(world_, felt));
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

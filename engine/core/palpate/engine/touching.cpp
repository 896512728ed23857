// 60 times a second for each finger; no allocation.
#include "palpate/engine/touching.h"

#include <algorithm>
#include <optional>

#include "palpate/scene/skin_contact.h"
#include "palpate/servo/finger_solver.h"

namespace palpate::engine {

deform::FormSettings formsForFingers(const scene::World& world, bool strain, std::size_t fingers) {
  deform::FormSettings forms = world.deformation;
  forms.common.strain = strain;
  // Each finger may have left a dent.
  const std::size_t places = 2 * std::max(world.scene.fingers.size(), fingers);
  forms.common.max_contacts = std::max(forms.common.max_contacts, places);
  return forms;
}

double liftAt(const scene::World& world, std::uint64_t tick) noexcept {
  return world.breath ? world.breath->lift(static_cast<double>(tick) / world.scene.ticks_per_s) : 0.0;
}

bool addTouching(const scene::World& world, const contact::FingerOutput& finger, double lift_mm,
                 std::vector<deform::Contact>& contacts) noexcept {
  bool all = true;
  const auto add = [&](const std::optional<deform::Contact>& contact) {
    if (!contact) return;
    if (contacts.size() < contacts.capacity()) {
      contacts.push_back(*contact);
    } else {
      all = false;
    }
  };
  const contact::FingerOutput felt = world.breath ? servo::atRest(*world.breath, finger, lift_mm) : finger;
  add(scene::contactOf(world, felt));
  add(scene::dentOf(world, felt));
  return all;
}

}  // namespace palpate::engine

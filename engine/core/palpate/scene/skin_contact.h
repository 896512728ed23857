// From a finger of a built scene to what the deformation has to know about it: the one place where the scene's maps,
// forms and literal readings meet the finger's output.
//
// finger outputs ─ contactOf ─► contacts ─ Deformer(*world.deformable, world.deformation) ─► deformed surface
#pragma once

#include <optional>

#include "palpate/deform/contact.h"
#include "palpate/scene/world.h"

namespace palpate::scene {

/// The contact of a finger that touches; nothing for one in free space. Regions from the scene's maps at the friction
/// anchor, in the scene's forms. As deep as the finger, or as the skin stays by itself where that is deeper. No
/// allocation; any thread.
std::optional<deform::Contact> contactOf(const World& world, const contact::FingerOutput& finger) noexcept;

/// The skin's deformation by the dent that the finger left, while it recovers; nothing without a dent.
std::optional<deform::Contact> dentOf(const World& world, const contact::FingerOutput& finger) noexcept;

}  // namespace palpate::scene

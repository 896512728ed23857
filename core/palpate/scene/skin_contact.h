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

/// What the dent that the finger left makes of the skin while it comes back; nothing where there is none.
std::optional<deform::Contact> dentOf(const World& world, const contact::FingerOutput& finger) noexcept;

}  // namespace palpate::scene

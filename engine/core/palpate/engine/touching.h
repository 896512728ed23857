// The deformation's input from fingers: their contacts and the dents they left, taken back to the skin at rest where
// the body breathes.
//
//   FingerOutput or Sample of each finger ─► touching contacts ─► Deformer (living_skin.h), or a stream
//   (contact_stream.h) to a remote deformer
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "palpate/contact/finger_state.h"
#include "palpate/deform/contact.h"
#include "palpate/deform/forms.h"
#include "palpate/scene/world.h"

namespace palpate::engine {

/// The world's forms with room for the contacts and dents of this many fingers, and of those of its scene.
deform::FormSettings formsForFingers(const scene::World& world, bool strain, std::size_t fingers);

/// Motion of the body by breath at this tick (BreathField::lift), mm; 0 for one that does not breathe.
double liftAt(const scene::World& world, std::uint64_t tick) noexcept;

/// Adds what this finger makes of the skin: nothing for one in free space that left no dent. `lift_mm`: of the tick in
/// which it was felt. False where the capacity of `contacts` did not do, which is never enlarged. No allocation.
bool addTouching(const scene::World& world, const contact::FingerOutput& finger, double lift_mm,
                 std::vector<deform::Contact>& contacts) noexcept;

}  // namespace palpate::engine

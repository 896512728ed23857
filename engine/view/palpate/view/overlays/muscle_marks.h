// The superficial muscles of the back as a drawing: flat sheets on the skin that show the extent of each muscle and the
// direction of its fibres. A drawing between landmarks after a textbook (Standring, Gray's Anatomy, back and shoulder
// girdle), the same for every body: no thickness, no tension, no effect on touch.
//
//   World::anatomy.landmarks ─ muscleSheets, once ─► MuscleSheet ─ addMuscle, each picture ─► Overlays
#pragma once

#include <span>
#include <vector>

#include "palpate/body/torso.h"
#include "palpate/scene/world.h"
#include "palpate/view/drawn_skin.h"
#include "palpate/view/lines.h"
#include "palpate/view/overlays/body_names.h"
#include "palpate/view/overlays/overlays.h"

namespace palpate::view {

inline constexpr const char* kNoMuscles = "this body lacks places that its muscles are drawn between";

/// Whether all places for them exist.
bool hasMuscles(std::span<const body::SkinLandmark> landmarks);

/// Erector spinae, latissimus dorsi and trapezius of both sides, the deepest first; empty without hasMuscles. Some 10
/// ms: keep them.
std::vector<MuscleSheet> muscleSheets(const scene::World& world);

/// Draws stripes along the fibres, with a line round them, on the present skin.
void addMuscle(const MuscleSheet& muscle, const DrawnSkin& skin, Patches& stripes, Lines& border);

/// Their names, in the middle of each; empty without hasMuscles.
std::vector<BodyName> muscleNames(const scene::World& world);

}  // namespace palpate::view

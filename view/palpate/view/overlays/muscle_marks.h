// The superficial muscles of the back as a drawing: flat sheets on the skin that show where each muscle runs and which
// way its fibres go. A drawing between landmarks by a textbook's words (Standring, Gray's Anatomy, back and shoulder
// girdle), the same for every body: no thickness, no tension, nothing that is felt.
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

/// Whether every place that they are drawn between is there.
bool hasMuscles(std::span<const body::SkinLandmark> landmarks);

/// Erector spinae, latissimus dorsi and trapezius of both sides, the deepest first; none without hasMuscles. Some 10
/// ms: keep them.
std::vector<MuscleSheet> muscleSheets(const scene::World& world);

/// As stripes along the fibres, with a line round them, on the skin as it is now.
void addMuscle(const MuscleSheet& muscle, const DrawnSkin& skin, Patches& stripes, Lines& border);

/// What they are called, in the middle of each; none without hasMuscles.
std::vector<BodyName> muscleNames(const scene::World& world);

}  // namespace palpate::view

// Lumps as bodies under translucent skin, with their names. They lie where mobile ones have moved to, and go down with
// the skin that is pressed over them. No GL but in drawLumpNames.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "palpate/scene/world.h"
#include "palpate/view/drawn_skin.h"
#include "palpate/view/finger_pose.h"
#include "palpate/view/lines.h"

namespace palpate::view {

/// The most opaque that skin is drawn over lumps that are shown.
inline constexpr double kSkinOverLumps = 0.4;

/// How far a lump of the world is from its place, mm across and up: as the fingers say, else it is at its place.
Vec2 movedOf(std::size_t lump, std::span<const FingerMark> fingers);

/// Where the middle of a lump is now: moved sideways, and down with the skin by the share that its depth has of the way
/// to the bone.
Vec3 middleOf(const scene::World& world, std::size_t lump, std::span<const FingerMark> fingers, const DrawnSkin& skin);

/// All lumps of the world, shaded.
void addLumps(const scene::World& world, std::span<const FingerMark> fingers, const DrawnSkin& skin, Patches& solid);

}  // namespace palpate::view

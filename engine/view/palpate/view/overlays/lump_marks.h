// Lumps as bodies under translucent skin, with their names. Mobile ones are drawn where they have moved to, and sink
// with the skin that is pressed over them. No GL except in drawLumpNames.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "palpate/scene/world.h"
#include "palpate/view/drawn_skin.h"
#include "palpate/view/finger_pose.h"
#include "palpate/view/lines.h"

namespace palpate::view {

/// Largest opacity of skin over lumps.
inline constexpr double kSkinOverLumps = 0.4;

/// The shift of a lump from its place, mm across and up: as the fingers report, else zero.
Vec2 lumpShift(std::size_t lump, std::span<const FingerMark> fingers);

/// The present middle of a lump: moved sideways, and down with the skin by the share of its depth on the way to the
/// bone.
Vec3 lumpCentre(const scene::World& world, std::size_t lump, std::span<const FingerMark> fingers,
                const DrawnSkin& skin);

/// All lumps of the world, shaded.
void addLumps(const scene::World& world, std::span<const FingerMark> fingers, const DrawnSkin& skin, Patches& solid);

}  // namespace palpate::view

// Which presses are dents that have to be seen though they are small in the picture, and where (skin_shader.h helps).
#pragma once

#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/view/finger_pose.h"

namespace palpate::scene {
struct World;
}

namespace palpate::view {

/// Millimetres a point of the picture where a dent gets its first help to be seen, and all of it.
inline constexpr double kLeastHelpMm = 0.25;
inline constexpr double kFullHelpMm = 0.8;
/// mm: the outermost contour of a dent; the next ones are 2 mm apart.
inline constexpr double kOutermostContourMm = 0.5;

/// A press as a dent that has to be seen, in coordinates of the skin at rest, from its origin.
struct SkinDent {
  Vec3f place = Vec3f::Zero();
  Vec3f normal = Vec3f::UnitZ();  ///< unit, against the press and across every drag: what sinks along it is a dent
  float reach_mm = 60.0f;         ///< the press's own region; at 1.3 times that nothing belongs to this dent
  float share = 1.0f;             ///< 1: a dent; 0: so wide that the whole body gives way
};

/// Of the fingers that press, and what relaxing skin keeps of those that have left. Some 20 us a finger.
std::vector<SkinDent> dentsOf(std::span<const FingerMark> fingers, const scene::World& world, double lift_mm);

}  // namespace palpate::view

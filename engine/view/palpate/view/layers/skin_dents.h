// Finds the presses whose dents must be seen though they are small in the picture, and where (skin_shader.h helps).
#pragma once

#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/view/finger_pose.h"

namespace palpate::scene {
struct World;
}

namespace palpate::view {

/// Millimetres per point of the picture where a dent gets its first help to be seen, and all of it.
inline constexpr double kLeastHelpMm = 0.25;
inline constexpr double kFullHelpMm = 0.8;
/// mm: the outermost contour of a dent; the next ones are 2 mm apart.
inline constexpr double kOutermostContourMm = 0.5;

/// A dent that must be seen, in coordinates of the skin at rest, from its origin.
struct SkinDent {
  Vec3f place = Vec3f::Zero();
  Vec3f normal = Vec3f::UnitZ();  ///< unit, against the press and across every drag: motion against it is a dent
  float reach_mm = 60.0f;         ///< the press's own region; the dent ends at 1.3 times this
  float share = 1.0f;             ///< 1: a dent; 0: so wide that the whole body gives way
};

/// The dents of pressing fingers, and those that relaxing skin keeps from earlier ones. Some 20 us per finger.
std::vector<SkinDent> collectDents(std::span<const FingerMark> fingers, const scene::World& world, double lift_mm);

}  // namespace palpate::view

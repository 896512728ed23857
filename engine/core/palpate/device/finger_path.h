// The paths of a scene's fingers: from their trajectory files and scripts to one tip per tick, on one clock.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/device/trajectory.h"
#include "palpate/scene/scene.h"
#include "palpate/scene/world.h"

namespace palpate::device {

/// The frame of a script: u and v along the skin, w out of it; orthonormal.
struct ScriptFrame {
  Vec3 origin = Vec3::Zero();
  Vec3 u = Vec3::UnitX();
  Vec3 v = Vec3::UnitY();
  Vec3 w = Vec3::UnitZ();
};

/// Height of the skin at rest above the frame's plane, mm; empty off the skin.
using SkinHeight = std::function<std::optional<double>(double u_mm, double v_mm)>;

/// From "press, drag, circle" to one tip per tick, from the script's start to its end: a finger that follows the relief
/// of the skin at a given depth. Motions start and end at rest (minimum jerk), as a hand's do. Depths and heights are
/// those of the finger's pad, which is its radius below the tip; they count along w from the skin, whose relief is
/// smoothed over kReliefSmoothingS: a hand does not follow a cliff. Past the border the last height holds. Throws Error
/// when the start is not over skin, or the script is longer than kMaxScriptS. Based on: Flash and Hogan, "The
/// coordination of arm movements", J. Neurosci. 5 (1985), for the time course.
std::vector<Vec3> walkScript(const scene::Finger& finger, const ScriptFrame& frame, const SkinHeight& height,
                             double tick_s);

inline constexpr double kReliefSmoothingS = 0.05;
inline constexpr double kMaxScriptS = 3.0 * 3600.0;

struct FingerPaths {
  double start_s = 0.0;   ///< time of tick 0: the earliest first row of all trajectories; scripts start there too
  std::size_t ticks = 0;  ///< until the last finger has finished, or the scene's `seconds`
  std::vector<std::shared_ptr<const std::vector<Vec3>>> tips;  ///< per finger; a finished one rests at its last tip
};

/// Reads the files and walks the scripts. Throws Error as readTrajectory and walkScript do.
FingerPaths pathsOf(const scene::World& world);

/// A path for a body without a planned one: press, drag, circle and lift around the highest place (largest z) that
/// faces up and has room for it, along its normal, sized to the body.
Trajectory automaticPath(const scene::World& world, double radius_mm = 0.0);

}  // namespace palpate::device

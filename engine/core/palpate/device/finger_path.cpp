// A finger's path from its trajectory file, or from its script, which is walked over the heights of the skin at rest,
// or, without either, over the highest place with room for a standard script. All run on one clock.
// Data flow: World + trajectory files -> here, before the first tick -> one tip per tick -> scriptedDevice. A height
// costs a segment through the tree.
// Based on: Flash and Hogan (1985), see finger_path.h, for the time course of a motion; the rest is our own.
#include "palpate/device/finger_path.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/base/number_range.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::device {

namespace {

/// A point of a script: over which place, and how far above the skin (below it when negative).
struct Stand {
  Vec2 place = Vec2::Zero();
  double height = 0.0;
};

/// Minimum jerk: from 0 to 1 with velocity and acceleration 0 at both ends.
double eased(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

/// Spirals out from the centre, goes round, and spirals back in.
Vec2 circleOffset(const scene::Step& step, double t) {
  constexpr double kLongestSpiral = 0.25;  // share of the step, so that at least half of it is round
  const double half_turn = std::abs(step.turns) > 0.0 ? 0.5 / std::abs(step.turns) : 1.0;
  const double spiral = std::min(half_turn, kLongestSpiral);
  const double radius = step.radius_mm * eased(t / spiral) * eased((1.0 - t) / spiral);
  const double angle = 2.0 * std::numbers::pi * step.turns * t;
  return radius * Vec2(elementary::cos(angle), elementary::sin(angle));
}

/// The finger at share t of a step that began at `from`.
Stand during(const scene::Step& step, const Stand& from, double t) {
  Stand now = from;
  switch (step.move) {
    case scene::Move::press:
      now.height += (-step.depth_mm - from.height) * eased(t);
      break;
    case scene::Move::lift:
      now.height += (step.height_mm - from.height) * eased(t);
      break;
    case scene::Move::drag:
      now.place += step.by_mm * eased(t);
      break;
    case scene::Move::circle:
      now.place += circleOffset(step, t);
      break;
    case scene::Move::hold:
      break;
  }
  return now;
}

/// With the place of the finger's table where there is one.
[[noreturn]] void failFinger(const scene::Finger& finger, const std::string& cause) {
  const std::string message = fmt::format("finger '{}': {}", finger.name, cause);
  if (finger.line > 0) throw Error::atLine(finger.scene_file, finger.line, message);
  throw Error(message);
}

void requireReasonableLength(const scene::Finger& finger) {
  double seconds = 0.0;
  for (const scene::Step& step : finger.steps) seconds += step.seconds;
  if (seconds > kMaxScriptS) {
    failFinger(finger, fmt::format("the script lasts {} s, more than {} s", seconds, readableNumber(kMaxScriptS)));
  }
}

std::vector<Stand> computeStands(const scene::Finger& finger, double tick_s) {
  requireReasonableLength(finger);
  std::vector<Stand> stands = {{finger.at_mm, finger.start_height_mm}};
  for (const scene::Step& step : finger.steps) {
    const Stand from = stands.back();
    const auto ticks = static_cast<std::size_t>(std::max(1.0, std::round(step.seconds / tick_s)));
    for (std::size_t k = 1; k <= ticks; ++k) {
      stands.push_back(during(step, from, static_cast<double>(k) / static_cast<double>(ticks)));
    }
  }
  return stands;
}

std::vector<double> skinHeights(const scene::Finger& finger, const std::vector<Stand>& stands,
                                const SkinHeight& height) {
  const Vec2 start = stands.front().place;
  const auto first = height(start.x(), start.y());
  if (!first) {
    failFinger(finger, fmt::format("there is no skin at at_mm = [{}, {}]", start.x(), start.y()));
  }
  std::vector<double> heights;
  heights.reserve(stands.size());
  for (const Stand& stand : stands) {
    const double last = heights.empty() ? *first : heights.back();
    heights.push_back(height(stand.place.x(), stand.place.y()).value_or(last));
  }
  return heights;
}

/// Mean over `reach` values to both sides; the ends are continued.
std::vector<double> movingMean(const std::vector<double>& values, std::ptrdiff_t reach) {
  const auto size = static_cast<std::ptrdiff_t>(values.size());
  const auto at = [&](std::ptrdiff_t i) {
    return values[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, size - 1))];
  };
  std::vector<double> prefix(values.size() + 1 + 2 * static_cast<std::size_t>(reach), 0.0);
  for (std::ptrdiff_t i = 0; i + 1 < static_cast<std::ptrdiff_t>(prefix.size()); ++i) {
    prefix[static_cast<std::size_t>(i) + 1] = prefix[static_cast<std::size_t>(i)] + at(i - reach);
  }
  std::vector<double> means(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto width = static_cast<std::size_t>(2 * reach + 1);
    means[i] = (prefix[i + width] - prefix[i]) / static_cast<double>(width);
  }
  return means;
}

}  // namespace

std::vector<Vec3> walkScript(const scene::Finger& finger, const ScriptFrame& frame, const SkinHeight& height,
                             double tick_s) {
  const std::vector<Stand> stands = computeStands(finger, tick_s);
  const auto reach = static_cast<std::ptrdiff_t>(std::llround(0.5 * kReliefSmoothingS / tick_s));
  // Twice a moving mean: a kink in the relief becomes a smooth curve, not a polygon.
  const std::vector<double> skin = movingMean(movingMean(skinHeights(finger, stands, height), reach), reach);
  std::vector<Vec3> tips(stands.size());
  for (std::size_t i = 0; i < stands.size(); ++i) {
    const Stand& stand = stands[i];
    tips[i] = frame.origin + stand.place.x() * frame.u + stand.place.y() * frame.v +
              (skin[i] + stand.height + finger.radius_mm) * frame.w;
  }
  return tips;
}

namespace {

/// The skin seen from outside along the frame's w.
SkinHeight heightOver(const scene::World& world, const ScriptFrame& frame) {
  const tree::TriangleTree& tree = world.surface.geometry->tree;
  const double far = 2.0 * tree.diagonal + (frame.origin - tree.center).norm();
  return [&tree, frame, far](double u, double v) -> std::optional<double> {
    const Vec3 on_plane = frame.origin + u * frame.u + v * frame.v;
    const auto hit = tree::firstFrontCrossing(tree, on_plane + far * frame.w, on_plane - far * frame.w);
    if (hit.triangle == kNoIndex) return std::nullopt;
    return (hit.point - frame.origin).dot(frame.w);
  };
}

std::size_t ticksIn(double seconds, double ticks_per_s) {
  return static_cast<std::size_t>(std::llround(seconds * ticks_per_s));
}

/// The path moved to the common clock: it waits at its first tip until its own start.
std::vector<Vec3> delayed(const std::vector<Vec3>& tips, std::size_t ticks) {
  std::vector<Vec3> result(ticks, tips.front());
  result.insert(result.end(), tips.begin(), tips.end());
  return result;
}

std::vector<Trajectory> readFiles(const scene::Scene& scene) {
  std::vector<Trajectory> trajectories(scene.fingers.size());
  for (std::size_t i = 0; i < scene.fingers.size(); ++i) {
    if (!scene.fingers[i].trajectory.empty()) trajectories[i] = readTrajectory(scene.fingers[i].trajectory);
  }
  return trajectories;
}

double earliestStart(const std::vector<Trajectory>& trajectories) {
  double start = std::numeric_limits<double>::infinity();
  for (const Trajectory& t : trajectories) {
    if (t.size() > 0) start = std::min(start, t.time_s.front());
  }
  return std::isfinite(start) ? start : 0.0;
}

Trajectory onTicks(const scene::Finger& finger, const Trajectory& trajectory, double ticks_per_s) {
  try {
    return resampled(trajectory, 1.0 / ticks_per_s);
  } catch (const Error& error) {
    throw Error::inFile(finger.trajectory.string(), error.what());
  }
}

std::vector<Vec3> computeTips(const scene::World& world, const scene::Finger& finger, const Trajectory& trajectory,
                              double start_s) {
  const double ticks_per_s = world.scene.ticks_per_s;
  if (finger.hasAutomaticPath()) return automaticPath(world, finger.radius_mm).tip_mm;
  if (trajectory.size() == 0) return walkScript(finger, {}, heightOver(world, {}), 1.0 / ticks_per_s);
  const Trajectory on_ticks = onTicks(finger, trajectory, ticks_per_s);
  const double delay_s = trajectory.time_s.front() - start_s;
  if (delay_s > kMaxScriptS) {
    failFinger(finger, fmt::format("it would start {} s after the first one: one clock?", delay_s));
  }
  return delayed(on_ticks.tip_mm, ticksIn(delay_s, ticks_per_s));
}

/// Vertices to try, the highest first: spread over those that face up and are not on a border, or else over all
/// vertices.
std::vector<Index> places(const scene::World& world) {
  constexpr std::size_t kMax = 200;  // a try costs a few hundred queries, so all of them well under a second
  std::vector<Index> facing_up;
  std::vector<Index> all;
  for (Index v = 0; v < world.body->skin.positions.size(); ++v) {
    all.push_back(v);
    if (world.surface.geometry->vertex_on_border[v] == 0 && world.surface.geometry->vertex_normals[v].z() > 0.5)
      facing_up.push_back(v);
  }
  std::vector<Index>& candidates = facing_up.empty() ? all : facing_up;
  std::stable_sort(candidates.begin(), candidates.end(), [&](Index a, Index b) {
    return world.body->skin.positions[a].z() > world.body->skin.positions[b].z();
  });
  const std::size_t stride = (candidates.size() + kMax - 1) / kMax;
  std::vector<Index> spread;
  for (std::size_t i = 0; i < candidates.size(); i += stride) spread.push_back(candidates[i]);
  return spread;
}

ScriptFrame frameAt(const Vec3& origin, const Vec3& normal) {
  const Vec3 w = normal.norm() > 0.5 ? normal.normalized() : Vec3::UnitZ();
  const Vec3 side = std::abs(w.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 u = (side - side.dot(w) * w).normalized();
  return {origin, u, w.cross(u), w};
}

// Lengths of the automatic path for a body the size of a back, mm; smaller bodies and narrow tops get smaller ones.
constexpr double kBackDiagonal = 400.0;
constexpr double kAutomaticDepth = 8.0;
constexpr double kAutomaticDrag = 30.0;
constexpr double kAutomaticCircle = 12.0;
constexpr double kAutomaticHover = 10.0;

/// Whether the skin extends, and slopes no steeper than about 40 degrees, wherever a path of this size leads.
bool fits(const SkinHeight& height, double size) {
  const double top = height(0.0, 0.0).value_or(0.0);
  for (double u = -kAutomaticCircle; u <= kAutomaticDrag + kAutomaticCircle; u += 0.5 * kAutomaticCircle) {
    for (double v = -kAutomaticCircle; v <= kAutomaticCircle; v += 0.5 * kAutomaticCircle) {
      const auto here = height(size * u, size * v);
      const double reach = size * (elementary::hypot(u, v) + kAutomaticDepth);
      if (!here || std::abs(*here - top) > 0.8 * reach) return false;
    }
  }
  return true;
}

/// Factors on the lengths above: sideways as far as the top allows, in depth at least half of what suits the body's
/// size.
struct PathSize {
  double sideways;
  double depth;
};

PathSize fittingSize(const SkinHeight& height, double diagonal) {
  const double body = std::min(1.0, diagonal / kBackDiagonal);
  double sideways = body;
  for (int halvings = 0; halvings < 3 && !fits(height, sideways); ++halvings) sideways *= 0.5;
  return {sideways, std::max(sideways, 0.5 * body)};
}

struct Ground {
  ScriptFrame frame;
  PathSize size{0.0, 0.0};
};

/// The highest place with room for the whole path, or else with the most room: the top of a scan may be a toe or a
/// horn.
Ground roomiestGround(const scene::World& world) {
  Ground best;
  for (const Index v : places(world)) {
    const ScriptFrame frame = frameAt(world.body->skin.positions[v], world.surface.geometry->vertex_normals[v]);
    const double diagonal = world.surface.geometry->tree.diagonal;
    const PathSize size = fittingSize(heightOver(world, frame), diagonal);
    if (size.sideways > best.size.sideways) best = {frame, size};
    if (size.sideways >= std::min(1.0, diagonal / kBackDiagonal)) break;
  }
  return best;
}

scene::Step makeStep(scene::Move move, double seconds) { return {.move = move, .seconds = seconds}; }

/// Ten seconds: press, drag away, circle there, drag back, lift.
scene::Finger automaticFinger(const PathSize& size, double radius_mm) {
  using scene::Move;
  scene::Finger finger;
  finger.name = "automatic";
  finger.radius_mm = radius_mm;
  finger.start_height_mm = size.depth * kAutomaticHover;
  finger.steps = {makeStep(Move::press, 1.5),  makeStep(Move::hold, 0.5), makeStep(Move::drag, 2.0),
                  makeStep(Move::circle, 3.0), makeStep(Move::drag, 2.0), makeStep(Move::lift, 1.0)};
  finger.steps[0].depth_mm = size.depth * kAutomaticDepth;
  finger.steps[2].by_mm = Vec2(size.sideways * kAutomaticDrag, 0.0);
  finger.steps[3].radius_mm = size.sideways * kAutomaticCircle;
  finger.steps[4].by_mm = -finger.steps[2].by_mm;
  finger.steps[5].height_mm = size.depth * kAutomaticHover;
  return finger;
}

}  // namespace

FingerPaths pathsOf(const scene::World& world) {
  const scene::Scene& scene = world.scene;
  const std::vector<Trajectory> trajectories = readFiles(scene);
  FingerPaths paths;
  paths.start_s = earliestStart(trajectories);
  for (std::size_t i = 0; i < scene.fingers.size(); ++i) {
    std::vector<Vec3> tips = computeTips(world, scene.fingers[i], trajectories[i], paths.start_s);
    paths.ticks = std::max(paths.ticks, tips.size());
    paths.tips.push_back(std::make_shared<const std::vector<Vec3>>(std::move(tips)));
  }
  if (scene.seconds > 0.0) paths.ticks = ticksIn(scene.seconds, scene.ticks_per_s);
  return paths;
}

Trajectory automaticPath(const scene::World& world, double radius_mm) {
  const Ground ground = roomiestGround(world);
  const double ticks_per_s = world.scene.ticks_per_s;
  Trajectory path;
  path.tip_mm = walkScript(automaticFinger(ground.size, radius_mm), ground.frame, heightOver(world, ground.frame),
                           1.0 / ticks_per_s);
  for (std::size_t k = 0; k < path.tip_mm.size(); ++k) path.time_s.push_back(static_cast<double>(k) / ticks_per_s);
  return path;
}

}  // namespace palpate::device

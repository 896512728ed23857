#include "palpate/device/finger_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/device/finger_script.h"
#include "palpate/partition/triangle_tree.h"

namespace palpate::device {

namespace {

/// The skin seen from outside along the frame's w.
SkinHeight heightOver(const scene::World& world, const ScriptFrame& frame) {
  const partition::TriangleTree& tree = world.surface.tree;
  const double far = 2.0 * tree.diagonal + (frame.origin - tree.center).norm();
  return [&tree, frame, far](double u, double v) -> std::optional<double> {
    const Vec3 on_plane = frame.origin + u * frame.u + v * frame.v;
    const auto hit = partition::firstFrontCrossing(tree, on_plane + far * frame.w, on_plane - far * frame.w);
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

std::vector<Vec3> tipsOf(const scene::World& world, const scene::Finger& finger, const Trajectory& trajectory,
                         double start_s) {
  const double ticks_per_s = world.scene.ticks_per_s;
  if (finger.findsItsOwnWay()) return automaticPath(world, finger.radius_mm).tip_mm;
  if (trajectory.size() == 0) return walkScript(finger, {}, heightOver(world, {}), 1.0 / ticks_per_s);
  const Trajectory on_ticks = resampled(trajectory, 1.0 / ticks_per_s);
  const double delay_s = trajectory.time_s.front() - start_s;
  if (delay_s > kMaxScriptS) {
    throw Error(fmt::format("finger '{}' would start {} s after the first one: one clock?", finger.name, delay_s));
  }
  return delayed(on_ticks.tip_mm, ticksIn(delay_s, ticks_per_s));
}

/// Vertices to try, the highest first: spread over those that face up and are not on a border, or over all vertices
/// when there is none such.
std::vector<Index> places(const scene::World& world) {
  constexpr std::size_t kMost = 200;  // a try costs a few hundred queries, so all of them well under a second
  std::vector<Index> facing_up;
  std::vector<Index> all;
  for (Index v = 0; v < world.skin.positions.size(); ++v) {
    all.push_back(v);
    if (world.surface.vertex_on_border[v] == 0 && world.surface.vertex_normals[v].z() > 0.5) facing_up.push_back(v);
  }
  std::vector<Index>& candidates = facing_up.empty() ? all : facing_up;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](Index a, Index b) { return world.skin.positions[a].z() > world.skin.positions[b].z(); });
  const std::size_t stride = (candidates.size() + kMost - 1) / kMost;
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

/// Whether the skin goes on, and falls off no steeper than about 40 degrees, wherever a path of this size leads.
bool fits(const SkinHeight& height, double size) {
  const double top = height(0.0, 0.0).value_or(0.0);
  for (double u = -kAutomaticCircle; u <= kAutomaticDrag + kAutomaticCircle; u += 0.5 * kAutomaticCircle) {
    for (double v = -kAutomaticCircle; v <= kAutomaticCircle; v += 0.5 * kAutomaticCircle) {
      const auto here = height(size * u, size * v);
      const double reach = size * (std::hypot(u, v) + kAutomaticDepth);
      if (!here || std::abs(*here - top) > 0.8 * reach) return false;
    }
  }
  return true;
}

/// Factors on the lengths above: sideways as far as the top allows, in depth at least half of what the body's size asks
/// for.
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
    const ScriptFrame frame = frameAt(world.skin.positions[v], world.surface.vertex_normals[v]);
    const double diagonal = world.surface.tree.diagonal;
    const PathSize size = fittingSize(heightOver(world, frame), diagonal);
    if (size.sideways > best.size.sideways) best = {frame, size};
    if (size.sideways >= std::min(1.0, diagonal / kBackDiagonal)) break;
  }
  return best;
}

scene::Step stepOf(scene::Move move, double seconds) {
  scene::Step step;
  step.move = move;
  step.seconds = seconds;
  return step;
}

/// Ten seconds: press, drag away, circle there, drag back, lift.
scene::Finger automaticFinger(const PathSize& size, double radius_mm) {
  using scene::Move;
  scene::Finger finger;
  finger.name = "automatic";
  finger.radius_mm = radius_mm;
  finger.start_height_mm = size.depth * kAutomaticHover;
  finger.steps = {stepOf(Move::press, 1.5),  stepOf(Move::hold, 0.5), stepOf(Move::drag, 2.0),
                  stepOf(Move::circle, 3.0), stepOf(Move::drag, 2.0), stepOf(Move::lift, 1.0)};
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
    std::vector<Vec3> tips = tipsOf(world, scene.fingers[i], trajectories[i], paths.start_s);
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

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

/// The highest vertex that faces up and is not on a border; any highest vertex when there is none such.
Index topVertex(const scene::World& world) {
  const auto rank = [&](Index v) {
    const bool inside = world.surface.vertex_on_border[v] == 0;
    const bool faces_up = world.surface.vertex_normals[v].z() > 0.5;
    return std::pair(int{inside} + int{faces_up}, world.skin.positions[v].z());
  };
  Index top = 0;
  for (Index v = 1; v < world.skin.positions.size(); ++v) {
    if (rank(v) > rank(top)) top = v;
  }
  return top;
}

ScriptFrame frameAt(const Vec3& origin, const Vec3& normal) {
  const Vec3 w = normal.norm() > 0.5 ? normal.normalized() : Vec3::UnitZ();
  const Vec3 side = std::abs(w.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 u = (side - side.dot(w) * w).normalized();
  return {origin, u, w.cross(u), w};
}

/// Ten seconds whose lengths suit a back, and shrink with smaller bodies.
scene::Finger automaticFinger(double diagonal, double radius_mm) {
  const double size = std::min(1.0, diagonal / 400.0);  // 400 mm: the length of a back
  const auto step = [](scene::Move move, double seconds) {
    scene::Step s;
    s.move = move;
    s.seconds = seconds;
    return s;
  };
  scene::Finger finger;
  finger.name = "automatic";
  finger.radius_mm = radius_mm;
  finger.start_height_mm = 10.0 * size;
  finger.steps = {step(scene::Move::press, 1.5),  step(scene::Move::hold, 0.5), step(scene::Move::drag, 2.0),
                  step(scene::Move::circle, 3.0), step(scene::Move::drag, 2.0), step(scene::Move::lift, 1.0)};
  finger.steps[0].depth_mm = 8.0 * size;
  finger.steps[2].by_mm = Vec2(30.0, 0.0) * size;
  finger.steps[3].radius_mm = 12.0 * size;
  finger.steps[4].by_mm = Vec2(-30.0, 0.0) * size;
  finger.steps[5].height_mm = 10.0 * size;
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
  const Index top = topVertex(world);
  const ScriptFrame frame = frameAt(world.skin.positions[top], world.surface.vertex_normals[top]);
  const double ticks_per_s = world.scene.ticks_per_s;
  Trajectory path;
  path.tip_mm = walkScript(automaticFinger(world.surface.tree.diagonal, radius_mm), frame, heightOver(world, frame),
                           1.0 / ticks_per_s);
  for (std::size_t k = 0; k < path.tip_mm.size(); ++k) path.time_s.push_back(static_cast<double>(k) / ticks_per_s);
  return path;
}

}  // namespace palpate::device

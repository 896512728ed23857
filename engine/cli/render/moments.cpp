#include "cli/render/moments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/servo/loop.h"
#include "palpate/servo/scripted_rig.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::app {

namespace {

/// Speed of a posed finger: slow enough for friction to hold as it would in life.
constexpr double kMmPerS = 100.0;
/// It starts this far above the skin.
constexpr double kApproachMm = 15.0;

std::uint64_t tickAt(const scene::World& world, double time_s) {
  return static_cast<std::uint64_t>(std::llround(time_s * world.scene.ticks_per_s));
}

/// The point above the skin nearest to the place, on its outside.
Vec3 startFor(const scene::World& world, const Vec3& place, double radius_mm) {
  const tree::TriangleTree& tree = world.surface.geometry->tree;
  const auto nearest = tree::nearestPoint(tree, place, 2.0 * tree.diagonal + (place - tree.center).norm());
  if (nearest.triangle == kNoIndex) return place;
  const auto& corners = tree.records[nearest.triangle].corners;
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  const double height = std::max((place - nearest.closest.point).dot(normal), radius_mm + kApproachMm);
  return nearest.closest.point + height * normal;
}

void walkTo(const Vec3& goal, double step_mm, std::vector<Vec3>& tips) {
  const Vec3 from = tips.back();
  const auto steps = static_cast<int>(std::ceil((goal - from).norm() / step_mm));
  for (int i = 1; i <= steps; ++i) tips.push_back(from + (goal - from) * (static_cast<double>(i) / steps));
}

}  // namespace

std::vector<servo::TickSamples> framesAt(const scene::World& world, const device::FingerPaths& paths,
                                         std::span<const double> times_s, const Progress& progress) {
  const double end_s = static_cast<double>(paths.ticks - 1) / world.scene.ticks_per_s;
  for (const double time_s : {times_s.front(), times_s.back()}) {  // they rise
    if (time_s >= 0.0 && time_s <= end_s + 1e-9) continue;
    throw Error(fmt::format("{} s is outside the run, which lasts from 0 to {:.3f} s", time_s, end_s));
  }
  std::vector<servo::TickSamples> frames;
  const auto collect = [&](std::span<const trace::Sample> samples) {
    while (frames.size() < times_s.size() && samples.front().tick >= tickAt(world, times_s[frames.size()])) {
      frames.emplace_back(samples.begin(), samples.end());
    }
  };
  servo::Rig rig = servo::scriptedRig(world, paths);
  servo::runHeadless(rig, tickAt(world, times_s.back()) + 1, collect, progress);
  return frames;
}

void useFingersAt(std::size_t poses, double radius_mm, scene::Scene& scene) {
  scene.fingers.clear();
  for (std::size_t i = 0; i < poses; ++i) {
    scene.fingers.emplace_back();
    scene.fingers.back().name = poses == 1 ? "finger" : fmt::format("finger_{}", scene.fingers.size());
    scene.fingers.back().radius_mm = radius_mm;
  }
}

device::FingerPaths pathsToPoses(const scene::World& world, std::span<const Pose> poses) {
  const double step_mm = kMmPerS / world.scene.ticks_per_s;
  device::FingerPaths paths;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose& places = poses[i];
    auto tips = std::make_shared<std::vector<Vec3>>(1, startFor(world, places[0], world.scene.fingers[i].radius_mm));
    for (const Vec3& place : places) walkTo(place, step_mm, *tips);
    paths.ticks = std::max(paths.ticks, tips->size());
    paths.tips.push_back(std::move(tips));
  }
  return paths;
}

}  // namespace palpate::app

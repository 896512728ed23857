// Tool and fingers run in passes of their own, each timed tick by tick with nothing else in the loop.
#include "lab/runs/tool_run.h"

#include <algorithm>
#include <span>
#include <utility>

#include "lab/counters/figures_json.h"
#include "lab/runs/timed_run.h"
#include "palpate/base/error.h"
#include "palpate/contact/surface_walk.h"
#include "palpate/contact/tool_shapes.h"

namespace palpate::bench {

namespace {

/// From part to part along the path: far enough on a slide that parts do not lie on each other.
constexpr double kBetweenPartsSeconds = 0.35;
/// Ticks over which the facing of the skin is averaged, against the noise of single triangles.
constexpr int kFacingTicks = 25;

using Shapes = std::vector<std::pair<std::string, contact::ToolShape>>;

Shapes shapes() {
  return {{"fingertip", contact::fingertipTool()},
          {"knuckle", contact::knuckleTool()},
          {"palm", contact::palmTool()},
          {"head", contact::headTool()},
          {"fingertips", contact::fingertipsTool()},
          {"hand", contact::handTool()}};
}

/// Out of the skin at every tip.
std::vector<Vec3> computeFacings(const contact::Surface& surface, std::span<const Vec3> tips) {
  std::vector<Vec3> normals;
  for (const Vec3& tip : tips) {
    const tree::NearestPoint nearest = nearestPoint(surface.geometry->tree, tip, contact::kUnbounded);
    normals.push_back(contact::normalAt(surface, {nearest.closest.point, nearest.triangle, nearest.closest.feature}));
  }
  std::vector<Vec3> smooth;
  const auto count = static_cast<int>(normals.size());
  for (int k = 0; k < count; ++k) {
    Vec3 sum = Vec3::Zero();
    for (int i = std::max(0, k - kFacingTicks); i <= std::min(count - 1, k + kFacingTicks); ++i) sum += normals[i];
    smooth.push_back(sum.normalized());
  }
  return smooth;
}

/// Poses of all parts, tick by tick.
class Poses {
 public:
  Poses(const ContactWorld& world, std::span<const Vec3> tips, double tick_s, std::size_t parts) : parts_(parts) {
    const std::vector<Vec3> facings = computeFacings(world.surface, tips);
    const auto lag = static_cast<std::size_t>(kBetweenPartsSeconds / tick_s);
    for (std::size_t k = 0; k < tips.size(); ++k) {
      for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t at = k < part * lag ? 0 : k - part * lag;
        const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), facings[at]).toRotationMatrix();
        poses_.push_back({tips[at], turn});
      }
    }
  }
  std::size_t ticks() const { return poses_.size() / parts_; }
  std::span<const contact::ToolPose> at(std::size_t tick) const {
    return std::span(poses_).subspan(tick * parts_, parts_);
  }
  void lift(double height_mm) {
    for (contact::ToolPose& pose : poses_) pose.position.z() += height_mm;
  }

 private:
  std::size_t parts_;
  std::vector<contact::ToolPose> poses_;
};

/// Result of a pass of the tool. Outputs of every pad in every tick would be too many.
struct ToolPass {
  std::vector<double> us;
  std::vector<std::size_t> touching;
  std::vector<contact::Wrench> wrenches;
  lab::ThreadCounts counts;
};

ToolPass timeToolPass(const ContactWorld& world, const contact::ToolShape& shape, const contact::FingerSettings& finger,
                      const Poses& poses) {
  ToolPass pass;
  pass.us.resize(poses.ticks());
  pass.touching.resize(poses.ticks());
  pass.wrenches.resize(poses.ticks());
  contact::ToolState state = contact::makeToolState(shape, world.surface);
  pass.counts = timeTicks(pass.us, [&](std::size_t k) {
    pass.wrenches[k] = contact::stepTool(world.surface, shape, finger, state, poses.at(k));
    pass.touching[k] = state.touching;
  });
  return pass;
}

contact::FingerOutput stepAlone(const ContactWorld& world, const contact::Pad& pad, contact::FingerSettings finger,
                                contact::FingerState& state, const contact::ToolPose& pose) {
  finger.radius_mm = pad.radius_mm;
  return contact::step(world.surface, finger, state, pose.position + pose.rotation * pad.offset);
}

/// A finger alone for every pad, all of them in a tick.
std::vector<double> timeSeparateFingers(const ContactWorld& world, const contact::ToolShape& shape,
                                        const contact::FingerSettings& finger, const Poses& poses) {
  std::vector<contact::FingerState> states(shape.pads.size());
  std::vector<contact::FingerOutput> felt(shape.pads.size());
  std::vector<double> us(poses.ticks());
  (void)timeTicks(us, [&](std::size_t k) {
    for (std::size_t i = 0; i < felt.size(); ++i) {
      felt[i] = stepAlone(world, shape.pads[i], finger, states[i], poses.at(k)[shape.pads[i].part]);
    }
  });
  return us;
}

std::size_t countDifferences(const ContactWorld& world, const contact::ToolShape& shape,
                             const contact::FingerSettings& finger, const Poses& poses) {
  contact::ToolState state = contact::makeToolState(shape, world.surface);
  std::vector<contact::FingerState> states(shape.pads.size());
  std::size_t different = 0;
  for (std::size_t k = 0; k < poses.ticks(); ++k) {
    (void)contact::stepTool(world.surface, shape, finger, state, poses.at(k));
    for (std::size_t i = 0; i < shape.pads.size(); ++i) {
      const contact::FingerOutput alone =
          stepAlone(world, shape.pads[i], finger, states[i], poses.at(k)[shape.pads[i].part]);
      const contact::FingerOutput& pad = state.felt[i];
      const bool same = alone.force == pad.force && alone.proxy == pad.proxy && alone.hold == pad.hold &&
                        alone.depth_mm == pad.depth_mm && alone.triangle == pad.triangle && alone.status == pad.status;
      different += same ? 0 : 1;
    }
  }
  return different;
}

Json toJson(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// From where the pads of a part are to where they rest, on average.
Vec3 wayOut(const contact::ToolShape& shape, const contact::ToolState& state, std::size_t part) {
  Vec3 sum = Vec3::Zero();
  double pads = 0.0;
  for (std::size_t i = 0; i < shape.pads.size(); ++i) {
    if (shape.pads[i].part != part) continue;
    const contact::FingerOutput& felt = state.felt[i];
    pads += 1.0;
    if (felt.touch != contact::Touch::free) sum += felt.proxy + shape.pads[i].radius_mm * felt.normal - felt.tip;
  }
  return sum / pads;
}

}  // namespace

std::vector<std::string> toolNames() {
  std::vector<std::string> names;
  for (const auto& [name, shape] : shapes()) names.push_back(name);
  return names;
}

contact::ToolShape toolNamed(std::string_view name) {
  for (auto& [known, shape] : shapes()) {
    if (known == name) return shape;
  }
  throw Error("unknown tool '" + std::string(name) + "'");
}

std::vector<contact::ToolPose> posesOnSkin(const ContactWorld& world, const device::Trajectory& trajectory,
                                           const contact::ToolShape& shape, const contact::FingerSettings& finger,
                                           const Window& window) {
  const device::Trajectory ticks = device::resampled(trajectory, finger.tick_s);
  const Poses poses(world, ticks.tip_mm, finger.tick_s, shape.rest.size());
  contact::ToolState state = contact::makeToolState(shape, world.surface);
  std::vector<contact::ToolPose> wanted;
  for (std::size_t k = 0; k < poses.ticks(); ++k) {
    (void)contact::stepTool(world.surface, shape, finger, state, poses.at(k));
    if (ticks.time_s[k] < window.from_s || ticks.time_s[k] >= window.until_s) continue;
    for (std::size_t part = 0; part < shape.rest.size(); ++part) {
      contact::ToolPose pose = poses.at(k)[part];
      pose.position += wayOut(shape, state, part);
      wanted.push_back(pose);
    }
  }
  return wanted;
}

Json measureTool(const ContactWorld& world, const device::Trajectory& trajectory, const contact::ToolShape& shape,
                 const contact::FingerSettings& finger, const Window& window) {
  contact::check(finger);
  const device::Trajectory ticks = device::resampled(trajectory, finger.tick_s);
  Poses poses(world, ticks.tip_mm, finger.tick_s, shape.rest.size());
  (void)timeToolPass(world, shape, finger, poses);  // warm-up: finds every page of code and surface
  const ToolPass pass = timeToolPass(world, shape, finger, poses);
  const std::vector<double> apart = timeSeparateFingers(world, shape, finger, poses);
  contact::Wrench largest;
  double peak_moment_n_mm = 0.0;
  std::vector<double> all_us, any_us, apart_us;
  for (std::size_t k = 0; k < poses.ticks(); ++k) {
    if (ticks.time_s[k] < window.from_s || ticks.time_s[k] >= window.until_s) continue;
    any_us.push_back(pass.us[k]);
    const contact::Wrench& wrench = pass.wrenches[k];
    if (wrench.force_n.norm() > largest.force_n.norm()) largest = wrench;
    peak_moment_n_mm = std::max(peak_moment_n_mm, wrench.moment_n_mm.norm());
    if (pass.touching[k] < shape.pads.size()) continue;
    all_us.push_back(pass.us[k]);
    apart_us.push_back(apart[k]);
  }
  const lab::Percentiles tick_us = lab::computePercentiles(all_us.empty() ? any_us : all_us);
  const lab::Percentiles apart_tick_us = lab::computePercentiles(all_us.empty() ? apart : apart_us);
  Json json;
  json["triangles"] = world.triangles;
  json["pads"] = shape.pads.size();
  json["parts"] = shape.rest.size();
  json["groups"] = contact::makeToolState(shape, world.surface).groups.size();
  json["ticks"] = any_us.size();
  json["all_touch_ticks"] = all_us.size();
  json["tick_us"] = percentilesJson(tick_us);
  json["any_tick_us"] = percentilesJson(lab::computePercentiles(std::move(any_us)));
  json["different"] = countDifferences(world, shape, finger, poses);
  poses.lift(world.surface.geometry->tree.diagonal);
  json["air_tick_us"] = percentilesJson(lab::computePercentiles(timeToolPass(world, shape, finger, poses).us));
  json["apart_tick_us"] = percentilesJson(apart_tick_us);
  json["ratio_to_apart"] = apart_tick_us.p50 > 0.0 ? tick_us.p50 / apart_tick_us.p50 : 0.0;
  json["wrench"] = {{"about_mm", toJson(largest.point)},
                    {"force_n", toJson(largest.force_n)},
                    {"moment_n_mm", toJson(largest.moment_n_mm)},
                    {"peak_moment_n_mm", peak_moment_n_mm}};
  addCounts(json, pass.counts);
  return json;
}

}  // namespace palpate::bench

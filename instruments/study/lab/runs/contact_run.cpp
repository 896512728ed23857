// Two runs, the first to find every page of code and surface; then one pass over the outputs for lag, friction and
// steps of force, one for falls, one for the hash.
#include "lab/runs/contact_run.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lab/runs/timed_run.h"
#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/contact/nearby_skin.h"
#include "palpate/mesh/repair.h"

namespace palpate::bench {
namespace {

/// A step longer than this is a teleport in the file (5 m/s at 1 kHz), not a movement.
constexpr double kTeleportMm = 5.0;
/// Ratios Ft / Fn are only read above this force: below it they are rounding over rounding.
constexpr double kMinNormalForceN = 1e-3;

bool inContact(const contact::FingerOutput& output) { return output.touch != contact::Touch::free; }

std::vector<lab::Observation> toObservations(const FingerRun& run, double radius) {
  std::vector<lab::Observation> ticks;
  ticks.reserve(run.outputs.size());
  for (const contact::FingerOutput& o : run.outputs) {
    ticks.push_back({o.tip, o.proxy + radius * o.normal, inContact(o), o.force.squaredNorm() > 0.0});
  }
  return ticks;
}

std::uint64_t hashOf(const FingerRun& run) {
  Hash hash;
  for (const contact::FingerOutput& o : run.outputs) {
    for (const Vec3* v : {&o.proxy, &o.anchor, &o.normal, &o.force}) hash.add(*v);
    hash.add(o.depth_mm);
    hash.add(static_cast<std::uint64_t>(o.touch));
    hash.add(static_cast<std::uint64_t>(o.triangle));
  }
  return hash.value();
}

/// Sums up the ticks of a window, each with the tick before it.
class FigureSum {
 public:
  explicit FigureSum(double scale) : scale_(scale) {}

  void add(const contact::FingerOutput& now, const contact::FingerOutput* before, std::size_t tick) {
    if (inContact(now)) addContact(now);
    if (before != nullptr && (now.tip - before->tip).norm() > kTeleportMm * scale_) {
      ++figures_.teleports;
      return;
    }
    if (before != nullptr) addForceStep((now.force - before->force).norm(), tick);
    figures_.peak_force_n = std::max(figures_.peak_force_n, now.force.norm());
    if (inContact(now)) addFriction(now);
  }
  ContactFigures finish() {
    figures_.lag_mm = lab::computePercentiles(std::move(lag_mm_));
    FrictionFigures& f = figures_.friction;
    if (f.slip_ticks > 0) f.kinetic /= static_cast<double>(f.slip_ticks);
    return figures_;
  }

 private:
  void addContact(const contact::FingerOutput& now) {
    ++figures_.contact_ticks;
    lag_mm_.push_back((now.hold - now.tip).norm() / scale_);
    figures_.peak_depth_mm = std::max(figures_.peak_depth_mm, now.depth_mm / scale_);
  }
  void addForceStep(double step, std::size_t tick) {
    if (step <= figures_.max_force_step_n) return;
    figures_.max_force_step_n = step;
    figures_.max_force_step_tick = tick;
  }
  void addFriction(const contact::FingerOutput& now) {
    const double normal = now.force.dot(now.normal);
    if (normal < kMinNormalForceN) return;
    const double ratio = (now.force - normal * now.normal).norm() / normal;
    FrictionFigures& f = figures_.friction;
    if (now.touch == contact::Touch::slip) {
      f.kinetic_min = f.slip_ticks == 0 ? ratio : std::min(f.kinetic_min, ratio);
      f.kinetic_max = std::max(f.kinetic_max, ratio);
      f.kinetic += ratio;
      ++f.slip_ticks;
    } else {
      f.static_peak = std::max(f.static_peak, ratio);
      ++f.stick_ticks;
    }
  }

  double scale_;
  ContactFigures figures_;
  std::vector<double> lag_mm_;
};

}  // namespace

mesh::TriangleMesh extractMesh(const contact::Surface& surface) {
  mesh::TriangleMesh mesh;
  mesh.positions.assign(surface.geometry->vertex_normals.size(), Vec3::Zero());
  mesh.triangles.resize(surface.geometry->tree.records.size());
  for (std::size_t r = 0; r < surface.geometry->tree.records.size(); ++r) {
    const tree::TriangleRecord& record = surface.geometry->tree.records[r];
    mesh.triangles[surface.geometry->tree.source_triangle[r]] = record.vertices;
    for (int corner = 0; corner < 3; ++corner) mesh.positions[record.vertices[corner]] = record.corners[corner];
  }
  return mesh;
}

ContactWorld buildContactWorld(mesh::TriangleMesh mesh_mm, double scale, double stiffness_n_per_mm) {
  if (!(scale > 0.0) || !std::isfinite(scale)) throw Error("the scale must be above 0");
  if (!(stiffness_n_per_mm > 0.0) || !std::isfinite(stiffness_n_per_mm)) throw Error("the stiffness must be above 0");
  const std::size_t triangles = mesh_mm.triangles.size();
  for (Vec3& p : mesh_mm.positions) p *= scale;
  const mesh::RepairResult repaired = mesh::repair(std::move(mesh_mm));
  // Force = stiffness * depth must not change with the unit of length, so the
  // stiffness per unit shrinks.
  std::vector<double> stiffness(repaired.mesh.positions.size(), stiffness_n_per_mm / scale);
  contact::SurfaceOptions options;
  options.self_intersecting = repaired.self_intersecting;
  contact::Surface surface = contact::buildSurface(repaired.mesh, std::move(stiffness), options);
  if (triangles <= contact::kMaxPlanes) surface.planes = contact::planesOf(surface.geometry);
  return {scale, stiffness_n_per_mm, triangles, std::move(surface), lab::SurfaceSide(repaired.mesh)};
}

std::vector<Vec3> scaledTips(const device::Trajectory& ticks, double scale) {
  std::vector<Vec3> tips = ticks.tip_mm;
  for (Vec3& tip : tips) tip *= scale;
  return tips;
}

FingerRun runFinger(const contact::Surface& surface, const contact::FingerSettings& settings,
                    std::span<const Vec3> tips) {
  contact::FingerState state;
  const auto skin = std::make_unique_for_overwrite<contact::FingerSkin>();
  return timedRun(tips,
                  [&](const Vec3& tip) { return contact::step(surface, settings, state, tip, nullptr, skin.get()); });
}

ContactFigures computeFigures(ContactWorld& world, const FingerRun& run, const contact::FingerSettings& real,
                              std::span<const double> time_s, const Window& window) {
  FigureSum sum(world.scale);
  std::vector<double> tick_us;
  std::size_t ticks = 0;
  for (std::size_t k = 0; k < run.outputs.size(); ++k) {
    if (time_s[k] < window.from_s || time_s[k] >= window.until_s) continue;
    sum.add(run.outputs[k], ticks == 0 ? nullptr : &run.outputs[k - 1], k);
    tick_us.push_back(run.tick_us[k]);
    ++ticks;
  }
  ContactFigures figures = sum.finish();
  figures.triangles = world.triangles;
  figures.ticks = ticks;
  figures.tick_us = lab::computePercentiles(std::move(tick_us));
  const double radius = real.radius_mm * world.scale;
  const std::vector<lab::Observation> observations = toObservations(run, radius);
  figures.falls = lab::checkFalls(world.side, observations, radius);
  if (radius > 0.0) figures.sphere = lab::checkSphere(world.side, observations, radius);
  figures.counts = run.counts;
  figures.hash = hashOf(run);
  return figures;
}

ContactFigures measureContact(ContactWorld& world, const device::Trajectory& trajectory,
                              const contact::FingerSettings& real, const Window& window, int rounds) {
  contact::check(real);
  const device::Trajectory ticks = device::resampled(trajectory, real.tick_s);
  const std::vector<Vec3> tips = scaledTips(ticks, world.scale);
  const contact::FingerSettings settings = contact::scaled(real, world.scale);
  (void)runFinger(world.surface, settings, tips);  // warm-up: finds every page of code and surface
  FingerRun run = runFinger(world.surface, settings, tips);
  for (int round = 1; round < rounds; ++round) {
    FingerRun again = runFinger(world.surface, settings, tips);
    for (std::size_t k = 0; k < run.tick_us.size(); ++k) again.tick_us[k] = std::min(run.tick_us[k], again.tick_us[k]);
    run = std::move(again);
  }
  return computeFigures(world, run, real, ticks.time_s, window);
}

}  // namespace palpate::bench

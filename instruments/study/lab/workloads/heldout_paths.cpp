// Paths find the surface by the oracle's own nearest point and never by the contact module, so that a fault of the
// finger cannot hide in them. Noise comes last: a path never feeds back on it.
#include "lab/workloads/heldout_paths.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "palpate/base/random.h"

namespace palpate::lab {
namespace {

Vec3 randomVector(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

/// Uniform over triangles, not over area: small triangles are where trouble is.
NearestPoint anySurfacePoint(SurfaceSide& surface, Random& random) {
  const auto& m = surface.mesh();
  const Triangle& t = m.triangles[random.below(m.triangles.size())];
  double u = random.uniform(), v = random.uniform();
  if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
  return surface.nearestTo((1.0 - u - v) * m.positions[t[0]] + u * m.positions[t[1]] + v * m.positions[t[2]]);
}

bool nearBorder(const SurfaceSide& surface, const PathSettings& settings, const Vec3& point) {
  return settings.off_border_mm > 0.0 && surface.distanceToBorder(point) < settings.off_border_mm;
}

NearestPoint randomSurfacePoint(SurfaceSide& surface, const PathSettings& settings, Random& random) {
  NearestPoint place = anySurfacePoint(surface, random);
  while (nearBorder(surface, settings, place.point)) place = anySurfacePoint(surface, random);
  return place;
}

void push(const Vec3& tip, device::Trajectory& path) {
  path.time_s.push_back(static_cast<double>(path.size()) / 1000.0);
  path.tip_mm.push_back(tip);
}

/// Adds noise last, so that it does not feed back into the path.
device::Trajectory withNoise(device::Trajectory path, double noise, Random& random) {
  if (noise > 0.0) {
    for (Vec3& tip : path.tip_mm) tip += noise * randomVector(random);
  }
  return path;
}

/// The nearest of some random surface points, or now and then any: short trips with a few long ones.
NearestPoint nextStop(SurfaceSide& surface, const PathSettings& settings, const Vec3& from, Random& random) {
  NearestPoint best = randomSurfacePoint(surface, settings, random);
  if (random.below(10) == 0) return best;
  for (int i = 0; i < 20; ++i) {
    const NearestPoint other = randomSurfacePoint(surface, settings, random);
    if ((other.point - from).norm() < (best.point - from).norm()) best = other;
  }
  return best;
}

}  // namespace

device::Trajectory rub(SurfaceSide& surface, const PathSettings& settings) {
  Random random(settings.seed);
  NearestPoint under = randomSurfacePoint(surface, settings, random);
  Vec3 heading = randomVector(random), tip = under.point + settings.start_above_mm * under.pseudo_normal;
  device::Trajectory path;
  for (std::size_t k = 0; k < settings.ticks; ++k) {
    push(tip, path);
    heading += 0.05 * heading.norm() * randomVector(random);
    heading -= heading.dot(under.pseudo_normal) * under.pseudo_normal;
    if (under.on_border || heading.norm() < 1e-9) heading = randomVector(random);
    heading.normalize();
    const NearestPoint next = surface.nearestTo(under.point + settings.step_mm * heading);
    if (nearBorder(surface, settings, next.point)) {
      heading = randomVector(random);
    } else {
      under = next;
    }
    const double t = static_cast<double>(k) / 1000.0, swing = 0.67 + 0.33 * std::sin(2 * std::numbers::pi * 2.3 * t);
    const double depth = std::fmod(t, 1.0) < 0.1 ? -settings.depth_mm : settings.depth_mm * swing;
    const Vec3 move = under.point - depth * under.pseudo_normal - tip;
    tip += move * std::min(1.0, 2.0 * settings.step_mm / std::max(move.norm(), 1e-300));
  }
  return withNoise(std::move(path), settings.noise_mm, random);
}

device::Trajectory tour(SurfaceSide& surface, const PathSettings& settings) {
  Random random(settings.seed);
  NearestPoint stop = randomSurfacePoint(surface, settings, random);
  Vec3 tip = stop.point + settings.start_above_mm * stop.pseudo_normal, goal = tip;
  device::Trajectory path;
  for (std::size_t k = 0; k < settings.ticks; ++k) {
    push(tip, path);
    if ((goal - tip).norm() <= settings.step_mm) {
      tip = goal;
      stop = nextStop(surface, settings, tip, random);
      goal = stop.point + random.uniform(-1.0, 1.0) * settings.depth_mm * stop.pseudo_normal;
    } else {
      tip += (goal - tip).normalized() * settings.step_mm;
    }
  }
  return withNoise(std::move(path), settings.noise_mm, random);
}

device::Trajectory aimed(SurfaceSide& surface, const PathSettings& settings) {
  Random random(settings.seed);
  const auto& m = surface.mesh();
  device::Trajectory path;
  while (path.size() + 3 <= settings.ticks) {
    const Triangle& t = m.triangles[random.below(m.triangles.size())];
    const auto corner = static_cast<std::size_t>(random.below(3));
    const double share = random.below(2) == 0 ? 0.0 : random.uniform();
    const Vec3& a = m.positions[t[corner]];
    const Vec3 target = a + share * (m.positions[t[(corner + 1) % 3]] - a);
    const NearestPoint nearest = surface.nearestTo(target);
    const Vec3 above = target + settings.depth_mm * nearest.pseudo_normal;
    const Vec3 below = target - settings.depth_mm * nearest.pseudo_normal;
    if (surface.sideOf(above) != Side::outside || surface.sideOf(below) != Side::inside) continue;
    push(above, path);
    push(target, path);
    push(below, path);
  }
  return path;
}

}  // namespace palpate::lab

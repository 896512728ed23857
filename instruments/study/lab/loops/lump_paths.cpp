// Closed paths, worlds of some lumps each: building an energy takes as long as two paths.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "lab/loops/closed_loop.h"
#include "lab/loops/lump_loops.h"
#include "lab/loops/shared_jobs.h"
#include "lab/workloads/random_lumps.h"
#include "palpate/base/elementary.h"
#include "palpate/contact/finger.h"

namespace palpate::lab {

namespace {

constexpr double kPlateNPerMm = 0.5;
constexpr std::size_t kPathsAWorld = 100;
constexpr std::size_t kHarmonics = 3;
/// Steps of the plan, twice and four times as long.
constexpr std::array<std::size_t, 3> kCoarser = {1, 2, 4};

std::uint64_t mixSeed(std::uint64_t seed, std::uint64_t number) {
  Random random(seed * 0x9e3779b97f4a7c15ull + number);
  random.bits();
  return random.bits();
}

/// Round and round its middle, in and out of the skin.
class ClosedPath {
 public:
  ClosedPath(const Vec3& middle, Random& random) : middle_(middle) {
    for (std::size_t k = 0; k < kHarmonics; ++k) {
      const double size = 8.0 / static_cast<double>(k + 1);
      for (auto* part : {&sines_[k], &cosines_[k]}) {
        *part = random.uniform3(-size, size);
        part->z() *= 0.4;
      }
    }
  }
  Vec3 at(double share) const {
    Vec3 place = middle_;
    for (std::size_t k = 0; k < kHarmonics; ++k) {
      const double turn = 2.0 * std::numbers::pi * static_cast<double>(k + 1) * share;
      place += elementary::sin(turn) * sines_[k] + elementary::cos(turn) * cosines_[k];
    }
    return place;
  }
  /// Number of steps of this length on average; a multiple of the coarsest.
  std::size_t steps(double step_mm) const {
    constexpr std::size_t kLooks = 400;
    double length = 0.0;
    for (std::size_t i = 0; i < kLooks; ++i) {
      length += (at(static_cast<double>(i + 1) / kLooks) - at(static_cast<double>(i) / kLooks)).norm();
    }
    constexpr auto kCoarsest = static_cast<double>(kCoarser.back());
    return kCoarser.back() * static_cast<std::size_t>(std::ceil(length / step_mm / kCoarsest));
  }

 private:
  Vec3 middle_;
  std::array<Vec3, kHarmonics> sines_, cosines_;
};

struct PathWork {
  std::array<double, kCoarser.size()> work_n_mm{};
  double stored_n_mm = 0.0;
  std::size_t ticks = 0;
};

PathWork workAlong(const ClosedPath& path, double step_mm, const contact::Surface& plate, double radius_mm) {
  contact::FingerSettings finger;
  finger.radius_mm = radius_mm;
  finger.mu_static = finger.mu_dynamic = 0.0;
  const std::size_t steps = path.steps(step_mm);
  PathWork result;
  contact::FingerState state;
  Vec3 tip = path.at(0.0);
  (void)contact::step(plate, finger, state, {tip.x(), tip.y(), radius_mm + 1.0});
  const Vec3 first = contact::step(plate, finger, state, tip).lump_force;
  std::array<Vec3, kCoarser.size()> tips, forces;
  tips.fill(tip);
  forces.fill(first);
  for (std::size_t i = 1; i <= steps; ++i) {
    tip = i == steps ? path.at(0.0) : path.at(static_cast<double>(i) / static_cast<double>(steps));
    const Vec3 force = contact::step(plate, finger, state, tip).lump_force;
    for (std::size_t k = 0; k < kCoarser.size(); ++k) {
      if (i % kCoarser[k] != 0) continue;
      result.work_n_mm[k] += 0.5 * (force + forces[k]).dot(tip - tips[k]);
      tips[k] = tip;
      forces[k] = force;
    }
    const double stored = contact::lumpEnergy(*plate.lumps, {}, {&state.lumps, 1});
    result.stored_n_mm = std::max(result.stored_n_mm, std::abs(stored));
  }
  result.ticks = steps;
  return result;
}

/// Some lumps next to each other in one place.
contact::Surface plateWithLumps(Random& random) {
  constexpr double kApartMm = 18.0;
  const tissue::LumpPlace place = randomLumpPlace(random);
  contact::Lumps lumps;
  const std::size_t count = 1 + random.below(3);
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 axis = Vec3::UnitZ() + 0.2 * random.uniform3(-1.0, 1.0);
    axis.normalize();
    const Vec3 foot(kApartMm * static_cast<double>(i), random.uniform(-6.0, 6.0), 0.0);
    lumps.all.push_back(randomLump(place, foot, axis, kPlateNPerMm, random));
  }
  PlateSettings settings;
  settings.stiffness_n_per_mm = kPlateNPerMm;
  settings.lumps = std::make_shared<const contact::Lumps>(std::move(lumps));
  return plateSurface(settings);
}

ClosedPathsFigures inOneWorld(const ClosedPathsPlan& plan, std::size_t world) {
  constexpr double kFingertipMm = 8.0;
  constexpr double kLeastStored = 1e-3;  // N mm; less is a path that missed its lumps
  Random random(mixSeed(plan.seed, world));
  const contact::Surface plate = plateWithLumps(random);
  ClosedPathsFigures sum;
  sum.lumps = plate.lumps->all.size();
  sum.by_steps.resize(kCoarser.size());
  const std::size_t paths = std::min(kPathsAWorld, plan.paths - world * kPathsAWorld);
  while (sum.paths < paths) {
    const double radius_mm = sum.paths % 2 == 0 ? 0.0 : kFingertipMm;
    const contact::Lump& lump = plate.lumps->all[random.below(sum.lumps)];
    const Vec3 middle = lump.foot + Vec3(0.0, 0.0, radius_mm - random.uniform(1.0, 5.0));
    const PathWork path = workAlong(ClosedPath(middle, random), plan.step_mm, plate, radius_mm);
    sum.ticks += path.ticks;
    if (path.stored_n_mm < kLeastStored) continue;
    ++sum.paths;
    for (std::size_t k = 0; k < kCoarser.size(); ++k) {
      const double share = std::abs(path.work_n_mm[k]) / path.stored_n_mm;
      sum.by_steps[k].mean_share += share;
      if (k == 0 && share > sum.worstShare()) {
        sum.worst_work_n_mm = std::abs(path.work_n_mm[0]);
        sum.stored_n_mm = path.stored_n_mm;
      }
      sum.by_steps[k].worst_share = std::max(sum.by_steps[k].worst_share, share);
    }
  }
  return sum;
}

}  // namespace

ClosedPathsFigures measureClosedPaths(const ClosedPathsPlan& plan, const Progress& progress) {
  const std::size_t worlds = (plan.paths + kPathsAWorld - 1) / kPathsAWorld;
  const auto all = sharedJobs(worlds, plan.threads, "following closed paths", progress,
                              [&plan](std::size_t world) { return inOneWorld(plan, world); });
  ClosedPathsFigures figures;
  figures.by_steps.resize(kCoarser.size());
  for (const ClosedPathsFigures& one : all) {
    figures.paths += one.paths;
    figures.ticks += one.ticks;
    figures.lumps += one.lumps;
    if (one.worstShare() > figures.worstShare()) {
      figures.worst_work_n_mm = one.worst_work_n_mm;
      figures.stored_n_mm = one.stored_n_mm;
    }
    for (std::size_t k = 0; k < kCoarser.size(); ++k) {
      figures.by_steps[k].mean_share += one.by_steps[k].mean_share;
      figures.by_steps[k].worst_share = std::max(figures.by_steps[k].worst_share, one.by_steps[k].worst_share);
    }
  }
  for (std::size_t k = 0; k < kCoarser.size(); ++k) {
    figures.by_steps[k].step_mm = plan.step_mm * static_cast<double>(kCoarser[k]);
    figures.by_steps[k].mean_share /= static_cast<double>(std::max<std::size_t>(1, figures.paths));
  }
  return figures;
}

}  // namespace palpate::lab

// Mobile lumps under simulated hands. The work of a tick is that of the forces along the straight way from where the
// tip was, with the lump where it is in that tick; between two ticks only the lump moves, and may only lose energy.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "lab/loops/lump_loops.h"
#include "lab/loops/random_loops.h"
#include "lab/loops/shared_jobs.h"
#include "lab/workloads/random_lumps.h"
#include "palpate/base/elementary.h"
#include "palpate/contact/finger.h"

namespace palpate::lab {

namespace {

constexpr double kSkinNPerMm = 0.5;
constexpr double kTicksPerS = 1000.0;
/// Share of a path with goals that move.
constexpr double kMovingShare = 0.8;
/// Share of a path, at its end, that is checked for oscillations.
constexpr double kWatchedShare = 0.1;

/// The most that a press of 5 mm pushes it sideways, N.
double maxSidewaysForce(const contact::Lump& lump) {
  constexpr double kPressMm = 5.0;
  double most = 0.0;
  for (double rho = 0.0; rho < lump.energy.reachMm(); rho += 0.5)
    most = std::max(most, std::abs(lump.energy.at(rho, kPressMm).d_rho));
  return most;
}

/// One that a finger can push out of the way.
contact::Lumps mobileLump(Random& random) {
  constexpr double kLeastSidewaysN = 0.1;
  for (;;) {
    const tissue::LumpPlace place = randomLumpPlace(random);
    contact::Lump lump = randomLump(place, Vec3::Zero(), Vec3::UnitZ(), kSkinNPerMm, random);
    if (maxSidewaysForce(lump) < kLeastSidewaysN) continue;
    loosen(lump, random);
    return {.all = {std::move(lump)}};
  }
}

/// Where a hand wants to be: from above the skin into it, here and there around the lump.
class Goal {
 public:
  /// `give`: how much farther than the tip a hand has to go that is pushed back.
  Goal(const Vec2& side, double give, Random& random) : side_(side), depth_mm_(give * random.uniform(3.0, 7.0)) {
    for (Vec3& size : sizes_) {
      size = random.uniform3(-5.0, 5.0);
      size.z() *= 0.3;
    }
  }
  Vec3 at(double seconds) const {
    constexpr double kDownS = 0.5;
    const double down = std::min(1.0, seconds / kDownS);
    Vec3 place(side_.x(), side_.y(), 2.0 - down * (2.0 + depth_mm_));
    for (std::size_t k = 0; k < sizes_.size(); ++k) {
      place += down * elementary::sin((1.3 + 2.1 * static_cast<double>(k)) * seconds) * sizes_[k];
    }
    return place;
  }

 private:
  Vec2 side_;
  double depth_mm_;
  std::array<Vec3, 3> sizes_;
};

/// Energy of skin and lumps with the tips pressing where they are.
double storedEnergy(const contact::Surface& plate, const contact::LumpPlaces& places, std::span<const Vec3> tips) {
  std::vector<contact::LumpPress> presses;
  double skin = 0.0;
  for (const Vec3& tip : tips) {
    const double depth = std::max(0.0, -tip.z());
    presses.push_back({tip, Vec3::UnitZ(), depth, depth > 0.0 ? 1.0 : 0.0});
    skin += 0.5 * kSkinNPerMm * depth * depth;
  }
  return skin + contact::lumpEnergy(*plate.lumps, places, presses);
}

/// Force on a finger there that came straight down.
Vec3 forceAt(const contact::Surface& plate, const contact::LumpPlaces& places, const Vec3& tip) {
  contact::FingerSettings finger;
  finger.mu_static = finger.mu_dynamic = 0.0;
  contact::FingerState state;
  (void)contact::step(plate, finger, state, {tip.x(), tip.y(), 1.0}, &places);
  return contact::step(plate, finger, state, tip, &places).force;
}

/// Work against the forces along a straight way, by Gauss' rule on both sides of where it meets the skin.
double workAlong(const contact::Surface& plate, const contact::LumpPlaces& places, const Vec3& from, const Vec3& to) {
  constexpr std::array<double, 3> kAt = {0.1127016653792583, 0.5, 0.8872983346207417};
  constexpr std::array<double, 3> kWeight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  if (from.z() > 0.0 && to.z() > 0.0) return 0.0;
  const bool crosses = (from.z() > 0.0) != (to.z() > 0.0);
  const double meets = crosses ? from.z() / (from.z() - to.z()) : 0.0;
  const double begins = from.z() > 0.0 ? meets : 0.0;
  const double ends = to.z() > 0.0 ? meets : 1.0;
  double work = 0.0;
  for (std::size_t i = 0; i < kAt.size(); ++i) {
    const Vec3 tip = from + (begins + (ends - begins) * kAt[i]) * (to - from);
    work -= kWeight[i] * (ends - begins) * forceAt(plate, places, tip).dot(to - from);
  }
  return work;
}

/// Number of turns of a value by more than this: a slow creep does not.
int countReversals(const std::vector<double>& values, double most) {
  int turns = 0;
  int direction = 0;
  double farthest = values.front();  // in that direction
  for (const double value : values) {
    const double on = direction >= 0 ? value - farthest : farthest - value;
    if (direction == 0) {
      if (std::abs(on) > most) direction = on > 0.0 ? 1 : -1;
      if (direction != 0) farthest = value;
    } else if (on > 0.0) {
      farthest = value;
    } else if (on < -most) {
      ++turns;
      direction = -direction;
      farthest = value;
    }
  }
  return turns;
}

/// Coordinates of tips and lump over the last ticks.
class Watch {
 public:
  explicit Watch(std::size_t fingers) : tracks_(3 * fingers + 2) {}
  void add(ClosedLoop& loop, std::size_t fingers, const Vec2& moved) {
    for (std::size_t i = 0; i < fingers; ++i) {
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        tracks_[3 * i + static_cast<std::size_t>(axis)].push_back(loop.hand(i).place()[axis]);
    }
    tracks_[3 * fingers].push_back(moved.x());
    tracks_[3 * fingers + 1].push_back(moved.y());
  }
  bool swings(double most_mm) const {
    constexpr int kThereAndBack = 2;
    return std::ranges::any_of(tracks_,
                               [&](const auto& track) { return countReversals(track, most_mm) >= kThereAndBack; });
  }

 private:
  std::vector<std::vector<double>> tracks_;
};

/// A device and a hand, and how the tick is closed over both.
LoopPlan makeLoopPlan(contact::Lumps lumps, std::uint64_t number) {
  RandomCell cell{.stiffness_n_per_mm = kSkinNPerMm};
  cell.lumps = std::make_shared<const contact::Lumps>(std::move(lumps));
  return randomLoop(cell, number);
}

std::vector<Goal> drawGoals(const device::HandModel& hand, std::size_t fingers, Random& random) {
  const double aside = random.uniform(2.0, 6.0);
  const Vec2 side(aside, random.uniform(-3.0, 3.0));
  double give = 1.0 + kSkinNPerMm / hand.stiffness_n_per_mm;
  if (hand.grip_n_per_mm > 0.0) give += kSkinNPerMm / hand.grip_n_per_mm;
  std::vector<Goal> goals;
  for (std::size_t i = 0; i < fingers; ++i) goals.emplace_back(i == 0 ? side : Vec2(-side), give, random);
  return goals;
}

ClosedLoop loopAt(const LoopPlan& plan, std::span<const Goal> goals) {
  LoopSettings settings = makeLoopSettings(plan);
  settings.hand.start = goals[0].at(0.0);
  for (const Goal& goal : goals.subspan(1)) settings.more_hands.push_back(goal.at(0.0));
  return ClosedLoop(settings);
}

HeldLumpsFigures heldOnce(const HeldLumpsPlan& plan, std::size_t number) {
  constexpr double kFeltMm = 0.1;
  Random random((plan.seed + 1) * 0x9e3779b97f4a7c15ull + number);
  const std::size_t fingers = 1 + number % 2;
  const LoopPlan hands = makeLoopPlan(mobileLump(random), number);
  const std::vector<Goal> goals = drawGoals(hands.hand, fingers, random);
  ClosedLoop loop = loopAt(hands, goals);
  const contact::LumpPlaces& places = loop.rig().fingers.front().solver.lumps->places();
  const auto ticks = static_cast<std::size_t>(plan.seconds * kTicksPerS);
  const auto watched = static_cast<std::size_t>((1.0 - kWatchedShare) * static_cast<double>(ticks));
  HeldLumpsFigures figures;
  Watch watch(fingers);
  std::vector<Vec3> tips;
  for (std::size_t i = 0; i < fingers; ++i) tips.push_back(loop.hand(i).place());
  double put_in = 0.0;
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    const double seconds = std::min(static_cast<double>(tick) / kTicksPerS, kMovingShare * plan.seconds);
    for (std::size_t i = 0; i < fingers; ++i) loop.hand(i).goal.place = goals[i].at(seconds);
    loop.tick();
    for (std::size_t i = 0; i < fingers; ++i) {
      const Vec3& tip = loop.samples()[i].contact.tip;
      put_in += workAlong(loop.surface(), places, tips[i], tip);
      tips[i] = tip;
    }
    const double balance = put_in - storedEnergy(loop.surface(), places, tips);
    figures.given_back_n_mm = std::max(figures.given_back_n_mm, -balance);
    figures.lost_n_mm = std::max(figures.lost_n_mm, balance);
    figures.farthest_mm = std::max(figures.farthest_mm, places.moved_mm[0].norm());
    if (tick >= watched) watch.add(loop, fingers, places.moved_mm[0]);
  }
  figures.paths = 1;
  figures.with_two_fingers = fingers == 2 ? 1 : 0;
  figures.felt = figures.farthest_mm >= kFeltMm ? 1 : 0;
  figures.oscillating = watch.swings(2.0 * hands.device.encoder_mm) ? 1 : 0;
  return figures;
}

}  // namespace

HeldLumpsFigures measureHeldLumps(const HeldLumpsPlan& plan, const Progress& progress) {
  const auto all = sharedJobs(plan.paths, plan.threads, "holding mobile lumps", progress,
                              [&plan](std::size_t number) { return heldOnce(plan, number); });
  HeldLumpsFigures sum;
  for (const HeldLumpsFigures& one : all) {
    sum.paths += one.paths;
    sum.with_two_fingers += one.with_two_fingers;
    sum.felt += one.felt;
    sum.oscillating += one.oscillating;
    sum.given_back_n_mm = std::max(sum.given_back_n_mm, one.given_back_n_mm);
    sum.lost_n_mm = std::max(sum.lost_n_mm, one.lost_n_mm);
    sum.farthest_mm = std::max(sum.farthest_mm, one.farthest_mm);
  }
  return sum;
}

StiffestLumpFigures measureStiffestLump(const StiffestLumpPlan& plan, const Progress& progress) {
  constexpr double kFastMmPerS = 500.0;
  RandomCell cell{.stiffness_n_per_mm = kSkinNPerMm, .delay_ticks = plan.delay_ticks};
  const contact::Lump stiffest = stiffestLump(Vec3::Zero(), Vec3::UnitZ(), kSkinNPerMm);
  cell.lumps = std::make_shared<const contact::Lumps>(contact::Lumps{.all = {stiffest}});
  const auto all =
      sharedJobs(plan.systems, plan.threads, "kicking over the stiffest lump", progress, [&cell](std::size_t number) {
        LoopPlan loop = randomLoop(cell, number);
        StiffestLumpFigures one;
        const auto swings = [&] { return kick(loop).oscillates(loop.device.encoder_mm) ? 1 : 0; };
        one.oscillating = swings();
        const double phase = 0.1 * static_cast<double>(number % 10);
        one.port_energy_mj = tap(loop, kFastMmPerS, phase).port_energy_mj;
        loop.protection = Protection::none;
        one.oscillating_bare = swings();
        return one;
      });
  StiffestLumpFigures sum;
  sum.systems = all.size();
  sum.slope_n_per_mm = kSkinNPerMm + stiffest.energy.steepest().depth;
  for (const StiffestLumpFigures& one : all) {
    sum.oscillating += one.oscillating;
    sum.oscillating_bare += one.oscillating_bare;
    sum.port_energy_mj = std::max(sum.port_energy_mj, one.port_energy_mj);
  }
  return sum;
}

}  // namespace palpate::lab

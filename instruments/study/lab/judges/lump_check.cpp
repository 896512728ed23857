#include "lab/judges/lump_check.h"

#include <algorithm>
#include <cmath>

namespace palpate::lab {

namespace {

/// Rounding of forces, N, and of energies, N mm.
constexpr double kLumpRounding = 1e-6;
constexpr double kEnergyRounding = 1e-9;
/// A lump moves no farther in a tick.
constexpr double kLongestMoveMm = 0.5;

Vec2 tipOffset(const contact::Lump& lump, const Vec2& moved, const Vec3& tip) {
  const Vec3 away = tip - lump.foot;
  return {away.dot(lump.across) - moved.x(), away.dot(lump.up) - moved.y()};
}

/// The energy of one lump under a press whose normal does not lean.
double energyOf(const contact::Lump& lump, const Vec2& moved, const Vec3& tip, double depth_mm) {
  return lump.energy.at(tipOffset(lump, moved, tip).norm(), depth_mm).energy_n_mm;
}

/// Energy of springs and presses together, with the shares that the presses have.
double energyOf(const contact::Lumps& lumps, const contact::LumpPlaces& places,
                std::span<const contact::LumpPress> presses) {
  double sum = 0.0;
  for (std::size_t i = 0; i < lumps.all.size(); ++i) {
    sum += 0.5 * lumps.all[i].mobility.spring_n_per_mm * places.moved_mm[i].squaredNorm();
    // A press that leans away from a lump's axis is felt in part, which the lump's own energy leaves out.
    for (const contact::LumpPress& press : presses) {
      const double facing = std::clamp(2.0 * press.normal.dot(lumps.all[i].axis), 0.0, 1.0);
      const double share = press.share * facing * facing * (3.0 - 2.0 * facing);
      if (share > 0.0) sum += share * energyOf(lumps.all[i], places.moved_mm[i], press.tip, press.depth_mm);
    }
  }
  return sum;
}

/// Whether every lump that the press could feel is felt as a whole.
bool facesAll(const contact::Lumps& lumps, const contact::LumpPlaces& places, const contact::LumpPress& press) {
  for (std::size_t i = 0; i < lumps.all.size(); ++i) {
    const contact::Lump& lump = lumps.all[i];
    if (tipOffset(lump, places.moved_mm[i], press.tip).norm() > lump.energy.reachMm() + 1.0) continue;
    if (press.normal.dot(lump.axis) < 0.51) return false;
  }
  return true;
}

}  // namespace

LumpCheck::LumpCheck(const contact::Lumps& lumps, const contact::FingerSettings& settings, std::size_t fingers)
    : lumps_(lumps), settings_(settings), last_(fingers) {
  for (const contact::Lump& lump : lumps.all) {
    const tissue::LumpSteepness steepest = lump.energy.steepest();
    steepest_n_per_mm_ += steepest.depth + steepest.rho;
  }
}

void LumpCheck::moved(const contact::LumpPlaces& before, const contact::LumpPlaces& after,
                      std::span<const contact::LumpPress> presses) {
  ++tick_;
  shifted_mm_ = 0.0;
  for (std::size_t i = 0; i < lumps_.all.size(); ++i) {
    const contact::LumpMobility& mobility = lumps_.all[i].mobility;
    const double moved_mm = (after.moved_mm[i] - before.moved_mm[i]).norm();
    shifted_mm_ = std::max(shifted_mm_, moved_mm);
    const double most = mobility.moves() ? kLongestMoveMm : 0.0;
    if (!(moved_mm <= most + kEnergyRounding))
      reportFault(Fault::lump_moved, "a lump's motion in a tick, mm", moved_mm, most);
    const double away = after.moved_mm[i].norm();
    if (away > mobility.limit_mm + kEnergyRounding)
      reportFault(Fault::lump_moved, "a lump's distance from its place, mm", away, mobility.limit_mm);
  }
  const double gained = energyOf(lumps_, after, presses) - energyOf(lumps_, before, presses);
  if (!(gained <= kEnergyRounding))
    reportFault(Fault::lump_moved, "energy that a lump's motion made, N mm", gained, 0.0);
}

void LumpCheck::add(std::size_t finger, const contact::LumpPress& press, const contact::LumpPlaces& places,
                    const contact::FingerOutput& felt) {
  if ((felt.status & contact::kTipLost) != 0) return;
  Last& last = last_[finger];
  if (last.known) judgeForceStep(last, felt);
  judgeForce(press, places, felt);
  last = {true, felt.tip, felt.lump_force};
}

/// Minus the slope of the energy, by differences.
void LumpCheck::judgeForce(const contact::LumpPress& press, const contact::LumpPlaces& places,
                           const contact::FingerOutput& felt) {
  constexpr double kStepMm = 1e-4;
  if (!felt.lump_force.allFinite()) {
    reportFault(Fault::lump_force, "force of lumps that is not finite, N", felt.lump_force.norm(), 0.0);
    return;
  }
  if (felt.touch == contact::Touch::free) {
    if (!felt.lump_force.isZero(0.0))
      reportFault(Fault::lump_force, "force of lumps on a free finger, N", felt.lump_force.norm(), 0.0);
    return;
  }
  if (press.depth_mm < 2.0 * kStepMm || !facesAll(lumps_, places, press)) return;
  Vec3 expected = Vec3::Zero();
  for (std::size_t i = 0; i < lumps_.all.size(); ++i) {
    const contact::Lump& lump = lumps_.all[i];
    const Vec2& moved = places.moved_mm[i];
    const auto slope = [&](const Vec3& aside, double deeper) {
      return (energyOf(lump, moved, press.tip + aside, press.depth_mm + deeper) -
              energyOf(lump, moved, press.tip - aside, press.depth_mm - deeper)) /
             (2.0 * kStepMm);
    };
    expected += slope(Vec3::Zero(), kStepMm) * press.normal;
    for (const Vec3* along : {&lump.across, &lump.up}) expected -= slope(kStepMm * *along, 0.0) * *along;
  }
  // Splines bend at their knots, and a difference over one is off by as much.
  const double bound = kLumpRounding + 2.0 * kStepMm * steepest_n_per_mm_;
  const double off = (felt.lump_force - press.share * expected).norm();
  if (!(off <= bound)) reportFault(Fault::lump_force, "force of lumps beside the slope of their energy, N", off, bound);
}

void LumpCheck::judgeForceStep(const Last& last, const contact::FingerOutput& felt) {
  constexpr double kLoose = 6.0;  // a normal that turns, a mixed slope, a lump that is faced less
  const double motion_mm = 3.0 * (felt.tip - last.tip).norm() + settings_.catch_up_mm_per_s * settings_.tick_s;
  const double bound = kLoose * steepest_n_per_mm_ * (motion_mm + shifted_mm_) + kLumpRounding;
  const double step = (felt.lump_force - last.force).norm();
  if (!(step <= bound)) reportFault(Fault::lump_step, "step of the lumps' force, N", step, bound);
}

void LumpCheck::reportFault(Fault fault, const char* what, double measured, double bound) {
  Finding& finding = findings_[static_cast<std::size_t>(fault)];
  if (finding.ticks > 0 && finding.first_tick + 1 == tick_) return;  // it counts once a tick
  if (finding.ticks == 0) {
    finding.first_tick = tick_ - 1;
    finding.what = what;
    finding.measured = measured;
    finding.bound = bound;
  }
  ++finding.ticks;
}

void LumpCheck::addTo(HuntReport& report) const {
  for (std::size_t f = 0; f < kFaults; ++f) {
    if (findings_[f].ticks > 0) report.findings[f] = findings_[f];
  }
}

}  // namespace palpate::lab

#include "palpate/lumps/lump_observer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"

namespace palpate::lumps {

namespace {

constexpr std::size_t kMaxCells = contact::kMaxTaxels * contact::kMaxTaxels;

double normalForce(const contact::FingerOutput& felt) noexcept { return felt.force.dot(felt.normal); }

/// The greatest rise of a taxel over itself in the press without lumps; over softer lumps the greatest fall.
double computePatternChange(const contact::FingerOutput& with, const contact::FingerOutput& without,
                            const contact::Lumps* lumps, const contact::PressureGround& ground,
                            std::size_t taxels) noexcept {
  // Share of the greatest taxel: changes of weaker ones at the rim are taken over at least this. A tenfold change of
  // almost nothing cannot be felt.
  constexpr double kFaint = 0.1;
  const std::size_t count = taxels * taxels;
  if (count == 0 || count > kMaxCells) return 0.0;
  std::array<double, kMaxCells> over;
  std::array<double, kMaxCells> beside;
  const contact::PressurePad pad{.taxels = taxels};
  contact::pressureField(ground, lumps, with, pad, std::span(over).first(count));
  contact::pressureField(ground, nullptr, without, pad, std::span(beside).first(count));
  const double least = kFaint * *std::max_element(beside.begin(), beside.begin() + static_cast<std::ptrdiff_t>(count));
  if (!(least > 0.0)) return 0.0;
  const double sign = normalForce(with) < normalForce(without) ? -1.0 : 1.0;
  double change = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    change = std::max(change, sign * (over[i] - beside[i]) / std::max(beside[i], least));
  }
  return change;
}

}  // namespace

double standardNormalBelow(double x) noexcept { return 0.5 * (1.0 + elementary::erf(x / std::sqrt(2.0))); }

void check(const LumpObserver& observer) {
  const auto positive = [](const char* name, double value) {
    if (!(value > 0.0) || !std::isfinite(value)) {
      throw Error(fmt::format("lump observer: {} = {} must be above 0", name, value));
    }
  };
  positive("force_weber", observer.force_weber);
  positive("pattern_weber", observer.pattern_weber);
  positive("spread", observer.spread);
  if (observer.taxels == 1 || observer.taxels > contact::kMaxTaxels) {
    throw Error(fmt::format("lump observer: taxels = {} is out of range: {} to {}, or 0", observer.taxels,
                            contact::kMinTaxels, contact::kMaxTaxels));
  }
}

LumpCue computeCue(const contact::FingerOutput& with, const contact::FingerOutput& without, const contact::Lumps* lumps,
                   const contact::PressureGround& ground, std::size_t taxels) noexcept {
  const double plain_n = normalForce(without);
  if (with.touch == contact::Touch::free || !(plain_n > 0.0)) return {};
  return {.force = normalForce(with) / plain_n - 1.0,
          .pattern = computePatternChange(with, without, lumps, ground, taxels)};
}

LumpCue computeCue(const contact::FingerOutput& felt, const contact::Lumps* lumps,
                   const contact::PressureGround& ground, std::size_t taxels) noexcept {
  contact::FingerOutput without = felt;
  without.force -= felt.lump_force;
  without.lump_force = Vec3::Zero();
  without.lump_share = 0.0;
  return computeCue(felt, without, lumps, ground, taxels);
}

double computeClarity(const LumpCue& cue, const LumpObserver& observer) noexcept {
  const double force = cue.force / observer.force_weber;
  const bool feels = observer.field && observer.taxels > 0;
  const double pattern = feels ? cue.pattern / observer.pattern_weber : 0.0;
  return std::sqrt(force * force + pattern * pattern);
}

double detectionProbability(double clarity, const LumpObserver& observer) noexcept {
  if (!(clarity > 0.0)) return 0.0;
  return (1.0 - kInattention) * standardNormalBelow(elementary::log(clarity) / observer.spread);
}

double twoIntervals(double clarity) noexcept { return standardNormalBelow(clarity / std::sqrt(2.0)); }

double drawSkill(const LumpObserver& observer, Random& random) {
  return observer.spread * std::sqrt(0.5) * random.normal();
}

bool finds(double clarity, double skill, const LumpObserver& observer, Random& random) {
  const double luck = observer.spread * std::sqrt(0.5) * random.normal();
  const bool attends = random.uniform() >= kInattention;
  return attends && clarity > 0.0 && elementary::log(clarity) + skill + luck > 0.0;
}

double drawStroke(Random& random) { return random.uniform(-0.5 * kStrokesApartMm, 0.5 * kStrokesApartMm); }

ComparedSkin::ComparedSkin(contact::Surface surface, std::shared_ptr<const contact::PressureGround> ground,
                           const contact::FingerSettings& finger)
    : with_(std::move(surface)), without_(with_), ground_(std::move(ground)), finger_(finger) {
  contact::check(finger_);
  without_.lumps = nullptr;
}

ComparedSkin::Press ComparedSkin::press(const Vec3& place, const Vec3& normal, double force_n) const {
  constexpr double kAboveMm = 2.0;
  constexpr double kStepMm = 0.1;  // a press of 100 mm/s: without relaxation the pace changes nothing
  contact::FingerState alone;
  contact::FingerState over;
  Press press;
  const auto tip_at = [&](double depth_mm) { return Vec3(place + (finger_.radius_mm - depth_mm) * normal); };
  double depth_mm = -kAboveMm;
  double before_n = 0.0;
  const auto both = [&](double to_mm) {
    press.without = contact::step(without_, finger_, alone, tip_at(to_mm));
    press.with = contact::step(with_, finger_, over, tip_at(to_mm));
  };
  both(depth_mm);
  while (depth_mm < finger_.max_depth_mm && !press.reached) {
    before_n = normalForce(press.without);
    depth_mm += kStepMm;
    both(depth_mm);
    press.reached = normalForce(press.without) >= force_n;
  }
  if (!press.reached) return press;
  const double rise_n = normalForce(press.without) - before_n;
  if (rise_n > 0.0) both(depth_mm - kStepMm * (normalForce(press.without) - force_n) / rise_n);
  return press;
}

LumpCue ComparedSkin::cue(const Press& press, std::size_t taxels) const noexcept {
  return computeCue(press.with, press.without, with_.lumps.get(), *ground_, taxels);
}

}  // namespace palpate::lumps

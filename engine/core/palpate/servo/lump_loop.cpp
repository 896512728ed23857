// Called once a finger and tick by finger_solver.cpp, and only where a lump moves.
#include "palpate/servo/lump_loop.h"

#include <algorithm>
#include <limits>

namespace palpate::servo {

namespace {

bool isSame(const contact::Lump& one, const contact::Lump& other) noexcept {
  return one.foot == other.foot && one.axis == other.axis;
}

/// The lump's number in another world, most likely the same; their count: it is not there.
std::size_t numberIn(const contact::Lumps& other, const contact::Lump& lump, std::size_t number) noexcept {
  if (number < other.all.size() && isSame(other.all[number], lump)) return number;
  const auto found =
      std::find_if(other.all.begin(), other.all.end(), [&](const contact::Lump& one) { return isSame(one, lump); });
  return static_cast<std::size_t>(found - other.all.begin());
}

Vec2 within(const Vec2& moved_mm, double limit_mm) noexcept {
  const double distance = moved_mm.norm();
  return distance > limit_mm ? Vec2(moved_mm * (limit_mm / distance)) : moved_mm;
}

}  // namespace

const contact::LumpPlaces& LumpLoop::begin(const contact::Lumps& lumps, std::size_t finger,
                                           const contact::LumpPress& last, double tick_s) noexcept {
  Finger& here = fingers_[finger];
  here.press = last;  // it may have been lifted
  if (here.felt) {
    for (std::size_t i = 0; i < fingers_.size(); ++i) {
      presses_[i] = fingers_[i].press;
      fingers_[i].felt = false;
    }
    contact::moveLumps(lumps, presses_, tick_s, places_);
  }
  here.felt = true;
  if (placed_ < contact::kMaxLumps) places_.moved_mm[placed_] = placed_at_mm_;
  placed_ = contact::kMaxLumps;
  return places_;
}

void LumpLoop::carryOver(const contact::Lumps& lumps, const LumpLoop& before,
                         const contact::Lumps& lumps_before) noexcept {
  for (std::size_t i = 0; i < lumps.all.size(); ++i) {
    const contact::Lump& lump = lumps.all[i];
    const std::size_t there = numberIn(lumps_before, lump, i);
    const bool stays = there < lumps_before.all.size() && lump.mobility.moves();
    places_.moved_mm[i] = stays ? within(before.places_.moved_mm[there], lump.mobility.limit_mm) : Vec2(Vec2::Zero());
  }
  const std::size_t count = std::min(fingers_.size(), before.fingers_.size());
  std::copy_n(before.fingers_.begin(), count, fingers_.begin());
}

void LumpLoop::forget(const contact::Lumps& lumps) noexcept {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < lumps.all.size(); ++i) {
    if (lumps.all[i].mobility.moves()) places_.moved_mm[i].setConstant(kNowhere);
  }
}

void LumpLoop::place(std::size_t lump, const Vec2& moved_mm) noexcept {
  placed_ = lump;
  placed_at_mm_ = moved_mm;
}

}  // namespace palpate::servo

#include "palpate/training/trainee/imagined_touch.h"

#include <algorithm>
#include <cmath>

#include "palpate/training/session/trial_scene.h"

namespace palpate::training {

namespace {

// Durations of the closed loop (trainee_finger.cpp): from over one site to over the next, down to the requested force,
// up.
constexpr double kImaginedTravelS = 0.3;
constexpr double kImaginedDownS = 0.36;
constexpr double kImaginedUpS = 0.2;
constexpr double kImaginedHoverMm = 10.0;

int toTicks(double seconds) { return std::max(1, static_cast<int>(std::lround(seconds / kImaginedTickS))); }

}  // namespace

ImaginedTouch::ImaginedTouch(const Protocol& protocol, SessionKind kind)
    : protocol_(protocol), meaning_(settingsOf(protocol, kind).block.meaning) {}

double ImaginedTouch::stiffnessAt(int site) const {
  const bool here = hidden_ && hidden_->site == site;
  return protocol_.base_n_per_mm * (here ? feltRatio(protocol_.hidden, hidden_->change, meaning_) : 1.0);
}

void ImaginedTouch::feel(const Vec3& tip, double force_n, double depth_mm, const EachTick& each_tick) {
  trace::Sample sample;
  sample.tick = next_++;
  sample.contact = {};
  sample.contact.tip = sample.contact.proxy = sample.contact.anchor = sample.contact.hold = tip;
  if (force_n > 0.0) {
    sample.contact.touch = contact::Touch::stick;
    sample.contact.normal = Vec3::UnitZ();
    sample.contact.tip.z() -= depth_mm;
    sample.contact.depth_mm = depth_mm;
    sample.contact.force = sample.device_force = Vec3(0, 0, force_n);
  }
  each_tick(sample);
}

void ImaginedTouch::travelTo(const Vec3& place, const EachTick& each_tick) {
  const Vec3 over = place + Vec3(0, 0, kImaginedHoverMm);
  const Vec3 from = place_.value_or(over);
  const int ticks = toTicks(kImaginedTravelS);
  for (int i = 1; i <= ticks; ++i) feel(from + (over - from) * (static_cast<double>(i) / ticks), 0, 0, each_tick);
  place_ = over;
}

FeltPress ImaginedTouch::press(const Site& site, const MeantPress& meant, const EachTick& each_tick) {
  const double stiffness = stiffnessAt(site.number);
  const Vec3 place = site.point_mm + Vec3(meant.beside_mm.x(), meant.beside_mm.y(), 0.0);
  travelTo(place, each_tick);
  const auto ramp = [&](double seconds, double from, double to) {
    const int ticks = toTicks(seconds);
    for (int i = 1; i <= ticks; ++i) {
      const double force_n = meant.force_n * (from + (to - from) * (static_cast<double>(i) / ticks));
      feel(place, force_n, force_n / stiffness, each_tick);
    }
  };
  ramp(kImaginedDownS, 0.0, 1.0);
  ramp(meant.hold_s, 1.0, 1.0);
  ramp(kImaginedUpS, 1.0, 0.0);
  return {.force_n = meant.force_n, .depth_mm = meant.force_n / stiffness, .reached = true};
}

void ImaginedTouch::rest(double seconds, const EachTick& each_tick) {
  const int ticks = toTicks(seconds);
  for (int i = 0; i < ticks; ++i) feel(place_.value_or(Vec3::Zero()), 0, 0, each_tick);
}

}  // namespace palpate::training

// One smooth window along the spine times a ramp from the still plane to the back. Its slopes are some per cent, so
// that the way back from a moved place is a fixed point found in a few rounds. Each tick of each finger; no allocation.
//
// Sources: docs/explanation/bodies.md (breathing).
#include "palpate/body/trunk/breathing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "palpate/base/elementary.h"
#include "palpate/body/signed_distance.h"

namespace palpate::body {

namespace {

constexpr double kNeckShare = 0.25;  // share of the lift that shoulders and neck follow
constexpr double kFarthest = 1.2;    // end of the ramp: beyond the back's skin the field continues for a little only
constexpr int kRounds = 3;           // each reduces the error to the field's slope, 0.02

}  // namespace

std::optional<BreathField> BreathField::of(const Breathing& breathing, std::span<const SkinLandmark> landmarks,
                                           const std::optional<Support>& support, double front_z) {
  const std::array<std::string_view, 5> levels = {"spinous_L5", "spinous_T12", "spinous_T10", "spinous_T8",
                                                  "spinous_T2"};
  std::array<Vec3, 5> places;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const SkinLandmark* landmark = findLandmark(landmarks, levels[i]);
    if (landmark == nullptr || (i > 0 && landmark->position.y() <= places[i - 1].y())) return std::nullopt;
    places[i] = landmark->position;
  }
  const auto& [pelvis, ribs_low, ribs, ribs_high, neck] = places;
  if (!breathing.on || !(front_z < ribs.z())) return std::nullopt;
  BreathField field;
  field.breathing_ = breathing;
  field.pelvis_y_ = pelvis.y();
  field.ribs_low_y_ = ribs_low.y();
  field.ribs_high_y_ = ribs_high.y();
  field.neck_y_ = neck.y();
  const bool lies = support && support->normal.z() > 0.5;
  field.still_z_ = lies ? support->point.z() : 0.5 * (front_z + ribs.z());
  field.back_z_ = ribs.z();
  return field;
}

double BreathField::lift(double seconds) const noexcept {
  const double breaths = seconds * breathing_.per_minute / 60.0;
  const double turn = 2.0 * std::numbers::pi * (breaths - std::floor(breaths));
  return breathing_.depth_mm * 0.5 * (1.0 - elementary::cos(turn));
}

double BreathField::share(const Vec3& rest) const noexcept {
  const double below = smoothStep(pelvis_y_, ribs_low_y_, rest.y());
  const double above = 1.0 - (1.0 - kNeckShare) * smoothStep(ribs_high_y_, neck_y_, rest.y());
  const double out = std::clamp((rest.z() - still_z_) / (back_z_ - still_z_), -kFarthest, kFarthest);
  return below * above * out;
}

Vec3 BreathField::moved(const Vec3& rest, double lift_mm) const noexcept {
  return rest + Vec3(0, 0, lift_mm * share(rest));
}

Vec3 BreathField::rest(const Vec3& moved, double lift_mm) const noexcept {
  Vec3 rest = moved;
  for (int round = 0; round < kRounds; ++round) rest.z() = moved.z() - lift_mm * share(rest);
  return rest;
}

}  // namespace palpate::body

// Cells of a grid that the contact covers -> their pattern without lumps -> bumps -> the two sums -> taxels.
//
// Constants and forms: fitted to finite elements, docs/explanation/lumps.md.
#include "palpate/contact/pressure_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/contact/pad_cells.h"
#include "palpate/tissue/force_law.h"

namespace palpate::contact {

namespace {

/// Cells along a side, at least: a fingertip's contact, some 10 mm across, is 5 of them wide on the usual pad.
constexpr std::size_t kMinCells = 8;
constexpr double kKpaMm2PerN = 1000.0;

/// Cells along the side of a taxel.
std::size_t cellsPerTaxel(const PressurePad& pad) noexcept { return (kMinCells + pad.taxels - 1) / pad.taxels; }

/// The cells that a contact of this pattern covers.
PadCover coverPad(const PressurePad& pad, const tissue::PressurePattern& pattern, double finger_mm, PadCells& cells) {
  // A touch that is smaller than the cells lies on the middle ones.
  constexpr double kMinContact = 1.1;
  const std::size_t side = pad.taxels * cellsPerTaxel(pad);
  const double per_mm = static_cast<double>(side) / pad.size_mm;
  const PadContact contact{std::max(per_mm * pattern.contact_radius_mm, kMinContact), per_mm * finger_mm,
                           pattern.exponent};
  return coverCells(side, contact, cells);
}

/// A lump under the pad. Lengths are in cells.
struct Bump {
  Vec2 foot = Vec2::Zero();  ///< from the tip, along u and v
  double width = 1.0;
  double extra_n = 0.0;  ///< what it adds to the normal force
};

/// Adds one lump's bump to those of the cells, whose plain forces add up to `plain` and make `per_n` of 1 N; what it
/// adds everywhere.
double addBump(const Bump& bump, double circle, double plain, double per_n, PadCells& cells) {
  constexpr double kFlat = 1e-3;  // of the bump: less is a pattern that the bump cannot carry its force in
  const PadKernel kernel = makeKernel(bump.foot.x(), bump.foot.y(), bump.width, circle, cells);
  const double base = tissue::kBumpBase * kernel.mean;
  const double carried = kernel.sum - base * plain;
  if (!(carried > kFlat * kernel.sum)) return 0.0;  // the last scaling spreads its force evenly
  const double strength = bump.extra_n * per_n / carried;
  commitKernel(strength, cells);
  return -strength * base;
}

/// The forces e^(g . lever) times as large whose levers have the mean `target`: positive as they were, whatever the
/// target. Newton's method on a convex function; a target beyond the contact's own rim is approached. Rarely needed.
void tilt(const Vec2& target, PadCells& cells) {
  constexpr int kRounds = 40;
  constexpr double kExact = 1e-12;
  constexpr double kLongest = 40.0;  // of an exponent, in a step
  const auto lever = [&cells](std::size_t i) {
    return Vec2(cells.lever[i] * Vec2(cells.x[i % cells.across], -cells.x[i / cells.across]));
  };
  for (int round = 0; round < kRounds; ++round) {
    double sum = 0.0, uu = 0.0, uv = 0.0, vv = 0.0;
    Vec2 mean = Vec2::Zero();
    for (std::size_t i = cells.begin(); i < cells.end(); ++i) {
      const double f = cells.force[i];
      if (!(f > 0.0)) continue;
      const Vec2 at = lever(i);
      sum += f;
      mean += f * at;
      uu += f * at.x() * at.x();
      uv += f * at.x() * at.y();
      vv += f * at.y() * at.y();
    }
    mean /= sum;
    const double a = uu / sum - mean.x() * mean.x(), b = uv / sum - mean.x() * mean.y();
    const double d = vv / sum - mean.y() * mean.y();
    const Vec2 off = target - mean;
    const double determinant = a * d - b * b;
    if (std::abs(off.x()) + std::abs(off.y()) < kExact || !(determinant > 0.0)) return;
    Vec2 step((d * off.x() - b * off.y()) / determinant, (a * off.y() - b * off.x()) / determinant);
    if (const double size = step.norm(); size > kLongest) step *= kLongest / size;
    for (std::size_t i = cells.begin(); i < cells.end(); ++i) {
      if (cells.force[i] > 0.0) cells.force[i] *= elementary::exp(step.dot(lever(i)));
    }
    const double before = sum;
    sum = momentsOf(cells).normal;
    scaleTo(before / sum, cells.force, cells);
  }
}

/// Makes the raised forces, all >= 0 and with these moments, forces that add up to `normal_n` and whose moments are
/// minus the lateral force: by a share of the plain pattern that grows along the pad, and where that would pull on the
/// skin by a tilt.
PadSums balanceForces(const PadMoments& raised, double slope, double normal_n, const Vec2& lateral_n, PadCells& cells) {
  const double factor = raised.normal > 0.0 ? normal_n / raised.normal : 0.0;
  const double per_slope = slope > 0.0 ? 1.0 / slope : 0.0;
  const double gain_u = (-lateral_n.x() - factor * raised.u) * per_slope;
  const double gain_v = (-lateral_n.y() - factor * raised.v) * per_slope;
  PadMoments after;
  if (!lean(factor, gain_u, gain_v, cells, after)) {
    scaleTo(factor, cells.raised, cells);
    tilt(-lateral_n / normal_n, cells);
    after = momentsOf(cells);
  }
  return {after.normal, {-after.u, -after.v}};
}

/// Where the lump's foot is in the pad's plane.
Vec2 footInPad(const Lump& lump, const Vec2& moved_mm, const FingerOutput& felt, const PadPlane& plane) {
  const Vec3 from_tip = lump.foot + moved_mm.x() * lump.across + moved_mm.y() * lump.up - felt.tip;
  return {from_tip.dot(plane.u), from_tip.dot(plane.v)};
}

/// The normal force that each lump adds.
struct Pushes {
  std::size_t count = 0;
  std::array<double, kMaxLumps> push;
  std::array<Vec2, kMaxLumps> moved;
};

/// `extra_n`: what they add together.
void fillPushes(const Lumps& lumps, const FingerOutput& felt, double extra_n, Pushes& pushes) {
  const LumpPress press{felt.tip, felt.normal, felt.depth_mm, 1.0};
  double all = 0.0;
  pushes.count = std::min(lumps.all.size(), kMaxLumps);
  for (std::size_t i = 0; i < pushes.count; ++i) {
    pushes.moved[i] = i == felt.lump ? felt.lump_moved_mm : Vec2(Vec2::Zero());
    pushes.push[i] = normalPush(lumps.all[i], pushes.moved[i], press);
    all += pushes.push[i];
  }
  // Relaxation and the hand-over of worlds leave this share of it.
  const double left = all != 0.0 && extra_n / all > 0.0 ? std::min(extra_n / all, 10.0) : 1.0;
  for (std::size_t i = 0; i < pushes.count; ++i) pushes.push[i] *= left;
}

/// The pattern of the layers with these lumps in them, which add to a force of `plain_n`.
tissue::PressurePattern overLumps(const Lumps& lumps, const Pushes& pushes, double plain_n,
                                  const tissue::PressurePattern& pattern) {
  double sum = 0.0;
  for (std::size_t i = 0; i < pushes.count; ++i) {
    const double widening = tissue::wideningOf(lumps.all[i].shape, lumps.all[i].skin_mm);
    if (widening > 0.0) sum += pushes.push[i] * widening;
  }
  // Small lumps do not widen the pattern, so it need not wait for their pushes.
  return sum != 0.0 ? tissue::overLumps(pattern, sum / plain_n) : pattern;
}

/// The forces of the cells with the bumps of all lumps; the plain ones stand for `plain_n`.
PadMoments addBumps(const Lumps& lumps, const Pushes& pushes, const FingerOutput& felt, const PadPlane& plane,
                    double per_mm, double circle, double plain, double plain_n, PadCells& cells) {
  constexpr double kUnfelt = 1e-5;  // of the force: a smaller bump is lost among the taxels
  const double normal_n = felt.force.dot(felt.normal);
  const double per_n = plain / plain_n;
  double level = 1.0;
  for (std::size_t i = 0; i < pushes.count; ++i) {
    if (!(std::abs(pushes.push[i]) > kUnfelt * normal_n)) continue;
    const Lump& lump = lumps.all[i];
    const Bump bump{.foot = per_mm * footInPad(lump, pushes.moved[i], felt, plane),
                    .width = per_mm * tissue::bumpWidth(lump.shape, lump.skin_mm, felt.depth_mm),
                    .extra_n = pushes.push[i]};
    level += addBump(bump, circle, plain, per_n, cells);
  }
  return raiseForces(level, cells);
}

/// A taxel is the sum of its cells, whose values stand for `kpa_each` where they are alone in it.
void writeTaxels(const PadCells::Values& values, double kpa_each, const PadCells& cells, const PressurePad& pad,
                 std::span<double> kpa) {
  const std::size_t split = cellsPerTaxel(pad);
  alignas(64) PadCells::Values rows;
  sumRows(values, split, cells, rows);
  for (std::size_t row = 0; row < pad.taxels; ++row) {
    const double* cell = &rows[row * cells.across];
    for (std::size_t i = 0; i < pad.taxels; ++i, cell += split) {
      double sum = cell[0];
      for (std::size_t part = 1; part < split; ++part) sum += cell[part];
      kpa[row * pad.taxels + i] = kpa_each * sum;
    }
  }
}

}  // namespace

PadPlane padPlane(const Vec3& normal) noexcept {
  constexpr double kAlong = 0.9;  // a normal that points to the head leaves no direction towards it
  const Vec3 head = std::abs(normal.y()) < kAlong ? Vec3::UnitY() : Vec3::UnitZ();
  const double lean = head.dot(normal);
  const double inverse = 1.0 / std::sqrt(1.0 - lean * lean);
  return {.u = inverse * head.cross(normal), .v = inverse * (head - lean * normal)};
}

PressureGround::PressureGround(std::vector<Place> places) : places_(std::move(places)) {
  if (places_.empty()) throw Error("pressure: at least one layer stack must have a field");
  for (const Place& place : places_) logs_.push_back(elementary::log(place.thickness_mm));
}

tissue::PressurePattern PressureGround::at(double tissue_mm, double depth_mm, double finger_mm) const noexcept {
  std::size_t next = 0;
  while (next < places_.size() && places_[next].thickness_mm < tissue_mm) ++next;
  const Place& thick = places_[std::min(next, places_.size() - 1)];
  const Place& thin = places_[next == 0 ? 0 : next - 1];
  const tissue::PressurePattern one = thin.form.at(depth_mm, finger_mm);
  if (&thin == &thick) return one;
  const tissue::PressurePattern other = thick.form.at(depth_mm, finger_mm);
  const double share = (elementary::log(tissue_mm) - logs_[next - 1]) / (logs_[next] - logs_[next - 1]);
  return {one.contact_radius_mm + share * (other.contact_radius_mm - one.contact_radius_mm),
          one.exponent + share * (other.exponent - one.exponent)};
}

PadSums pressureField(const PressureGround& ground, const Lumps* lumps, const FingerOutput& felt,
                      const PressurePad& pad, std::span<double> kpa, std::span<Vec2> shear_kpa) noexcept {
  const double normal_n = felt.force.dot(felt.normal);
  if (felt.touch == Touch::free || !(normal_n > 0.0)) {
    std::fill(kpa.begin(), kpa.end(), 0.0);
    std::fill(shear_kpa.begin(), shear_kpa.end(), Vec2(Vec2::Zero()));
    return {};
  }
  const double finger_mm = felt.finger_mm > 0.0 ? felt.finger_mm : tissue::kFingertipMm;
  const PadPlane plane = padPlane(felt.normal);
  const double extra_n = felt.lump_force.dot(felt.normal);
  const bool has_lumps = lumps != nullptr && !felt.lump_force.isZero(0.0) && normal_n > extra_n;
  tissue::PressurePattern pattern = ground.at(felt.tissue_mm, felt.depth_mm, finger_mm);
  const double plain_n = has_lumps ? normal_n - extra_n : normal_n;
  Pushes pushes;
  if (has_lumps) {
    fillPushes(*lumps, felt, extra_n, pushes);
    pattern = overLumps(*lumps, pushes, plain_n, pattern);
  }
  PadCells cells;
  const PadCover cover = coverPad(pad, pattern, finger_mm, cells);
  const double side_mm = pad.size_mm / static_cast<double>(pad.taxels);
  const double kpa_per_n = kKpaMm2PerN / (side_mm * side_mm);
  PadSums sums{normal_n, Vec2::Zero()};
  if (has_lumps) {
    const double per_mm = static_cast<double>(cells.side) / pad.size_mm;
    const PadMoments raised = addBumps(*lumps, pushes, felt, plane, per_mm, 0.5 * per_mm * pattern.contact_radius_mm,
                                       cover.normal, plain_n, cells);
    sums = balanceForces(raised, cover.slope, normal_n, {felt.lump_force.dot(plane.u), felt.lump_force.dot(plane.v)},
                         cells);
    writeTaxels(cells.force, kpa_per_n, cells, pad, kpa);
  } else {
    writeTaxels(cells.plain, kpa_per_n * (plain_n / cover.normal), cells, pad, kpa);
  }
  if (!shear_kpa.empty()) {
    const Vec3 friction = felt.force - felt.lump_force;
    const Vec2 shear = Vec2(friction.dot(plane.u), friction.dot(plane.v)) / normal_n;
    for (std::size_t i = 0; i < kpa.size(); ++i) shear_kpa[i] = kpa[i] * shear;
  }
  return sums;
}

}  // namespace palpate::contact

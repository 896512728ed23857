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
#include "palpate/tissue/force_law.h"

namespace palpate::contact {

namespace {

/// Cells along a side, at least: a fingertip's contact, some 10 mm across, is 5 of them wide on the usual pad.
constexpr std::size_t kMinCells = 8;
constexpr std::size_t kMaxCells = kMaxTaxels * kMaxTaxels;
constexpr double kKpaMm2PerN = 1000.0;

/// The cells that the contact covers, side by side for loops that need no branch.
struct Cells {
  std::size_t count = 0;
  std::array<std::uint16_t, kMaxCells> taxel;
  std::array<double, kMaxCells> x, y;              ///< of the middle, mm along u and v
  std::array<double, kMaxCells> lever_u, lever_v;  ///< x / sqrt(R^2 - r^2): lateral over normal force
  std::array<double, kMaxCells> plain;             ///< N, without lumps
  std::array<double, kMaxCells> force;             ///< N
};

/// t^q for t in [0, 1]. The binomial series of the fourth root, to a third of a percent for t above 0.05; the C
/// library's power would cost as much as all the rest.
double powerOf(double t, double q) noexcept {
  constexpr double kMaxSeries = 0.5;
  if (q > kMaxSeries) return elementary::pow(t, q);
  const double n = 4.0 * q;
  const double s = std::sqrt(std::sqrt(t)) - 1.0;
  return 1.0 + n * s * (1.0 + 0.5 * (n - 1.0) * s * (1.0 + (n - 2.0) / 3.0 * s));
}

/// A cell of the grid, by its distance from the middle lines of the pad.
struct CellForm {
  double covered = 0.0;  ///< share that the contact covers; 0: none
  double lever = 0.0;    ///< 1 / sqrt(R^2 - r^2)
  double plain = 0.0;    ///< pressure, not to scale
};

CellForm cellForm(double x, double y, double size_mm, double contact_mm, double finger_mm, double exponent) noexcept {
  CellForm form;
  const double r2 = x * x + y * y;
  const double rim = contact_mm + 0.5 * size_mm;
  if (r2 >= rim * rim) return form;
  const double r = std::sqrt(r2);
  // A cell at the rim is covered in part, from the inside: no taxel jumps when the contact grows.
  form.covered = std::min(1.0, (contact_mm - r) / size_mm + 0.5);
  if (!(form.covered > 0.0)) return {};
  const double middle = form.covered < 1.0 ? contact_mm - 0.5 * form.covered * size_mm : r;
  const double lever_mm = std::min(middle, 0.97 * finger_mm);  // a lever ends before the equator of the tip
  if (r > 0.0) form.lever = lever_mm / (r * std::sqrt(finger_mm * finger_mm - lever_mm * lever_mm));
  const double share = middle / contact_mm;
  form.plain = form.covered * powerOf(std::max(0.0, 1.0 - share * share), exponent);
  return form;
}

/// The forms of a quarter of the grid, which the others mirror.
struct QuarterForms {
  static constexpr std::size_t kMost = kMaxTaxels / 2;
  std::array<CellForm, kMost * kMost> forms;
  std::size_t half = 0;  ///< along a side, the middle line of an odd grid included

  /// Of how many cells from the outer row and column.
  const CellForm& at(std::size_t row, std::size_t column, std::size_t side) const noexcept {
    return forms[std::min(row, side - 1 - row) * half + std::min(column, side - 1 - column)];
  }
};

QuarterForms quarterForms(std::size_t side, double size_mm, double contact_mm, double finger_mm, double exponent) {
  QuarterForms quarter;
  quarter.half = (side + 1) / 2;
  const double middle = 0.5 * static_cast<double>(side) - 0.5;
  for (std::size_t i = 0; i < quarter.half; ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      const double x = (middle - static_cast<double>(i)) * size_mm;
      const double y = (middle - static_cast<double>(k)) * size_mm;
      quarter.forms[i * quarter.half + k] = quarter.forms[k * quarter.half + i] =
          cellForm(x, y, size_mm, contact_mm, finger_mm, exponent);
    }
  }
  return quarter;
}

/// Fills the cells that a contact of this pattern covers, the plain forces not yet to scale.
void coverCells(const PressurePad& pad, const tissue::PressurePattern& pattern, double finger_mm, Cells& cells) {
  const std::size_t split = (kMinCells + pad.taxels - 1) / pad.taxels;
  const std::size_t side = pad.taxels * split;
  const double size_mm = pad.size_mm / static_cast<double>(side);
  // A touch that is smaller than the cells lies on the middle ones.
  constexpr double kMinContact = 1.1;
  const double contact_mm = std::max(pattern.contact_radius_mm, kMinContact * size_mm);
  const QuarterForms quarter = quarterForms(side, size_mm, contact_mm, finger_mm, pattern.exponent);
  for (std::size_t row = 0; row < side; ++row) {
    const double y = 0.5 * pad.size_mm - (static_cast<double>(row) + 0.5) * size_mm;
    for (std::size_t column = 0; column < side; ++column) {
      const CellForm& form = quarter.at(row, column, side);
      if (!(form.covered > 0.0)) continue;
      const double x = (static_cast<double>(column) + 0.5) * size_mm - 0.5 * pad.size_mm;
      const std::size_t i = cells.count++;
      cells.taxel[i] = static_cast<std::uint16_t>(row / split * pad.taxels + column / split);
      cells.x[i] = x;
      cells.y[i] = y;
      cells.lever_u[i] = x * form.lever;
      cells.lever_v[i] = y * form.lever;
      cells.plain[i] = form.plain;
    }
  }
}

double sumOf(const std::array<double, kMaxCells>& values, std::size_t count) {
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += values[i];
  return sum;
}

void scaleTo(double force_n, std::array<double, kMaxCells>& values, std::size_t count) {
  const double sum = sumOf(values, count);
  const double factor = sum > 0.0 ? force_n / sum : 0.0;
  for (std::size_t i = 0; i < count; ++i) values[i] *= factor;
}

/// A lump under the pad.
struct Bump {
  Vec2 foot = Vec2::Zero();  ///< from the tip, along u and v
  double width_mm = 1.0;
  double base = 0.0;     ///< K0
  double extra_n = 0.0;  ///< what it adds to the normal force
};

/// Adds one lump's bump to the shares of the plain force.
void addBump(const Cells& cells, const Bump& bump, std::array<double, kMaxCells>& share) {
  constexpr double kFlat = 1e-3;  // of the bump: less is a pattern that the bump cannot carry its force in
  std::array<double, kMaxCells> kernel;
  double carried = 0.0;
  double whole = 0.0;
  const double inverse = 1.0 / (bump.width_mm * bump.width_mm);
  for (std::size_t i = 0; i < cells.count; ++i) {
    const double x = cells.x[i] - bump.foot.x();
    const double y = cells.y[i] - bump.foot.y();
    const double u = 1.0 + (x * x + y * y) * inverse;
    const double value = 1.0 / (u * u * std::sqrt(u));
    kernel[i] = value - bump.base;
    carried += cells.plain[i] * kernel[i];
    whole += cells.plain[i] * value;
  }
  if (!(carried > kFlat * whole)) return;  // the last scaling spreads its force evenly
  const double strength = bump.extra_n / carried;
  for (std::size_t i = 0; i < cells.count; ++i) share[i] += strength * kernel[i];
}

/// The forces e^(g . lever) times as large whose levers have the mean `target`: positive as they were, whatever the
/// target. Newton's method on a convex function; a target beyond the contact's own rim is approached.
void tilt(const Vec2& target, Cells& cells) {
  constexpr int kRounds = 40;
  constexpr double kExact = 1e-12;
  constexpr double kLongest = 40.0;  // of an exponent, in a step
  for (int round = 0; round < kRounds; ++round) {
    double sum = 0.0, u = 0.0, v = 0.0, uu = 0.0, uv = 0.0, vv = 0.0;
    for (std::size_t i = 0; i < cells.count; ++i) {
      const double f = cells.force[i];
      sum += f;
      u += f * cells.lever_u[i];
      v += f * cells.lever_v[i];
      uu += f * cells.lever_u[i] * cells.lever_u[i];
      uv += f * cells.lever_u[i] * cells.lever_v[i];
      vv += f * cells.lever_v[i] * cells.lever_v[i];
    }
    u /= sum;
    v /= sum;
    const double a = uu / sum - u * u, b = uv / sum - u * v, d = vv / sum - v * v;
    const double off_u = target.x() - u, off_v = target.y() - v;
    const double determinant = a * d - b * b;
    if (std::abs(off_u) + std::abs(off_v) < kExact || !(determinant > 0.0)) return;
    Vec2 step((d * off_u - b * off_v) / determinant, (a * off_v - b * off_u) / determinant);
    if (const double size = step.norm(); size > kLongest) step *= kLongest / size;
    for (std::size_t i = 0; i < cells.count; ++i) {
      cells.force[i] *= elementary::exp(step.x() * cells.lever_u[i] + step.y() * cells.lever_v[i]);
    }
    scaleTo(sum, cells.force, cells.count);
  }
}

/// What forces of the cells add up to. One pass: the sums run side by side.
struct CellSums {
  double normal = 0.0, moment_u = 0.0, moment_v = 0.0;
  void add(const Cells& cells, std::size_t i, double force) noexcept {
    normal += force;
    moment_u += force * cells.lever_u[i];
    moment_v += force * cells.lever_v[i];
  }
  PadSums padSums() const noexcept { return {normal, {-moment_u, -moment_v}}; }
};

CellSums sumsOf(const Cells& cells) noexcept {
  CellSums sums;
  for (std::size_t i = 0; i < cells.count; ++i) sums.add(cells, i, cells.force[i]);
  return sums;
}

/// Makes the forces, all >= 0, add up to `normal_n` and their moments to minus the lateral force: by a share of the
/// plain pattern that grows along the pad, and where that would pull on the skin by a tilt.
PadSums keepSums(double normal_n, const Vec2& lateral_n, Cells& cells) {
  CellSums before;
  double along_u = 0.0, along_v = 0.0;
  for (std::size_t i = 0; i < cells.count; ++i) {
    before.add(cells, i, cells.force[i]);
    along_u += cells.plain[i] * cells.x[i] * cells.lever_u[i];
    along_v += cells.plain[i] * cells.y[i] * cells.lever_v[i];
  }
  const double factor = before.normal > 0.0 ? normal_n / before.normal : 0.0;
  const double gain_u = along_u > 0.0 ? (-lateral_n.x() - factor * before.moment_u) / along_u : 0.0;
  const double gain_v = along_v > 0.0 ? (-lateral_n.y() - factor * before.moment_v) / along_v : 0.0;
  bool pulls = false;
  std::array<double, kMaxCells> moved;
  CellSums after;
  for (std::size_t i = 0; i < cells.count; ++i) {
    moved[i] = factor * cells.force[i] + cells.plain[i] * (gain_u * cells.x[i] + gain_v * cells.y[i]);
    pulls = pulls || moved[i] < 0.0;
    after.add(cells, i, moved[i]);
  }
  if (!pulls) {
    std::copy_n(moved.begin(), cells.count, cells.force.begin());
    return after.padSums();
  }
  scaleTo(normal_n, cells.force, cells.count);
  tilt(-lateral_n / normal_n, cells);
  return sumsOf(cells).padSums();
}

/// Where the lump's foot is in the pad's plane.
Vec2 footOf(const Lump& lump, const Vec2& moved_mm, const FingerOutput& felt, const PadPlane& plane) {
  const Vec3 from_tip = lump.foot + moved_mm.x() * lump.across + moved_mm.y() * lump.up - felt.tip;
  return {from_tip.dot(plane.u), from_tip.dot(plane.v)};
}

/// The bumps of all lumps into the cells' forces. `extra_n`: what they add to the normal force together.
void addBumps(const Lumps& lumps, const FingerOutput& felt, const tissue::PressurePattern& pattern,
              const PadPlane& plane, double extra_n, Cells& cells) {
  constexpr double kUnfelt = 1e-5;  // of the force: a bump that nobody would find among the taxels
  const double normal_n = felt.force.dot(felt.normal);
  const LumpPress press{felt.tip, felt.normal, felt.depth_mm, 1.0};
  std::array<double, kMaxLumps> push;
  std::array<Vec2, kMaxLumps> moved;
  double all = 0.0;
  const std::size_t count = std::min(lumps.all.size(), kMaxLumps);
  for (std::size_t i = 0; i < count; ++i) {
    moved[i] = i == felt.lump ? felt.lump_moved_mm : Vec2(Vec2::Zero());
    push[i] = normalPush(lumps.all[i], moved[i], press);
    all += push[i];
  }
  // What relaxation and a hand-over of worlds left of it.
  const double left = all != 0.0 && extra_n / all > 0.0 ? std::min(extra_n / all, 10.0) : 1.0;
  std::array<double, kMaxCells> share;
  std::fill_n(share.begin(), cells.count, 1.0);
  for (std::size_t i = 0; i < count; ++i) {
    if (!(std::abs(push[i]) > kUnfelt * normal_n)) continue;
    const Lump& lump = lumps.all[i];
    Bump bump{.foot = footOf(lump, moved[i], felt, plane), .extra_n = left * push[i]};
    bump.width_mm = tissue::bumpWidth(lump.shape, lump.skin_mm, felt.depth_mm);
    bump.base = tissue::bumpBase(pattern, bump.foot.norm(), bump.width_mm);
    addBump(cells, bump, share);
  }
  for (std::size_t i = 0; i < cells.count; ++i) cells.force[i] = cells.plain[i] * std::max(0.0, share[i]);
}

void writeTaxels(const std::array<double, kMaxCells>& force, const Cells& cells, const PressurePad& pad,
                 const Vec2& shear, std::span<double> kpa, std::span<Vec2> shear_kpa) {
  const double side_mm = pad.size_mm / static_cast<double>(pad.taxels);
  const double kpa_per_n = kKpaMm2PerN / (side_mm * side_mm);
  for (std::size_t i = 0; i < cells.count; ++i) kpa[cells.taxel[i]] += kpa_per_n * force[i];
  if (shear_kpa.empty()) return;
  for (std::size_t i = 0; i < pad.taxels * pad.taxels; ++i) shear_kpa[i] = kpa[i] * shear;
}

}  // namespace

PadPlane padPlane(const Vec3& normal) noexcept {
  constexpr double kAlong = 0.9;  // a normal that points to the head leaves no direction towards it
  const Vec3 head = std::abs(normal.y()) < kAlong ? Vec3::UnitY() : Vec3::UnitZ();
  PadPlane plane;
  plane.v = (head - head.dot(normal) * normal).normalized();
  plane.u = plane.v.cross(normal);
  return plane;
}

PressureGround::PressureGround(std::vector<Place> places) : places_(std::move(places)) {
  if (places_.empty()) throw Error("the pressure under a finger needs the field of at least one stack");
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
  std::fill(kpa.begin(), kpa.end(), 0.0);
  std::fill(shear_kpa.begin(), shear_kpa.end(), Vec2(Vec2::Zero()));
  const double normal_n = felt.force.dot(felt.normal);
  if (felt.touch == Touch::free || !(normal_n > 0.0)) return {};
  const double finger_mm = felt.finger_mm > 0.0 ? felt.finger_mm : tissue::kFingertipMm;
  const PadPlane plane = padPlane(felt.normal);
  const tissue::PressurePattern pattern = ground.at(felt.tissue_mm, felt.depth_mm, finger_mm);
  Cells cells;
  coverCells(pad, pattern, finger_mm, cells);
  const double extra_n = felt.lump_force.dot(felt.normal);
  const bool has_lumps = lumps != nullptr && !felt.lump_force.isZero(0.0) && normal_n > extra_n;
  scaleTo(has_lumps ? normal_n - extra_n : normal_n, cells.plain, cells.count);
  PadSums sums{normal_n, Vec2::Zero()};
  if (has_lumps) {
    addBumps(*lumps, felt, pattern, plane, extra_n, cells);
    sums = keepSums(normal_n, {felt.lump_force.dot(plane.u), felt.lump_force.dot(plane.v)}, cells);
  }
  const Vec3 friction = felt.force - felt.lump_force;
  writeTaxels(has_lumps ? cells.force : cells.plain, cells, pad,
              Vec2(friction.dot(plane.u), friction.dot(plane.v)) / normal_n, kpa, shear_kpa);
  return sums;
}

}  // namespace palpate::contact

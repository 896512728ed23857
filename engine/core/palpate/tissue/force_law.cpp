// The force laws beyond Hooke's. Called by the finger in every tick that touches, through respond().
//
// Based on: Ji, dissertation 2008, 6.2 (2): "a Gaussian curve might be used" for the stiffness from zero to the largest
// displacement. The curve is the dissertation's own half Gaussian (profile.h), lowered to end exactly (E18), and it is
// taken as the tangent stiffness, whose integral is monotone for every positive ratio.
#include "palpate/tissue/force_law.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/base/gaussian.h"
#include "palpate/tissue/profile.h"

namespace palpate::tissue {

namespace {

/// sqrt(kGaussianRate) = 1.4 sqrt(pi): the half Gaussian is exp(-(this q)^2).
const double kGaussianWidth = std::sqrt(kGaussianRate);

/// Integral of profile() from 0 to q.
double profileArea(double q) noexcept {
  const double inside = std::min(q, 1.0);
  const double gaussian_area = elementary::erf(kGaussianWidth * inside) / (2.0 * kGaussianCut);
  return kProfileScale * gaussian_area - kProfileOffset * inside;
}

double stiffened(const ForceLaw& law, double depth) noexcept {
  const double soft_mm = law.stiffening_depth_mm * profileArea(depth / law.stiffening_depth_mm);
  return law.stiffening_ratio * depth + (1.0 - law.stiffening_ratio) * soft_mm;
}

/// The straight piece of a table that holds a depth.
struct Piece {
  double from_mm = 0.0;
  double from_effective_mm = 0.0;
  double slope = 1.0;
};

Piece pieceAt(const ForceTable& table, double depth) noexcept {
  if (table.rows == 0) return {};
  const auto* const begin = table.depth_mm.data();
  const auto above = static_cast<std::uint32_t>(std::upper_bound(begin, begin + table.rows, depth) - begin);
  const std::uint32_t end = std::min(above, table.rows - 1);
  Piece piece;
  if (end > 0) piece = {table.depth_mm[end - 1], table.effective_mm[end - 1]};
  piece.slope = (table.effective_mm[end] - piece.from_effective_mm) / (table.depth_mm[end] - piece.from_mm);
  return piece;
}

double fromTable(const ForceTable& table, double depth) noexcept {
  const Piece piece = pieceAt(table, depth);
  return piece.from_effective_mm + piece.slope * (depth - piece.from_mm);
}

/// The factor that makes the law agree with the map at the reference depth; 1 for a table without force there.
double referenceScale(const ForceLaw& law) noexcept {
  const double reference = law.reference_depth_mm;
  const double effective =
      law.kind == ForceLaw::Kind::table ? fromTable(law.table, reference) : stiffened(law, reference);
  return effective > 0.0 ? reference / effective : 1.0;
}

/// A thickness between two rows.
struct RowPlace {
  std::uint32_t row = 0;
  std::uint32_t next = 0;
  double share = 0.0;
};

RowPlace rowPlace(const LayeredForce& layers, double tissue_mm) noexcept {
  if (layers.rows < 2 || !(tissue_mm > layers.thinnest_mm)) return {};
  const std::uint32_t last = layers.rows - 1;
  const double place = (1.0 / layers.thinnest_mm - 1.0 / tissue_mm) / layers.inverse_step;
  if (!(place < last)) return {last, last, 0.0};
  const auto row = static_cast<std::uint32_t>(place);
  return {row, row + 1, place - row};
}

/// A radius between two of kRadiiMm.
struct FingerPlace {
  std::uint32_t below = LayeredForce::kFingertip;
  std::uint32_t above = LayeredForce::kFingertip;
  double share = 0.0;
};

FingerPlace fingerPlace(const LayeredForce& layers, double finger_mm) noexcept {
  const double radius = finger_mm > 0.0 ? finger_mm : layers.point_mm;
  if (!layers.knows_radius || radius == kFingertipMm) return {};
  constexpr const auto& kRadii = LayeredForce::kRadiiMm;
  constexpr std::uint32_t kLast = LayeredForce::kRadii - 1;
  if (!(radius > kRadii.front())) return {0, 0, 0.0};
  if (radius >= kRadii[kLast]) return {kLast, kLast, 0.0};
  std::uint32_t above = 1;
  while (radius >= kRadii[above]) ++above;
  return {above - 1, above, (radius - kRadii[above - 1]) / (kRadii[above] - kRadii[above - 1])};
}

/// The factor on the secant, straight between depths, from 0 at the surface; and its slope.
struct SecantPlace {
  double factor = 0.0;
  double slope = 0.0;  ///< 1/mm
};

SecantPlace secantOnRow(const std::array<double, LayeredForce::kDepths>& factor, double depth) noexcept {
  constexpr double kStep = LayeredForce::kDepthStepMm;
  constexpr std::uint32_t kLastPiece = LayeredForce::kDepths - 2;
  const double place = depth / kStep;
  const std::uint32_t piece = place < kLastPiece ? static_cast<std::uint32_t>(place) : kLastPiece;
  const double from_mm = kStep * piece;
  const double from = factor[piece];
  const double slope = (factor[piece + 1] - from) / kStep;
  // Beyond the last depth the slope of the force goes on, not that of the secant, which would bend it up for ever.
  constexpr double kLastMm = kStep * (LayeredForce::kDepths - 1);
  if (depth > kLastMm) {
    const double tangent = factor.back() + kLastMm * slope;
    const double effective = factor.back() * kLastMm + tangent * (depth - kLastMm);
    return {effective / depth, (tangent - effective / depth) / depth};
  }
  return {from + slope * (depth - from_mm), slope};
}

SecantPlace between(const SecantPlace& a, const SecantPlace& b, double share) noexcept {
  return {a.factor + share * (b.factor - a.factor), a.slope + share * (b.slope - a.slope)};
}

SecantPlace secantOnRows(const LayeredForce::Rows& factor, const RowPlace& at, double depth) noexcept {
  return between(secantOnRow(factor[at.row], depth), secantOnRow(factor[at.next], depth), at.share);
}

/// Where a place falls in the rows of layered tissue.
struct LayersPlace {
  RowPlace row;
  FingerPlace finger;
};

LayersPlace layersPlace(const LayeredForce& layers, const PressedPlace& place) noexcept {
  return {rowPlace(layers, place.tissue_mm), fingerPlace(layers, place.finger_mm)};
}

SecantPlace secantAt(const LayeredForce& layers, const LayersPlace& at, double depth) noexcept {
  const SecantPlace below = secantOnRows(layers.factor[at.finger.below], at.row, depth);
  if (at.finger.share == 0.0) return below;
  return between(below, secantOnRows(layers.factor[at.finger.above], at.row, depth), at.finger.share);
}

SecantPlace secantOfLayers(const LayeredForce& layers, const PressedPlace& place, double depth) noexcept {
  if (layers.rows == 0) return {1.0, 0.0};
  return secantAt(layers, layersPlace(layers, place), depth);
}

/// dh/dd.
double tangentFactor(const ForceLaw& law, double depth, const PressedPlace& place) noexcept {
  switch (law.kind) {
    case ForceLaw::Kind::linear:
      return 1.0;
    case ForceLaw::Kind::power:
      return law.exponent * elementary::pow(depth / law.reference_depth_mm, law.exponent - 1.0);
    case ForceLaw::Kind::stiffening:
      return referenceScale(law) *
             (law.stiffening_ratio + (1.0 - law.stiffening_ratio) * profile(depth / law.stiffening_depth_mm));
    case ForceLaw::Kind::table:
      return referenceScale(law) * pieceAt(law.table, depth).slope;
    case ForceLaw::Kind::layered: {
      const SecantPlace at = secantOfLayers(law.layers, place, depth);
      return at.factor + depth * at.slope;
    }
  }
  return 1.0;
}

/// A row of secants for one place.
using PlaceRow = std::array<double, LayeredForce::kDepths>;

PlaceRow rowFor(const LayeredForce& layers, const LayersPlace& at) noexcept {
  const auto& thin = layers.factor[at.finger.below][at.row.row];
  const auto& thick = layers.factor[at.finger.below][at.row.next];
  PlaceRow row;
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = thin[i] + at.row.share * (thick[i] - thin[i]);
  if (at.finger.share == 0.0) return row;
  const auto& wide_thin = layers.factor[at.finger.above][at.row.row];
  const auto& wide_thick = layers.factor[at.finger.above][at.row.next];
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double wide = wide_thin[i] + at.row.share * (wide_thick[i] - wide_thin[i]);
    row[i] += at.finger.share * (wide - row[i]);
  }
  return row;
}

/// The integral over a length of what a slope, which goes straight from `from` to `to`, is above the cap.
double areaAbove(double from, double to, double length, double cap) noexcept {
  const double a = std::max(0.0, from - cap);
  const double b = std::max(0.0, to - cap);
  if (a > 0.0 && b > 0.0) return 0.5 * (a + b) * length;
  const double most = std::max(a, b);
  return most > 0.0 ? 0.5 * most * most / std::abs(to - from) * length : 0.0;
}

void requireLaw(bool holds, const char* what) {
  if (!holds) throw Error(std::string("force law: ") + what);
}

bool within(double value, double above, double most) { return value > above && value <= most; }

void checkTable(const ForceTable& table) {
  requireLaw(table.rows >= 1 && table.rows <= ForceTable::kMaxRows, "the table needs 1 to 64 rows");
  double depth = 0.0;
  double effective = 0.0;
  for (std::uint32_t i = 0; i < table.rows; ++i) {
    requireLaw(std::isfinite(table.depth_mm[i]) && table.depth_mm[i] > depth,
               "the table's depths must increase from 0");
    requireLaw(std::isfinite(table.effective_mm[i]) && table.effective_mm[i] >= effective,
               "the table's forces must not decrease");
    depth = table.depth_mm[i];
    effective = table.effective_mm[i];
  }
}

void checkRows(const LayeredForce::Rows& factor, std::uint32_t rows) {
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t i = 1; i < LayeredForce::kDepths; ++i) {
      requireLaw(std::isfinite(factor[row][i]) && factor[row][i] > 0.0, "layered tissue must push back at every depth");
    }
  }
}

void checkLayers(const LayeredForce& layers) {
  requireLaw(layers.rows <= LayeredForce::kRows, "layered tissue has at most 16 rows");
  if (layers.rows == 0) return;
  requireLaw(layers.thinnest_mm > 0.0 && layers.inverse_step >= 0.0 &&
                 1.0 / layers.thinnest_mm > layers.inverse_step * (layers.rows - 1),
             "the thicknesses of layered tissue must increase from above 0");
  requireLaw(std::isfinite(layers.point_mm) && layers.point_mm > 0.0, "the radius of a point must be above 0");
  for (std::uint32_t radius = 0; radius < LayeredForce::kRadii; ++radius) {
    if (layers.knows_radius || radius == LayeredForce::kFingertip) checkRows(layers.factor[radius], layers.rows);
  }
}

}  // namespace

void check(const ForceLaw& law) {
  requireLaw(within(law.reference_depth_mm, 0.0, 1e3), "reference_depth_mm must be above 0 and at most 1000");
  switch (law.kind) {
    case ForceLaw::Kind::linear:
      return;
    case ForceLaw::Kind::layered:
      checkLayers(law.layers);
      return;
    case ForceLaw::Kind::power:
      requireLaw(law.exponent >= 1.0 && law.exponent <= 3.0, "exponent must be 1 to 3");
      return;
    case ForceLaw::Kind::stiffening:
      requireLaw(within(law.stiffening_ratio, 0.0, 100.0), "stiffening_ratio must be above 0 and at most 100");
      requireLaw(within(law.stiffening_depth_mm, 0.0, 1e3), "stiffening_depth_mm must be above 0 and at most 1000");
      return;
    case ForceLaw::Kind::table:
      checkTable(law.table);
  }
}

double detail::secantFactor(const ForceLaw& law, double depth_mm, const PressedPlace& place) noexcept {
  switch (law.kind) {
    case ForceLaw::Kind::linear:
      return 1.0;
    case ForceLaw::Kind::power:
      return elementary::pow(depth_mm / law.reference_depth_mm, law.exponent - 1.0);
    case ForceLaw::Kind::stiffening:
      return referenceScale(law) * stiffened(law, depth_mm) / depth_mm;
    case ForceLaw::Kind::table:
      return referenceScale(law) * fromTable(law.table, depth_mm) / depth_mm;
    case ForceLaw::Kind::layered:
      return secantOfLayers(law.layers, place, depth_mm).factor;
  }
  return 1.0;
}

double detail::tangentialRatio(const ForceLaw& law, double tissue_mm) noexcept {
  if (law.kind != ForceLaw::Kind::layered || law.layers.rows == 0) return 1.0;
  const RowPlace at = rowPlace(law.layers, tissue_mm);
  const double a = law.layers.tangential[at.row];
  return a + at.share * (law.layers.tangential[at.next] - a);
}

double tangentStiffness(const ForceLaw& law, double stiffness_n_per_mm, double depth_mm,
                        const PressedPlace& place) noexcept {
  return stiffness_n_per_mm * tangentFactor(law, std::max(0.0, depth_mm), place);
}

double cappedForce(const LayeredForce& layers, double stiffness_n_per_mm, double depth_mm, const PressedPlace& place,
                   double cap_n_per_mm) noexcept {
  if (!(depth_mm > 0.0) || !(stiffness_n_per_mm > 0.0)) return 0.0;
  const double cap = cap_n_per_mm / stiffness_n_per_mm;
  if (layers.rows == 0) return stiffness_n_per_mm * std::min(1.0, cap) * depth_mm;
  constexpr double kStep = LayeredForce::kDepthStepMm;
  constexpr std::size_t kPieces = LayeredForce::kDepths - 1;
  constexpr double kLastMm = kStep * kPieces;
  const LayersPlace at = layersPlace(layers, place);
  const PlaceRow row = rowFor(layers, at);
  const double pressed = std::min(std::ceil(depth_mm / kStep), static_cast<double>(kPieces));
  const auto pieces = static_cast<std::uint32_t>(pressed);
  double taken = 0.0;
  for (std::uint32_t i = 0; i < pieces; ++i) {
    const double from_mm = kStep * i;
    // The secant is straight within a piece, so the slope of the force is, too.
    const double rise = (row[i + 1] - row[i]) / kStep;
    const double from = row[i] + rise * from_mm;
    const double to = from + 2.0 * rise * std::min(kStep, depth_mm - from_mm);
    if (from > cap || to > cap) taken += areaAbove(from, to, std::min(kStep, depth_mm - from_mm), cap);
  }
  if (depth_mm > kLastMm) {
    const double last = row[kPieces] + kLastMm * (row[kPieces] - row[kPieces - 1]) / kStep;
    taken += (depth_mm - kLastMm) * std::max(0.0, last - cap);
  }
  return stiffness_n_per_mm * (secantAt(layers, at, depth_mm).factor * depth_mm - taken);
}

double steepestFactor(const ForceLaw& law, double depth_mm, double finger_mm) noexcept {
  double steepest = 0.0;
  const auto look = [&](double depth, double tissue_mm) {
    steepest = std::max(steepest, tangentFactor(law, depth, {tissue_mm, finger_mm}));
  };
  look(0.0, 0.0);
  look(depth_mm, 0.0);
  if (law.kind == ForceLaw::Kind::table) {
    for (std::uint32_t i = 0; i < law.table.rows && law.table.depth_mm[i] < depth_mm; ++i) {
      look(law.table.depth_mm[i], 0.0);
    }
  }
  if (law.kind == ForceLaw::Kind::layered) {
    // Within a piece the force is a parabola: its slope is greatest at an end, which is looked at from within.
    constexpr double kWithin = 1.0 - 1e-9;
    for (std::uint32_t row = 0; row < law.layers.rows; ++row) {
      const double thickness = law.layers.thicknessOf(row);
      look(depth_mm, thickness);
      for (std::uint32_t i = 1; i < LayeredForce::kDepths; ++i) {
        const double end = kWithin * LayeredForce::kDepthStepMm * i;
        if (end < depth_mm) look(end, thickness);
      }
    }
  }
  return steepest;
}

/// Doubled until it is deep enough, then halved 60 times: some 5 us. Laws do not decrease, and nothing else is asked of
/// them.
double depthOf(const ForceLaw& law, double effective_mm, const PressedPlace& place) noexcept {
  if (!(effective_mm > 0.0)) return 0.0;
  if (law.kind == ForceLaw::Kind::linear) return effective_mm;
  constexpr double kDeepestMm = 1000.0;
  const auto reaches = [&](double depth_mm) { return normalForce(law, 1.0, depth_mm, place) >= effective_mm; };
  double deep = effective_mm;
  while (deep < kDeepestMm && !reaches(deep)) deep *= 2.0;
  if (deep >= kDeepestMm) return kDeepestMm;
  double shallow = 0.0;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (shallow + deep);
    (reaches(middle) ? deep : shallow) = middle;
  }
  return deep;
}

}  // namespace palpate::tissue

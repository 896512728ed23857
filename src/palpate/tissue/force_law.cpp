// The force laws beyond Hooke's. Called by the finger in every tick that touches, through respond().
//
// Based on: Ji, dissertation 2008, 6.2 (2): "a Gaussian curve might be used" for the stiffness from zero to the largest
// displacement. The curve is the dissertation's own half Gaussian (profile.h), lowered to end exactly (E18), and it is
// taken as the tangent stiffness, whose integral is monotone for every positive ratio.
#include "palpate/tissue/force_law.h"

#include <algorithm>
#include <cmath>
#include <string>

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
  const double gaussian_area = std::erf(kGaussianWidth * inside) / (2.0 * kGaussianCut);
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

/// dh/dd.
double tangentFactor(const ForceLaw& law, double depth) noexcept {
  switch (law.kind) {
    case ForceLaw::Kind::linear:
      return 1.0;
    case ForceLaw::Kind::power:
      return law.exponent * std::pow(depth / law.reference_depth_mm, law.exponent - 1.0);
    case ForceLaw::Kind::stiffening:
      return law.stiffening_ratio + (1.0 - law.stiffening_ratio) * profile(depth / law.stiffening_depth_mm);
    case ForceLaw::Kind::table:
      return pieceAt(law.table, depth).slope;
  }
  return 1.0;
}

void requireLaw(bool holds, const char* what) {
  if (!holds) throw Error(std::string("force law: ") + what);
}

bool within(double value, double above, double most) { return value > above && value <= most; }

void checkTable(const ForceTable& table) {
  requireLaw(table.rows >= 1 && table.rows <= ForceTable::kMostRows, "the table needs 1 to 64 rows");
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

}  // namespace

void check(const ForceLaw& law) {
  switch (law.kind) {
    case ForceLaw::Kind::linear:
      return;
    case ForceLaw::Kind::power:
      requireLaw(law.exponent >= 1.0 && law.exponent <= 3.0, "exponent must be 1 to 3");
      requireLaw(within(law.reference_depth_mm, 0.0, 1e3), "reference_depth_mm must be above 0 and at most 1000");
      return;
    case ForceLaw::Kind::stiffening:
      requireLaw(within(law.stiffening_ratio, 0.0, 100.0), "stiffening_ratio must be above 0 and at most 100");
      requireLaw(within(law.stiffening_depth_mm, 0.0, 1e3), "stiffening_depth_mm must be above 0 and at most 1000");
      return;
    case ForceLaw::Kind::table:
      checkTable(law.table);
  }
}

double detail::secantFactor(const ForceLaw& law, double depth_mm) noexcept {
  switch (law.kind) {
    case ForceLaw::Kind::linear:
      return 1.0;
    case ForceLaw::Kind::power:
      return std::pow(depth_mm / law.reference_depth_mm, law.exponent - 1.0);
    case ForceLaw::Kind::stiffening:
      return stiffened(law, depth_mm) / depth_mm;
    case ForceLaw::Kind::table:
      return fromTable(law.table, depth_mm) / depth_mm;
  }
  return 1.0;
}

double tangentStiffness(const ForceLaw& law, double stiffness_n_per_mm, double depth_mm) noexcept {
  return stiffness_n_per_mm * tangentFactor(law, std::max(0.0, depth_mm));
}

double steepestFactor(const ForceLaw& law, double depth_mm) noexcept {
  double steepest = std::max(tangentFactor(law, 0.0), tangentFactor(law, depth_mm));
  if (law.kind != ForceLaw::Kind::table) return steepest;  // their slopes rise or fall throughout
  for (std::uint32_t i = 0; i < law.table.rows && law.table.depth_mm[i] < depth_mm; ++i) {
    steepest = std::max(steepest, tangentFactor(law, law.table.depth_mm[i]));
  }
  return steepest;
}

}  // namespace palpate::tissue

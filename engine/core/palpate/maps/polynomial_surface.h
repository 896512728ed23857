// A polynomial in x and y that comes nearest to scattered values: the trend of a field, without the single peaks.
//
// Serves the stiffness map next to GRI (measured_stiffness.h). Least squares by a column-pivoted QR of products of
// Legendre polynomials in centred, scaled coordinates: the plain powers of millimetres would lose all digits at
// degree 5. Based on: Golub, Van Loan, "Matrix computations", 2013, section 5.4 (QR with column pivoting).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/maps/plane_scaling.h"

namespace palpate::maps {

/// Beyond it a polynomial swings more between places than measurements can show.
inline constexpr std::size_t kMaxPolynomialDegree = 8;

/// Number of terms x^i y^j with i + j <= degree, hence of the places a fit needs: 3 for 1, 6 for 2, 10 for 3.
constexpr std::size_t polynomialTerms(std::size_t degree) { return (degree + 1) * (degree + 2) / 2; }

class PolynomialSurface {
 public:
  /// One value per place; coincident places each count. Throws Error for a degree above 8, fewer places than terms,
  /// places that leave a term undetermined (on one line, on a grid too coarse, ...), numbers that are not finite, lists
  /// of different lengths. O(n terms^2).
  PolynomialSurface(std::span<const Vec2> places_mm, std::span<const double> values, std::size_t degree);

  /// O(terms), no allocation.
  double at(const Vec2& place_mm) const noexcept;

 private:
  PlaneScaling scaling_;
  std::size_t degree_;
  std::vector<double> coefficients_;  // for L_i(x) L_j(y), by rising i + j
};

}  // namespace palpate::maps

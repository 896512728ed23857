// A row of products of Legendre polynomials a place, solved by least squares; refuses terms that the places leave free.
//
// Based on: Golub, Van Loan, "Matrix computations" (2013), section 5.4.
#include "palpate/maps/polynomial_surface.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <array>
#include <cmath>

#include "palpate/base/error.h"

namespace palpate::maps {

namespace {

/// Smallest pivot, relative to the largest, of a term that the places determine.
constexpr double kDetermined = 1e-9;

using Powers = std::array<double, kMaxPolynomialDegree + 1>;

/// Legendre polynomials 0 to `degree` at t.
Powers legendre(double t, std::size_t degree) {
  Powers p{1.0, t};
  for (std::size_t k = 1; k < degree; ++k) {
    const auto n = static_cast<double>(k);
    p[k + 1] = ((2.0 * n + 1.0) * t * p[k] - n * p[k - 1]) / (n + 1.0);
  }
  return p;
}

/// Calls visit(term, value) for every L_i(x) L_j(y) with i + j <= degree.
template <class Visit>
void forEachTerm(const Vec2& place, std::size_t degree, const Visit& visit) {
  const Powers x = legendre(place.x(), degree);
  const Powers y = legendre(place.y(), degree);
  std::size_t term = 0;
  for (std::size_t total = 0; total <= degree; ++total) {
    for (std::size_t j = 0; j <= total; ++j) visit(term++, x[total - j] * y[j]);
  }
}

void requireEnough(std::span<const Vec2> places, std::span<const double> values, std::size_t degree) {
  if (places.size() != values.size()) throw Error("polynomial: expected one value per point");
  if (degree > kMaxPolynomialDegree) {
    throw Error(fmt::format("polynomial: degree {} is too high; expected at most {}", degree, kMaxPolynomialDegree));
  }
  if (places.size() < polynomialTerms(degree)) {
    throw Error(fmt::format("polynomial of degree {}: requires {} key points, got {}", degree, polynomialTerms(degree),
                            places.size()));
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].allFinite() || !std::isfinite(values[i]))
      throw Error("polynomial: points and values must be finite");
  }
}

}  // namespace

PolynomialSurface::PolynomialSurface(std::span<const Vec2> places_mm, std::span<const double> values,
                                     std::size_t degree)
    : scaling_(scalingOf(places_mm)), degree_(degree) {
  requireEnough(places_mm, values, degree);
  const std::size_t terms = polynomialTerms(degree);
  Eigen::MatrixXd rows(places_mm.size(), terms);
  for (std::size_t i = 0; i < places_mm.size(); ++i) {
    forEachTerm(scaling_.scaled(places_mm[i]), degree, [&](std::size_t term, double value) { rows(i, term) = value; });
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows);
  qr.setThreshold(kDetermined);
  if (qr.rank() < static_cast<Eigen::Index>(terms)) {
    throw Error(fmt::format(
        "polynomial of degree {}: the key points determine only {} of its {} terms; lower the degree or add points",
        degree, qr.rank(), terms));
  }
  const Eigen::VectorXd fit = qr.solve(Eigen::Map<const Eigen::VectorXd>(values.data(), values.size()));
  coefficients_.assign(fit.begin(), fit.end());
}

double PolynomialSurface::at(const Vec2& place_mm) const noexcept {
  double sum = 0.0;
  forEachTerm(scaling_.scaled(place_mm), degree_,
              [&](std::size_t term, double value) { sum += coefficients_[term] * value; });
  return sum;
}

}  // namespace palpate::maps

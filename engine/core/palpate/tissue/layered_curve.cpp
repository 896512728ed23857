// Least squares for the coefficients of a curve; load time.
#include "palpate/tissue/layered_curve.h"

#include <Eigen/Core>
#include <cmath>

#include "palpate/base/dense_solve.h"
#include "palpate/base/error.h"

namespace palpate::tissue {

namespace {

using Row = Eigen::Matrix<double, 1, kCurveTerms>;

/// x^2 y^k for every k.
Row basisAt(double bend, double q) {
  Row row;
  for (int k = 0; k < kCurveTerms; ++k) {
    LayeredCurve one;
    one.terms[static_cast<std::size_t>(k)] = 1.0;
    row[k] = curveAt(one, bend, q * q).value;
  }
  return row;
}

Eigen::Index countWithin(std::span<const CurveSample> samples) {
  Eigen::Index rows = 0;
  for (const CurveSample& sample : samples) rows += sample.q < 1.0 ? 1 : 0;
  if (rows < kCurveTerms) throw Error("layered curve: fewer samples inside the rim than terms; add samples");
  return rows;
}

LayeredCurve toCurve(const Eigen::VectorXd& terms) {
  LayeredCurve curve;
  for (std::size_t k = 0; k < curve.terms.size(); ++k) curve.terms[k] = terms[static_cast<Eigen::Index>(k)];
  return curve;
}

}  // namespace

/// In the middle every term is 1, so that the first is 1 less the others.
LayeredCurve fittedShare(std::span<const CurveSample> samples, double bend) {
  const Eigen::Index rows = countWithin(samples);
  Eigen::MatrixXd left(rows, kCurveTerms - 1);
  Eigen::VectorXd right(rows);
  Eigen::Index row = 0;
  for (const CurveSample& sample : samples) {
    if (!(sample.q < 1.0)) continue;
    const Row basis = basisAt(bend, sample.q);
    left.row(row) = sample.weight * (basis.tail<kCurveTerms - 1>().array() - basis[0]).matrix();
    right[row++] = sample.weight * (sample.value - basis[0]);
  }
  const Eigen::VectorXd others = leastSquares(std::move(left), right);
  Eigen::VectorXd terms(kCurveTerms);
  terms << 1.0 - others.sum(), others;
  return toCurve(terms);
}

LayeredCurve fittedOutward(std::span<const CurveSample> samples, double bend) {
  const Eigen::Index rows = countWithin(samples);
  Eigen::MatrixXd left(rows, kCurveTerms);
  Eigen::VectorXd right(rows);
  Eigen::Index row = 0;
  for (const CurveSample& sample : samples) {
    if (!(sample.q < 1.0)) continue;
    left.row(row) = sample.weight * sample.q * basisAt(bend, sample.q);
    right[row++] = sample.weight * sample.value;
  }
  return toCurve(leastSquares(std::move(left), right));
}

}  // namespace palpate::tissue

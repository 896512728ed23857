// Least squares with a handful of numbers, each within bounds: the common part of the fits of measured curves.
//
// Levenberg-Marquardt with differences for derivatives; a number that a step would carry over its bound stays there.
// Based on: Marquardt, "An algorithm for least-squares estimation of nonlinear parameters", 1963.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string_view>
#include <vector>

namespace palpate::tissue {

struct Bounds {
  double low = 0.0;
  double high = 1.0;
};

struct BoundedFit {
  Eigen::VectorXd numbers;
  double squares = 0.0;      ///< sum of the squared residuals
  Eigen::MatrixXd jacobian;  ///< derivatives of the residuals by the numbers, there
  std::vector<bool> at_bound;
};

using Residuals = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// The best of the descents from these starts; bounds as many as each start has numbers (none: the residuals as they
/// are). Residuals must be finite within the bounds. Deterministic.
BoundedFit fitWithin(const Residuals& residuals, const std::vector<Eigen::VectorXd>& starts,
                     const std::vector<Bounds>& bounds);

/// Standard errors of the numbers; 0 for those at a bound. NaN unless there are more residuals than numbers, or where
/// these cannot be distinguished.
Eigen::VectorXd standardErrors(const BoundedFit& fit);

// A number that a fit found, and how sure it is.

struct FittedNumber {
  std::string_view name;
  double value = 0.0;
  double standard_error = 0.0;  ///< NaN: too few rows; 0: at the end of its range, or not requested
  bool at_end = false;          ///< at the end of its range: the rows' optimum may lie beyond
};

}  // namespace palpate::tissue

#include "palpate/tissue/fitting/bounded_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/base/dense_solve.h"

namespace palpate::tissue {

namespace {

constexpr int kMaxSteps = 200;
/// Shares of the width of the bounds: for differences, and for a step too small to count.
constexpr double kDifference = 1e-6;
constexpr double kNoStep = 1e-11;

class Descent {
 public:
  Descent(const Residuals& residuals, const std::vector<Bounds>& bounds) : residuals_(residuals), bounds_(bounds) {}

  BoundedFit from(const Eigen::VectorXd& start) const {
    BoundedFit fit;
    fit.numbers = clamped(start);
    Eigen::VectorXd rest = residuals_(fit.numbers);
    fit.squares = rest.squaredNorm();
    fit.jacobian = jacobianAt(fit.numbers);
    if (start.size() == 0) return fit;
    double damping = 1e-3;
    for (int i = 0; i < kMaxSteps && damping < 1e12; ++i) {
      fit.jacobian = jacobianAt(fit.numbers);
      fit.at_bound = activeBounds(fit.numbers, fit.jacobian.transpose() * rest);
      const Eigen::VectorXd next = clamped(fit.numbers + dampedStep(fit, rest, damping));
      if (isNoStep(next - fit.numbers)) break;
      const Eigen::VectorXd next_rest = residuals_(next);
      if (!(next_rest.squaredNorm() < fit.squares)) {
        damping *= 5.0;
        continue;
      }
      fit.numbers = next;
      rest = next_rest;
      fit.squares = rest.squaredNorm();
      damping = std::max(1e-12, 0.2 * damping);
    }
    fit.jacobian = jacobianAt(fit.numbers);
    fit.at_bound = activeBounds(fit.numbers, fit.jacobian.transpose() * rest);
    return fit;
  }

 private:
  double width(Eigen::Index i) const { return boundsAt(i).high - boundsAt(i).low; }
  const Bounds& boundsAt(Eigen::Index i) const { return bounds_[static_cast<std::size_t>(i)]; }

  Eigen::VectorXd clamped(Eigen::VectorXd numbers) const {
    for (Eigen::Index i = 0; i < numbers.size(); ++i) {
      numbers[i] = std::clamp(numbers[i], boundsAt(i).low, boundsAt(i).high);
    }
    return numbers;
  }

  /// Central; towards the inside at a bound.
  Eigen::MatrixXd jacobianAt(const Eigen::VectorXd& numbers) const {
    Eigen::MatrixXd jacobian(residuals_(numbers).size(), numbers.size());
    for (Eigen::Index i = 0; i < numbers.size(); ++i) {
      const double step = kDifference * width(i);
      Eigen::VectorXd below = numbers;
      Eigen::VectorXd above = numbers;
      below[i] = std::max(boundsAt(i).low, numbers[i] - step);
      above[i] = std::min(boundsAt(i).high, numbers[i] + step);
      jacobian.col(i) = (residuals_(above) - residuals_(below)) / (above[i] - below[i]);
    }
    return jacobian;
  }

  /// At a bound, and downhill leads out.
  std::vector<bool> activeBounds(const Eigen::VectorXd& numbers, const Eigen::VectorXd& gradient) const {
    std::vector<bool> held;
    for (Eigen::Index i = 0; i < numbers.size(); ++i) {
      const bool low = numbers[i] <= boundsAt(i).low && gradient[i] >= 0.0;
      const bool high = numbers[i] >= boundsAt(i).high && gradient[i] <= 0.0;
      held.push_back(low || high);
    }
    return held;
  }

  static Eigen::VectorXd dampedStep(const BoundedFit& fit, const Eigen::VectorXd& rest, double damping) {
    Eigen::MatrixXd jacobian = fit.jacobian;
    for (std::size_t i = 0; i < fit.at_bound.size(); ++i) {
      if (fit.at_bound[i]) jacobian.col(static_cast<Eigen::Index>(i)).setZero();
    }
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    const double least = 1e-12 * std::max(normal.trace(), std::numeric_limits<double>::min());
    normal.diagonal() += damping * normal.diagonal() + Eigen::VectorXd::Constant(normal.rows(), least);
    return solved(std::move(normal), -jacobian.transpose() * rest);
  }

  bool isNoStep(const Eigen::VectorXd& step) const {
    for (Eigen::Index i = 0; i < step.size(); ++i) {
      if (std::abs(step[i]) > kNoStep * width(i)) return false;
    }
    return true;
  }

  const Residuals& residuals_;
  const std::vector<Bounds>& bounds_;
};

}  // namespace

BoundedFit fitWithin(const Residuals& residuals, const std::vector<Eigen::VectorXd>& starts,
                     const std::vector<Bounds>& bounds) {
  const Descent descent(residuals, bounds);
  BoundedFit best = descent.from(starts.front());
  for (std::size_t i = 1; i < starts.size(); ++i) {
    BoundedFit other = descent.from(starts[i]);
    if (other.squares < best.squares) best = std::move(other);
  }
  return best;
}

Eigen::VectorXd standardErrors(const BoundedFit& fit) {
  std::vector<Eigen::Index> open;
  for (std::size_t i = 0; i < fit.at_bound.size(); ++i) {
    if (!fit.at_bound[i]) open.push_back(static_cast<Eigen::Index>(i));
  }
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(fit.numbers.size());
  const auto count = static_cast<Eigen::Index>(open.size());
  if (count == 0) return errors;
  const Eigen::MatrixXd jacobian = fit.jacobian(Eigen::all, open);
  const Eigen::Index left = jacobian.rows() - count;
  const Eigen::FullPivLU<Eigen::MatrixXd> normal(jacobian.transpose() * jacobian);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const bool known = left > 0 && normal.isInvertible();
  const Eigen::VectorXd variances =
      known ? Eigen::VectorXd(normal.inverse().diagonal() * (fit.squares / static_cast<double>(left)))
            : Eigen::VectorXd::Constant(count, nan);
  for (Eigen::Index i = 0; i < count; ++i) errors[open[static_cast<std::size_t>(i)]] = std::sqrt(variances[i]);
  return errors;
}

}  // namespace palpate::tissue

// Based on: Bookstein, "Principal warps: thin-plate splines and the decomposition of deformations", 1989; Wahba,
// "Spline models for observational data", 1990 (the smoothing).
#include "palpate/measure/thin_plate.h"

#include <Eigen/LU>
#include <cmath>

#include "palpate/base/error.h"

namespace palpate::measure {

namespace {

double plate(double r2) { return r2 > 0.0 ? 0.5 * r2 * std::log(r2) : 0.0; }

}  // namespace

ThinPlate::ThinPlate(std::span<const Vec2> knots, std::span<const Vec2> values, double unit, double smoothing)
    : unit_(unit) {
  const auto count = static_cast<Eigen::Index>(knots.size());
  for (const Vec2& knot : knots) centre_ += knot / static_cast<double>(count);
  knots_.resize(2, count);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count + 3, count + 3);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count + 3, 2);
  for (Eigen::Index i = 0; i < count; ++i) {
    knots_.col(i) = (knots[static_cast<std::size_t>(i)] - centre_) / unit_;
    right.row(i) = values[static_cast<std::size_t>(i)].transpose();
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < i; ++j)
      system(i, j) = system(j, i) = plate((knots_.col(i) - knots_.col(j)).squaredNorm());
    system(i, i) = smoothing;
    system(i, count) = system(count, i) = 1.0;
    system.row(i).tail<2>() = knots_.col(i).transpose();
    system.col(i).tail<2>() = knots_.col(i);
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> solver(system);
  weights_ = solver.solve(right);
  if (!weights_.allFinite() || !(solver.rcond() > 1e-14))
    throw Error("the dots are all in one line; they must cover an area");
}

Vec2 ThinPlate::at(const Vec2& place) const {
  const Vec2 x = (place - centre_) / unit_;
  const Eigen::Index count = knots_.cols();
  Vec2 value = weights_.row(count).transpose() + weights_.bottomRows<2>().transpose() * x;
  for (Eigen::Index i = 0; i < count; ++i)
    value += weights_.row(i).transpose() * plate((x - knots_.col(i)).squaredNorm());
  return value;
}

Mat2 ThinPlate::slopeAt(const Vec2& place) const {
  const Vec2 x = (place - centre_) / unit_;
  Mat2 slope = weights_.bottomRows<2>().transpose();
  for (Eigen::Index i = 0; i < knots_.cols(); ++i) {
    const Vec2 offset = x - knots_.col(i);
    const double r2 = offset.squaredNorm();
    if (r2 > 0.0) slope += weights_.row(i).transpose() * ((std::log(r2) + 1.0) * offset).transpose();
  }
  return slope / unit_;
}

}  // namespace palpate::measure

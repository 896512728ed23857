// The second derivatives at the points solve one linear system; between them the cubic follows in closed form. Places
// evenly spaced by arc length are read off a fine polygon.
//
// Based on: de Boor, "A Practical Guide to Splines" (1978), cubic interpolation, natural and periodic.
#include "palpate/body/cubic_spline.h"

#include <algorithm>

#include "palpate/base/dense_solve.h"

namespace palpate::body {
namespace {

constexpr std::size_t kStepsPerSpan = 64;  // for the polygon that measures arc length: relative error below 1e-4

}  // namespace

CubicSpline::CubicSpline(std::span<const Vec3> points, Ends ends) : ends_(ends), points_(points.begin(), points.end()) {
  if (ends == Ends::closed) points_.push_back(points_.front());
  knots_.assign(1, 0.0);
  for (std::size_t i = 1; i < points_.size(); ++i)
    knots_.push_back(knots_.back() + (points_[i] - points_[i - 1]).norm());

  const auto n = static_cast<Eigen::Index>(points_.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, 3);
  const auto width = [&](Eigen::Index i) { return knots_[i + 1] - knots_[i]; };
  const auto slope = [&](Eigen::Index i) { return Vec3((points_[i + 1] - points_[i]) / width(i)); };
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    matrix.row(i).segment(i - 1, 3) << width(i - 1), 2.0 * (width(i - 1) + width(i)), width(i);
    right.row(i) = 6.0 * (slope(i) - slope(i - 1));
  }
  if (ends == Ends::closed) {
    matrix.row(0).setZero();
    matrix(0, 0) = 2.0 * (width(n - 2) + width(0));
    matrix(0, 1) += width(0);
    matrix(0, n - 2) += width(n - 2);
    right.row(0) = 6.0 * (slope(0) - slope(n - 2));
    matrix(n - 1, 0) = -1.0;  // the last second derivative equals the first
  }
  const Eigen::MatrixXd solution = solved(std::move(matrix), std::move(right));
  for (Eigen::Index i = 0; i < n; ++i) second_.emplace_back(solution.row(i));
}

Vec3 CubicSpline::at(double s) const {
  const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, s);
  const auto i = static_cast<std::size_t>(above - knots_.begin()) - 1;
  const double h = knots_[i + 1] - knots_[i];
  const double b = (s - knots_[i]) / h;
  const double a = 1.0 - b;
  return a * points_[i] + b * points_[i + 1] +
         h * h / 6.0 * ((a * a * a - a) * second_[i] + (b * b * b - b) * second_[i + 1]);
}

std::vector<Vec3> CubicSpline::evenly(std::size_t count) const {
  const std::size_t steps = kStepsPerSpan * (points_.size() - 1);
  std::vector<double> arc{0.0};
  Vec3 before = at(0.0);
  for (std::size_t i = 1; i <= steps; ++i) {
    const Vec3 here = at(length() * static_cast<double>(i) / static_cast<double>(steps));
    arc.push_back(arc.back() + (here - before).norm());
    before = here;
  }
  std::vector<Vec3> points;
  const double parts = static_cast<double>(ends_ == Ends::closed ? count : count - 1);
  for (std::size_t i = 0, step = 1; i < count; ++i) {
    const double wanted = arc.back() * static_cast<double>(i) / parts;
    while (step < steps && arc[step] < wanted) ++step;
    const double within = (wanted - arc[step - 1]) / (arc[step] - arc[step - 1]);
    points.push_back(at(length() * (static_cast<double>(step - 1) + within) / static_cast<double>(steps)));
  }
  return points;
}

}  // namespace palpate::body

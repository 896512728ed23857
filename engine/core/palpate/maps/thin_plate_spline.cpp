// One dense linear system for the weights and the affine part, at most kMaxThinPlatePlaces places, doubles merged
// first.
//
// Based on: Duchon (1977), Bookstein (1989), see thin_plate_spline.h.
#include "palpate/maps/thin_plate_spline.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>

#include "palpate/base/dense_solve.h"
#include "palpate/base/elementary.h"
#include "palpate/base/error.h"

namespace palpate::maps {

namespace {

/// Places nearer than a micrometre are one: measurements are coarser, and the system would be singular.
constexpr double kCoincidentMm = 1e-3;
/// Thinnest spread of places relative to their widest that still counts as a plane and not as a line.
constexpr double kFlat = 1e-9;

/// Places without doubles, each with the mean of its values.
struct Samples {
  std::vector<Vec2> places;
  std::vector<double> values;
};

Samples withoutCoincidence(std::span<const Vec2> places, std::span<const double> values) {
  Samples samples;
  std::vector<double> counts;
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::size_t s = 0;
    while (s < samples.places.size() && !((samples.places[s] - places[i]).norm() <= kCoincidentMm)) ++s;
    if (s == samples.places.size()) {
      samples.places.push_back(places[i]);
      samples.values.push_back(0.0);
      counts.push_back(0.0);
    }
    samples.values[s] += values[i];
    counts[s] += 1.0;
  }
  for (std::size_t s = 0; s < counts.size(); ++s) samples.values[s] /= counts[s];
  return samples;
}

void requireNumbers(std::span<const Vec2> places, std::span<const double> values) {
  if (places.size() != values.size()) throw Error("thin-plate spline: expected one value per point");
  if (places.size() > kMaxThinPlatePlaces) {
    throw Error(
        fmt::format("thin-plate spline: {} key points; expected at most {}", places.size(), kMaxThinPlatePlaces));
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].allFinite() || !std::isfinite(values[i]))
      throw Error("thin-plate spline: points and values must be finite");
  }
}

/// Rows (1, x, y).
Eigen::MatrixXd affineRows(const std::vector<Vec2>& places) {
  Eigen::MatrixXd rows(places.size(), 3);
  for (std::size_t i = 0; i < places.size(); ++i) rows.row(i) << 1.0, places[i].x(), places[i].y();
  return rows;
}

void requirePlane(const Eigen::MatrixXd& affine_rows) {
  if (affine_rows.rows() >= 3) {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(affine_rows);
    qr.setThreshold(kFlat);
    if (qr.rank() == 3) return;
  }
  throw Error("thin-plate spline: requires three key points that are not on one line");
}

/// r^2 ln r of a squared distance.
double bending(double squared) { return squared > 0.0 ? 0.5 * squared * elementary::log(squared) : 0.0; }

}  // namespace

ThinPlateSpline::ThinPlateSpline(std::span<const Vec2> places_mm, std::span<const double> values)
    : scaling_(scalingOf(places_mm)) {
  requireNumbers(places_mm, values);
  Samples samples = withoutCoincidence(places_mm, values);
  places_ = std::move(samples.places);
  for (Vec2& place : places_) place = scaling_.scaled(place);
  const auto n = static_cast<Eigen::Index>(places_.size());
  const Eigen::MatrixXd affine_rows = affineRows(places_);
  requirePlane(affine_rows);

  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 3, n + 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      system(i, j) = system(j, i) = bending((places_[i] - places_[j]).squaredNorm());
    }
  }
  system.topRightCorner(n, 3) = affine_rows;
  system.bottomLeftCorner(3, n) = affine_rows.transpose();
  Eigen::VectorXd wanted = Eigen::VectorXd::Zero(n + 3);
  for (Eigen::Index i = 0; i < n; ++i) wanted[i] = samples.values[i];
  const Eigen::VectorXd solution = solved(std::move(system), wanted);
  weights_.assign(solution.begin(), solution.begin() + n);
  affine_ = solution.tail<3>();
}

double ThinPlateSpline::at(const Vec2& place_mm) const noexcept {
  const Vec2 p = scaling_.scaled(place_mm);
  double value = affine_[0] + affine_[1] * p.x() + affine_[2] * p.y();
  for (std::size_t i = 0; i < places_.size(); ++i) value += weights_[i] * bending((p - places_[i]).squaredNorm());
  return value;
}

}  // namespace palpate::maps

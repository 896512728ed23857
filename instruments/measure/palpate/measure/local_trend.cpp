#include "palpate/measure/local_trend.h"

#include <Eigen/QR>

namespace palpate::measure {

namespace {

constexpr Eigen::Index kFlat = 3;
constexpr Eigen::Index kBent = 6;
constexpr Eigen::Index kMaxNeighbours = 48;

using Terms = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxNeighbours, kBent>;
using Values = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::ColMajor, kMaxNeighbours, 2>;

std::optional<Trend> solved(const std::vector<Neighbour>& neighbours, Eigen::Index terms) {
  const auto count = std::min(static_cast<Eigen::Index>(neighbours.size()), kMaxNeighbours);
  if (count < terms) return {};
  Terms matrix(count, terms);
  Values values(count, 2);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Neighbour& n = neighbours[static_cast<std::size_t>(i)];
    const double x = n.offset.x();
    const double y = n.offset.y();
    matrix(i, 0) = 1.0;
    matrix(i, 1) = x;
    matrix(i, 2) = y;
    if (terms == kBent) {
      matrix(i, 3) = x * x;
      matrix(i, 4) = x * y;
      matrix(i, 5) = y * y;
    }
    values.row(i) = n.value.transpose();
  }
  const Eigen::ColPivHouseholderQR<Terms> qr(matrix);
  if (qr.rank() < terms) return {};
  const Eigen::Matrix<double, Eigen::Dynamic, 2> found = qr.solve(values);
  Trend trend;
  trend.value = found.row(0).transpose();
  trend.slope.col(0) = found.row(1).transpose();
  trend.slope.col(1) = found.row(2).transpose();
  return trend;
}

}  // namespace

std::optional<Trend> fitTrend(const std::vector<Neighbour>& neighbours, std::size_t bent_from) {
  if (neighbours.size() >= bent_from) {
    if (const auto bent = solved(neighbours, kBent)) return bent;
  }
  return solved(neighbours, kFlat);
}

}  // namespace palpate::measure

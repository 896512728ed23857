// A kernel average for the many, Gaussian radial functions through the few.
#include "palpate/body/fitting/residual_warp.h"

#include "palpate/base/dense_solve.h"
#include "palpate/base/elementary.h"

namespace palpate::body {

namespace {

constexpr double kSkinReachMm = 40;    // anything narrower is relief, which bones do not follow
constexpr double kSkinNothing = 0.3;   // weight of "no move": far from all samples nothing moves
constexpr double kExactReachMm = 110;  // about four vertebrae
constexpr double kExactSoftness = 1e-4;

double bell(const Vec3& offset, double reach_mm) {
  return elementary::exp(-offset.squaredNorm() / (2 * reach_mm * reach_mm));
}

}  // namespace

ResidualWarp::ResidualWarp(std::vector<Move> skin, std::vector<Move> exact)
    : skin_(std::move(skin)), exact_(std::move(exact)) {
  const auto count = static_cast<Eigen::Index>(exact_.size());
  if (count == 0) return;
  Eigen::MatrixXd kernels(count, count);
  Eigen::MatrixXd left(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Move& move = exact_[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < count; ++k) {
      kernels(i, k) = bell(move.place - exact_[static_cast<std::size_t>(k)].place, kExactReachMm);
    }
    kernels(i, i) += kExactSoftness;
    left.row(i) = (move.by - bySkin(move.place)).transpose();
  }
  const Eigen::MatrixXd weights = solved(std::move(kernels), std::move(left));
  for (Eigen::Index i = 0; i < count; ++i) weights_.emplace_back(weights.row(i).transpose());
}

Vec3 ResidualWarp::bySkin(const Vec3& point) const {
  Vec3 sum = Vec3::Zero();
  double weight = kSkinNothing;
  for (const Move& move : skin_) {
    const double near = bell(point - move.place, kSkinReachMm);
    sum += near * move.by;
    weight += near;
  }
  return sum / weight;
}

Vec3 ResidualWarp::operator()(const Vec3& point) const {
  Vec3 by = bySkin(point);
  for (std::size_t i = 0; i < exact_.size(); ++i) by += bell(point - exact_[i].place, kExactReachMm) * weights_[i];
  return point + by;
}

}  // namespace palpate::body

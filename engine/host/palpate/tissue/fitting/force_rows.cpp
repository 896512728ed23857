#include "palpate/tissue/fitting/force_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "palpate/base/error.h"

namespace palpate::tissue {

namespace {

constexpr double kScoreFloor = 0.3;
constexpr Eigen::Index kRowFolds = 5;

std::size_t depthsBelowSkin(const Eigen::ArrayXd& sorted) {
  std::size_t depths = 0;
  for (Eigen::Index i = 0; i < sorted.size(); ++i) {
    if (sorted[i] > 0.0 && (i == 0 || sorted[i] > sorted[i - 1])) ++depths;
  }
  return depths;
}

}  // namespace

ForceRows rowsOf(const ForceCurve& curve) {
  std::vector<std::size_t> order(curve.depth_mm.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return curve.depth_mm[i]; });
  ForceRows rows;
  rows.depth_mm.resize(static_cast<Eigen::Index>(order.size()));
  rows.force_n.resize(rows.depth_mm.size());
  for (Eigen::Index i = 0; i < rows.depth_mm.size(); ++i) {
    rows.depth_mm[i] = curve.depth_mm[order[static_cast<std::size_t>(i)]];
    rows.force_n[i] = curve.force_n[order[static_cast<std::size_t>(i)]];
  }
  const std::string where = curve.name.empty() ? std::string("the curve") : fmt::format("curve '{}'", curve.name);
  const std::size_t depths = depthsBelowSkin(rows.depth_mm);
  if (depths < kMinForceDepths) {
    throw Error(
        fmt::format("{} has {} depths below the skin; at least {} are required", where, depths, kMinForceDepths));
  }
  rows.most_n = rows.force_n.maxCoeff();
  if (!(rows.most_n > 0.0)) throw Error(where + " has no force above 0 N");
  return rows;
}

ForceRows partOf(const ForceRows& rows, const std::vector<Eigen::Index>& which) {
  return {rows.depth_mm(which), rows.force_n(which), rows.most_n};
}

Eigen::ArrayXd scoreWeights(const ForceRows& rows) { return rows.force_n.max(kScoreFloor * rows.most_n).inverse(); }

double scoreRms(const ForceRows& rows, const Eigen::ArrayXd& force_n) {
  return std::sqrt(((force_n - rows.force_n) * scoreWeights(rows)).square().mean());
}

double bestSecant(const Eigen::ArrayXd& effective_mm, const ForceRows& rows, const Eigen::ArrayXd& weights) {
  const Eigen::ArrayXd weighted = effective_mm * weights;
  const double square = weighted.square().sum();
  return square > 0.0 ? std::max(0.0, (weighted * rows.force_n * weights).sum() / square) : 0.0;
}

double unseenRms(const ForceRows& rows, const Predict& predict) {
  const Eigen::Index count = rows.depth_mm.size();
  const Eigen::Index folds = std::min(kRowFolds, count);
  const Eigen::ArrayXd weights = scoreWeights(rows);
  double squares = 0.0;
  for (Eigen::Index fold = 0; fold < folds; ++fold) {
    std::vector<Eigen::Index> seen;
    std::vector<Eigen::Index> left_out;
    for (Eigen::Index i = 0; i < count; ++i) (i % folds == fold ? left_out : seen).push_back(i);
    const ForceRows unseen = partOf(rows, left_out);
    squares += ((predict(seen, unseen.depth_mm) - unseen.force_n) * weights(left_out)).square().sum();
  }
  return std::sqrt(squares / static_cast<double>(count));
}

}  // namespace palpate::tissue

#include "palpate/training/marginal_psi.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate::training {

namespace {

/// Thresholds that are less likely add less than this to the information, and are left out.
constexpr double kLeastThresholdWeight = 1e-12;
/// Levels that differ by less tell as much as each other: the smallest is taken, whatever the last bit says.
constexpr double kSameInformation = 1e-12;

/// x ln x, and its limit.
double timesLog(double x) { return x > 0.0 ? x * std::log(x) : 0.0; }

}  // namespace

MarginalPsi::MarginalPsi(const std::vector<double>& levels, const Posterior& like)
    : levels_(levels.size()),
      thresholds_(like.lnThresholds().size()),
      slopes_(like.slopes().size()),
      lapses_(like.lapses()),
      guess_(1.0 / like.choices()) {
  felt_.reserve(levels_ * thresholds_ * slopes_);
  for (const double level : levels) {
    const double ln_level = std::log(level);
    for (const double ln_t : like.lnThresholds()) {
      for (const double slope : like.slopes()) {
        felt_.push_back(1.0 - std::exp(-std::numbers::ln2 * std::exp(slope * (ln_level - ln_t))));
      }
    }
  }
}

std::vector<double> MarginalPsi::information(const Posterior& posterior) const {
  // Right at a level, jointly with T: guess w_T + sum over slopes of F times what lapse and guess leave of the weight.
  std::vector<double> weight(thresholds_, 0.0);
  std::vector<double> left(thresholds_ * slopes_, 0.0);
  std::size_t cell = 0;
  for (std::size_t t = 0; t < thresholds_; ++t) {
    for (std::size_t s = 0; s < slopes_; ++s) {
      for (const double lapse : lapses_) {
        const double w = posterior.weights()[cell++];
        weight[t] += w;
        left[t * slopes_ + s] += w * (1.0 - guess_ - lapse);
      }
    }
  }
  double all = 0.0;
  double of_t = 0.0;
  for (double& w : weight) {
    if (w < kLeastThresholdWeight) w = 0.0;
    all += w;
    of_t += timesLog(w);
  }
  std::vector<double> told(levels_, 0.0);
  for (std::size_t level = 0; level < levels_; ++level) {
    double right = 0.0;
    double with_t = 0.0;  // minus the entropy that is left when T is known, but for of_t
    for (std::size_t t = 0; t < thresholds_; ++t) {
      if (!(weight[t] > 0.0)) continue;
      const double* felt = &felt_[(level * thresholds_ + t) * slopes_];
      double right_t = guess_ * weight[t];
      for (std::size_t s = 0; s < slopes_; ++s) right_t += felt[s] * left[t * slopes_ + s];
      right += right_t;
      with_t += timesLog(right_t) + timesLog(weight[t] - right_t);
    }
    told[level] = with_t - of_t + timesLog(all) - timesLog(right) - timesLog(all - right);
  }
  return told;
}

std::size_t MarginalPsi::best(const Posterior& posterior) const {
  const std::vector<double> told = information(posterior);
  std::size_t best = 0;
  for (std::size_t i = 1; i < told.size(); ++i) {
    if (told[i] > told[best] + kSameInformation) best = i;
  }
  return best;
}

}  // namespace palpate::training

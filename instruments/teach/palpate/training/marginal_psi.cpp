#include "palpate/training/marginal_psi.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate::training {

namespace {

/// Thresholds that are less likely add less than this to the information, and are left out.
constexpr double kMinThresholdWeight = 1e-12;
/// Levels that differ by less are equally informative: the smallest is chosen, whatever the last bit is.
constexpr double kSameInformation = 1e-12;

/// x ln x, and its limit.
double timesLog(double x) { return x > 0.0 ? x * std::log(x) : 0.0; }

std::size_t firstOfMost(const std::vector<double>& told) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < told.size(); ++i) {
    if (told[i] > told[best] + kSameInformation) best = i;
  }
  return best;
}

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

MarginalPsi::Marginals MarginalPsi::computeMarginals(const Posterior& posterior) const {
  Marginals sums{std::vector<double>(thresholds_, 0.0), std::vector<double>(thresholds_ * slopes_, 0.0)};
  std::size_t cell = 0;
  for (std::size_t t = 0; t < thresholds_; ++t) {
    for (std::size_t s = 0; s < slopes_; ++s) {
      for (const double lapse : lapses_) {
        const double w = posterior.weights()[cell++];
        sums.weight[t] += w;
        sums.left[t * slopes_ + s] += w * (1.0 - guess_ - lapse);
      }
    }
    if (sums.weight[t] < kMinThresholdWeight) sums.weight[t] = 0.0;
  }
  return sums;
}

double MarginalPsi::rightWith(std::size_t level, std::size_t t, const Marginals& marginals) const {
  const double* felt = &felt_[(level * thresholds_ + t) * slopes_];
  const double* left = &marginals.left[t * slopes_];
  double right = guess_ * marginals.weight[t];
  for (std::size_t s = 0; s < slopes_; ++s) right += felt[s] * left[s];
  return right;
}

std::vector<double> MarginalPsi::information(const Posterior& posterior) const {
  const Marginals marginals = computeMarginals(posterior);
  double all = 0.0;
  double of_t = 0.0;
  for (const double w : marginals.weight) {
    all += w;
    of_t += timesLog(w);
  }
  std::vector<double> told(levels_, 0.0);
  for (std::size_t level = 0; level < levels_; ++level) {
    double right = 0.0;
    double with_t = 0.0;  // minus the entropy that is left when T is known, but for of_t
    for (std::size_t t = 0; t < thresholds_; ++t) {
      if (!(marginals.weight[t] > 0.0)) continue;
      const double right_t = rightWith(level, t, marginals);
      right += right_t;
      with_t += timesLog(right_t) + timesLog(marginals.weight[t] - right_t);
    }
    told[level] = with_t - of_t + timesLog(all) - timesLog(right) - timesLog(all - right);
  }
  return told;
}

std::vector<double> MarginalPsi::informationAtMark(const Posterior& posterior, double mark) const {
  const Marginals marginals = computeMarginals(posterior);
  const double cells_to_mark = (std::log(mark) - posterior.lnThresholds().front()) /
                               (posterior.lnThresholds()[1] - posterior.lnThresholds().front());
  // Per T: how much of its cell lies below the mark.
  std::vector<double> share(thresholds_);
  double below = 0.0;
  double above = 0.0;
  for (std::size_t t = 0; t < thresholds_; ++t) {
    share[t] = std::clamp(cells_to_mark - static_cast<double>(t) + 0.5, 0.0, 1.0);
    below += share[t] * marginals.weight[t];
    above += (1.0 - share[t]) * marginals.weight[t];
  }
  std::vector<double> told(levels_, 0.0);
  for (std::size_t level = 0; level < levels_; ++level) {
    double right_below = 0.0;
    double right_above = 0.0;
    for (std::size_t t = 0; t < thresholds_; ++t) {
      if (!(marginals.weight[t] > 0.0)) continue;
      const double right_t = rightWith(level, t, marginals);
      right_below += share[t] * right_t;
      right_above += (1.0 - share[t]) * right_t;
    }
    const double right = right_below + right_above;
    told[level] = timesLog(right_below) + timesLog(below - right_below) + timesLog(right_above) +
                  timesLog(above - right_above) - timesLog(below) - timesLog(above) + timesLog(below + above) -
                  timesLog(right) - timesLog(below + above - right);
  }
  return told;
}

std::size_t MarginalPsi::best(const Posterior& posterior) const { return firstOfMost(information(posterior)); }

std::size_t MarginalPsi::bestAtMark(const Posterior& posterior, double mark) const {
  return firstOfMost(informationAtMark(posterior, mark));
}

}  // namespace palpate::training

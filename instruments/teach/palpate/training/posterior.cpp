#include "palpate/training/posterior.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "palpate/training/psychometric.h"

namespace palpate::training {

namespace {

/// ln T reaches 3 sd of the prior to both sides: 2 to 240 % in steps of 8 %, half of what forty answers leave open.
constexpr std::size_t kThresholdPoints = 61;
constexpr double kThresholdReachSd = 3.0;
/// ln slope reaches 1.5 sd: 0.92 to 3.5 among twelve places. Wider ones cost trials: intervals then cover too often.
constexpr std::size_t kSlopePoints = 7;
constexpr double kSlopeReachSd = 1.5;
constexpr std::array kLapseValues = {0.0, 0.02, 0.05, 0.10};
constexpr std::array kLapseWeights = {0.25, 0.45, 0.22, 0.08};
/// Smaller weights are nothing: they never come back, and numbers below 1e-308 slow every product down.
constexpr double kMinWeight = 1e-200;
/// Quantiles of the 95 % interval.
constexpr double kLowShare = 0.025;
constexpr double kHighShare = 0.975;

/// Evenly spaced, in units of sd.
double standardPlace(std::size_t i, std::size_t points, double reach) {
  return reach * (2.0 * static_cast<double>(i) / static_cast<double>(points - 1) - 1.0);
}

double gaussianWeight(double x) { return std::exp(-0.5 * x * x); }

/// In the order of their places: the same sum from every compiler.
void normalise(std::vector<double>& weights) {
  double sum = 0.0;
  for (const double weight : weights) sum += weight;
  for (double& weight : weights) {
    weight /= sum;
    if (weight < kMinWeight) weight = 0.0;
  }
}

/// The place below which there is this share of the weights, each spread evenly over its cell.
double quantileOf(const std::vector<double>& places, const std::vector<double>& weights, double share) {
  const double cell = places[1] - places[0];
  double below = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (below + weights[i] >= share && weights[i] > 0.0) {
      return places[i] + cell * ((share - below) / weights[i] - 0.5);
    }
    below += weights[i];
  }
  return places.back() + 0.5 * cell;
}

}  // namespace

double ThresholdSummary::halfWidth() const { return 0.5 * std::log(high / low); }

bool ThresholdSummary::isConclusive() const {
  const double widest = std::log(2.0);
  return low > 0.0 && high > 0.0 && halfWidth() <= widest;
}

Posterior::Posterior(int choices, const Prior& prior)
    : choices_(choices), lapses_(kLapseValues.begin(), kLapseValues.end()) {
  const double ln_slope = std::log(prior.slope > 0.0 ? prior.slope : idealSlope(choices));
  for (std::size_t t = 0; t < kThresholdPoints; ++t) {
    const double place = standardPlace(t, kThresholdPoints, kThresholdReachSd);
    ln_t_.push_back(std::log(prior.threshold) + prior.sd_ln_t * place);
  }
  for (std::size_t s = 0; s < kSlopePoints; ++s) {
    slopes_.push_back(std::exp(ln_slope + prior.sd_ln_slope * standardPlace(s, kSlopePoints, kSlopeReachSd)));
  }
  weights_.reserve(kThresholdPoints * kSlopePoints * kLapseValues.size());
  for (std::size_t t = 0; t < kThresholdPoints; ++t) {
    const double of_threshold = gaussianWeight(standardPlace(t, kThresholdPoints, kThresholdReachSd));
    for (std::size_t s = 0; s < kSlopePoints; ++s) {
      const double of_slope = gaussianWeight(standardPlace(s, kSlopePoints, kSlopeReachSd));
      for (const double of_lapse : kLapseWeights) weights_.push_back(of_threshold * of_slope * of_lapse);
    }
  }
  normalise(weights_);
}

void Posterior::add(const Answer& answer) {
  if (answer.choices < 2) return;  // one place to choose from: right whatever was felt
  const double guess = 1.0 / answer.choices;
  const double ln_factor = std::log(thresholdFactor(answer.choices, choices_));
  const double slope_factor = idealSlope(answer.choices) / idealSlope(choices_);
  const double ln_change = std::log(answer.change);
  std::size_t cell = 0;
  for (const double ln_t : ln_t_) {
    const double over = ln_change - ln_t - ln_factor;
    for (const double slope : slopes_) {
      const double felt = 1.0 - std::exp(-std::numbers::ln2 * std::exp(slope * slope_factor * over));
      for (const double lapse : lapses_) {
        const double right = guess + (1.0 - guess - lapse) * felt;
        weights_[cell++] *= answer.correct ? right : 1.0 - right;
      }
    }
  }
  normalise(weights_);
}

std::vector<double> Posterior::thresholdWeights() const {
  const std::size_t each = slopes_.size() * lapses_.size();
  std::vector<double> sums;
  sums.reserve(ln_t_.size());
  for (std::size_t t = 0; t < ln_t_.size(); ++t) {
    double sum = 0.0;
    for (std::size_t i = t * each; i < (t + 1) * each; ++i) sum += weights_[i];
    sums.push_back(sum);
  }
  return sums;
}

ThresholdSummary Posterior::summary() const {
  const std::vector<double> weights = thresholdWeights();
  ThresholdSummary found;
  found.median = std::exp(quantileOf(ln_t_, weights, 0.5));
  found.low = std::exp(quantileOf(ln_t_, weights, kLowShare));
  found.high = std::exp(quantileOf(ln_t_, weights, kHighShare));
  for (std::size_t t = 0; t < weights.size(); ++t) found.mean_ln += weights[t] * ln_t_[t];
  double variance = 0.0;
  for (std::size_t t = 0; t < weights.size(); ++t) {
    variance += weights[t] * (ln_t_[t] - found.mean_ln) * (ln_t_[t] - found.mean_ln);
  }
  found.sd_ln = std::sqrt(variance);
  return found;
}

double Posterior::probabilityBelow(double mark) const {
  const std::vector<double> weights = thresholdWeights();
  const double cell = ln_t_[1] - ln_t_[0];
  const double ln_mark = std::log(mark);
  double below = 0.0;
  for (std::size_t t = 0; t < weights.size(); ++t) {
    below += weights[t] * std::clamp((ln_mark - ln_t_[t]) / cell + 0.5, 0.0, 1.0);
  }
  return below;
}

void Posterior::diffuse(double sd_ln) {
  if (!(sd_ln > 0.0)) return;
  const double cell = ln_t_[1] - ln_t_[0];
  const std::size_t each = slopes_.size() * lapses_.size();
  std::vector<double> wandered(weights_.size(), 0.0);
  std::vector<double> reached(ln_t_.size());
  for (std::size_t from = 0; from < ln_t_.size(); ++from) {
    double all = 0.0;  // weight that stays on the grid: at its borders nothing is lost
    for (std::size_t to = 0; to < ln_t_.size(); ++to) {
      reached[to] = gaussianWeight(cell * (static_cast<double>(to) - static_cast<double>(from)) / sd_ln);
      all += reached[to];
    }
    for (std::size_t to = 0; to < ln_t_.size(); ++to) {
      const double share = reached[to] / all;
      for (std::size_t i = 0; i < each; ++i) wandered[to * each + i] += share * weights_[from * each + i];
    }
  }
  weights_ = std::move(wandered);
  normalise(weights_);
}

}  // namespace palpate::training

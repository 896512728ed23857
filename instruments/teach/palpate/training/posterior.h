// The posterior of a trainee's threshold: a grid of likelihoods over ln T, slope and lapse rate, exact Bayes.
//
//   Answer ─ Posterior::add ─► weights ─► summary (median, 95 % interval), P(T < mark), the next level (marginal_psi.h)
//
// Based on: Kontsevich, Tyler, Vision Research 39:2729, 1999; Prins 2013 (marginal psi).
#pragma once

#include <vector>

#include "palpate/base/language.h"

namespace palpate::training {

/// The belief before the first answer, and the grid: 61 x 7 x 4.
struct Prior {
  double threshold = 0.22;  ///< median of T
  double sd_ln_t = 0.8;
  double slope = 0.0;  ///< median of beta; 0: the ideal observer's for the number of places
  double sd_ln_slope = 0.45;
};

struct Answer {
  double change = 0.0;
  bool correct = false;
  /// Places among which the answer was chosen: those that were felt (exploration.h). The likelihood is that of a
  /// threshold for Posterior::choices places seen through fewer.
  int choices = 12;
};

struct ThresholdSummary {
  double median = 0.0;  ///< median of T, for Posterior::choices places
  double low = 0.0;     ///< 2.5 %
  double high = 0.0;    ///< 97.5 %
  double mean_ln = 0.0;
  double sd_ln = 0.0;
  double halfWidth() const;  ///< in ln T: half of ln(high / low)
  /// Narrow enough to be shown to people: a factor of two either way at most. After one trial the interval is a useless
  /// 10 to 157 %.
  bool isConclusive() const;
};

/// Shown in place of an interval that is not conclusive; tr() shows it.
inline constexpr const char* kMoreTrialsNeeded = toTranslate("more trials needed");

/// Deterministic: the same answers give the same bits on every compiler.
class Posterior {
 public:
  explicit Posterior(int choices = 12, const Prior& prior = {});

  void add(const Answer& answer);
  ThresholdSummary summary() const;
  /// P(T < mark).
  double probabilityBelow(double mark) const;
  /// Another day: ln T may have wandered by `sd_ln` since; slope and lapse keep their distribution.
  void diffuse(double sd_ln);

  int choices() const { return choices_; }
  /// The grid, for pictures, the next level and checks: values, and weights that sum to 1; weight of (t, s, l) is
  /// weights()[(t * slopes + s) * lapses + l].
  const std::vector<double>& lnThresholds() const { return ln_t_; }
  const std::vector<double>& slopes() const { return slopes_; }
  const std::vector<double>& lapses() const { return lapses_; }
  const std::vector<double>& weights() const { return weights_; }
  std::vector<double> thresholdWeights() const;

 private:
  int choices_;
  std::vector<double> ln_t_;
  std::vector<double> slopes_;
  std::vector<double> lapses_;
  std::vector<double> weights_;
};

}  // namespace palpate::training

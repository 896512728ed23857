// Likelihoods of ln T from answers alone, without a prior: for curves and groups, where a prior that pulls every person
// to the middle would pull their mean too.
//
//   answers ─ thresholdLikelihood ─► ThresholdLikelihood ─► fitLearning (learning_curve.h), groupThreshold
//   (group_estimate.h)
#pragma once

#include <span>
#include <vector>

#include "palpate/training/posterior.h"

namespace palpate::training {

/// Over evenly spaced places, of a cell each; the largest is 1. Slope and lapse rate are summed out.
struct ThresholdLikelihood {
  std::vector<double> places;  ///< ln T, or a difference of two
  std::vector<double> values;
  double cell() const { return places[1] - places[0]; }
};

ThresholdLikelihood thresholdLikelihood(std::span<const Answer> answers, int choices = 12);

/// The likelihood of one person's ln T_after - ln T_before, whatever T was before.
ThresholdLikelihood changeLikelihood(const ThresholdLikelihood& before, const ThresholdLikelihood& after);

/// The same as if T had wandered by `sd_ln` between the answers and now.
ThresholdLikelihood blurred(const ThresholdLikelihood& likelihood, double sd_ln);

}  // namespace palpate::training

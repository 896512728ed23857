// Thresholds of a group, and how they changed: estimated from all people's answers at once.
//
// The mean of the reported medians is pulled towards the prior, and its standard error leaves out how unsure each of
// them is. Here ln T of a person is a draw from a normal whose mean and spread are fitted to all answers
// (thresholdLikelihood), so that neither happens.
//
//   answers of each person ─ thresholdLikelihood ─► groupThreshold ─► mean of T, its 95 % interval, spread of people
//   before, after of each  ─ changeLikelihood ─► groupChange ─► factor, its 95 % interval
//
// Based on: Dempster, Laird, Rubin, J. Royal Statistical Society B 39:1, 1977 (EM); Louis, same journal 44:226, 1982
// (its standard error).
#pragma once

#include <span>

#include "palpate/training/threshold_likelihood.h"

namespace palpate::training {

struct GroupEstimate {
  int people = 0;
  double mean = 0.0;  ///< mean of T over people (arithmetic)
  double low = 0.0;   ///< 95 % interval of the mean
  double high = 0.0;
  double sd = 0.0;  ///< SD of T over people, without measurement noise
  // The same in ln T.
  double mean_ln = 0.0;
  double error_of_mean_ln = 0.0;
  double sd_ln = 0.0;
};

/// Needs two people or more; with fewer only `people` is filled in.
GroupEstimate groupThreshold(std::span<const ThresholdLikelihood> people);

struct GroupChange {
  int people = 0;
  double factor = 1.0;  ///< T before over T after, geometric mean over people
  double low = 1.0;     ///< 95 % interval
  double high = 1.0;
  double sd_ln = 0.0;  ///< over people
  bool real() const { return low > 1.0 || high < 1.0; }
};

/// `people`: changeLikelihood of each.
GroupChange groupChange(std::span<const ThresholdLikelihood> people);

/// Two-sided 5 % of Student's distribution: to 0.004 for three degrees of freedom, to 0.001 from five on.
double student95(int degrees_of_freedom);

}  // namespace palpate::training

// The psychometric function: how often an answer is right at a change d.
//
//   P(d) = guess + (1 - guess - lapse) F(d),  F(d) = 1 - exp(-ln 2 (d / T)^slope)
//
// T, the threshold, is the change at which F is one half: corrected for guesses and lapses. This definition belongs to
// every number that is shown (kThresholdDefinition). An ideal observer whose d' grows with the change has a slope
// of 1.80 among twelve places and 1.22 among two (between F = 1/4 and 3/4; 1.24 at one half), and its T among twelve is
// 1.78 times that among two: thresholds of different numbers of places must not be compared without `thresholdFactor`.
// Based on: Weibull form as in Watson, QUEST+, J. Vision 17(3):10, 2017; Prins, J. Vision
// 12(6):25, 2012 (lapses).
#pragma once

#include "palpate/base/language.h"

namespace palpate::training {

/// Probability below x of a standard normal. lumps/lump_observer.h has its own with the same bits on every platform.
double standardNormalBelow(double x);
/// The x with this probability below it, in (0, 1); to 1e-12, by bisection.
double standardNormalQuantile(double share);

struct Psychometric {
  double threshold = 0.22;  ///< T, a change in (0, 1]
  double slope = 1.8;       ///< beta
  double lapse = 0.02;      ///< wrong whatever there was to feel
  double guess = 1.0 / 12;  ///< right without feeling anything
};

/// In [guess, 1 - lapse]; rises with the change.
double probabilityCorrect(const Psychometric& function, double change);

/// Beta of the ideal observer among `choices` places (>= 2).
double idealSlope(int choices);
/// T among `choices` places over T of the same observer among `reference` places.
double thresholdFactor(int choices, int reference);

/// In English, for tr().
inline constexpr const char* kThresholdDefinition = toTranslate(
    "T: the change at which answers, corrected for guesses and lapses, are right half of the time (version 1)");

}  // namespace palpate::training

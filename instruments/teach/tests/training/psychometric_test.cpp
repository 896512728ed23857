#include "palpate/training/psychometric.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/random.h"

namespace palpate::training {

TEST(Psychometric, IsHalfWayBetweenGuessesAndLapsesAtTheThreshold) {
  const Psychometric function{.threshold = 0.2, .slope = 1.8, .lapse = 0.04, .guess = 1.0 / 12.0};
  EXPECT_NEAR(probabilityCorrect(function, 0.2), 0.5 * (1.0 / 12.0 + 0.96), 1e-15);
  EXPECT_NEAR(probabilityCorrect(function, 0.4),
              1.0 / 12.0 + (1.0 - 1.0 / 12.0 - 0.04) * (1.0 - std::pow(0.5, std::pow(2.0, 1.8))), 1e-15);
}

TEST(Psychometric, StaysBetweenGuessesAndLapsesAndRises) {
  const Psychometric function{.threshold = 0.1, .slope = 3.0, .lapse = 0.05, .guess = 0.5};
  double before = probabilityCorrect(function, 0.0);
  EXPECT_EQ(before, 0.5);
  for (double change = 0.01; change < 1.0; change += 0.01) {
    const double now = probabilityCorrect(function, change);
    EXPECT_GE(now, before);
    EXPECT_LE(now, 0.95 + 1e-15);
    before = now;
  }
  EXPECT_NEAR(before, 0.95, 1e-12);
}

TEST(IdealObserver, AmongTwoPlacesIsTheKnownClosedForm) {
  // Among two, P = Phi(d' / sqrt 2), so F = erf(d' / 2): one half at d' = 0.9539, a quarter at 0.4506, 3/4 at 1.6268.
  const double weibull_rise = std::log(std::log(4.0) / std::log(4.0 / 3.0));
  EXPECT_NEAR(std::erf(0.450624 / 2.0), 0.25, 1e-5);
  EXPECT_NEAR(std::erf(1.62684 / 2.0), 0.75, 1e-5);
  EXPECT_NEAR(idealSlope(2), weibull_rise / std::log(1.62684 / 0.450624), 1e-4);
  EXPECT_NEAR(idealSlope(2), 1.24, 0.02);
  EXPECT_NEAR(idealSlope(12), 1.80, 0.005);
  EXPECT_NEAR(thresholdFactor(12, 2), 1.78, 0.005);
}

TEST(IdealObserver, IsRightHalfOfTheTimeWhenItsNoiseIsDrawn) {
  // d' at which F is one half among twelve is 1.697 = 0.9539 x thresholdFactor(12, 2); tried by drawing.
  for (const int choices : {3, 8, 12, 20}) {
    const double d_prime = 0.95387 * thresholdFactor(choices, 2);
    Random random(5);
    constexpr int kTrials = 40'000;
    int right = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      const double target = d_prime + random.normal();
      bool strongest = true;
      for (int other = 1; other < choices && strongest; ++other) strongest = random.normal() < target;
      if (strongest) ++right;
    }
    const double felt = (static_cast<double>(right) / kTrials - 1.0 / choices) / (1.0 - 1.0 / choices);
    EXPECT_NEAR(felt, 0.5, 4.0 * 0.5 / std::sqrt(kTrials)) << choices;
  }
}

TEST(IdealObserver, ComparesAnyNumbersOfPlaces) {
  EXPECT_EQ(thresholdFactor(12, 12), 1.0);
  EXPECT_NEAR(thresholdFactor(2, 12) * thresholdFactor(12, 2), 1.0, 1e-15);
  for (int choices = 3; choices <= 45; ++choices) {  // those over 40 are not kept
    EXPECT_GT(thresholdFactor(choices, 12), thresholdFactor(choices - 1, 12));
    EXPECT_GT(idealSlope(choices), idealSlope(choices - 1));
  }
}

}  // namespace palpate::training

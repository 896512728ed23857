// The simulated observer of pictures: its arithmetic, its test, and a small cut of the pictures themselves.
#include "teach/study/eye_observer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/training/protocol.h"
#include "report/tests/report/says.h"
#include "teach/study/asked_test.h"

namespace palpate::study {
namespace {

const std::vector<double> kEvenSinks(12, 18.0);

double meanThreshold(const EyeNoise& noise) {
  const training::BlockSettings& settings = training::builtInProtocol().pre_test.block;
  double sum = 0.0;
  for (std::size_t i = 0; i < 20; ++i) sum += eyeTest(kEvenSinks, settings, noise, runSeed(1, 0, i)).threshold.median;
  return sum / 20.0;
}

EyeMeasurement someEye() {
  EyeMeasurement found;
  found.first.threshold = {.median = 0.25, .low = 0.18, .high = 0.33};
  found.d_prime_sink = 3.0;
  found.d_prime_rings = 2.5;
  return found;
}

TEST(EyeObserver, ADPrimeIsTheDifferenceOverTheReadersNoiseAndTheSpreadOfPlaces) {
  const EyeNoise noise{.floor_px = 3.0, .share = 0.4};  // of 10 px: 5
  EXPECT_NEAR(noise.of(10.0), 5.0, 1e-12);
  EXPECT_NEAR(computeDPrime({10.0, 10.0}, {5.0, 5.0}, noise), 1.0, 1e-12);
  EXPECT_NEAR(computeDPrime({8.0, 12.0}, {3.0, 7.0}, noise), 5.0 / std::sqrt(8.0 + 25.0), 1e-12);
}

TEST(EyeObserver, FindsSmallerChangesTheLessItsEyeErrs) {
  const double keen = meanThreshold({.floor_px = 0.5, .share = 0.05});
  const double usual = meanThreshold({});
  const double poor = meanThreshold({.floor_px = 4.0, .share = 0.1});
  EXPECT_LT(keen, 0.8 * usual);
  EXPECT_LT(usual, 0.8 * poor);
  // Of an ideal observer: the change at which d' is 1.70 (training/trainee/observer.h).
  EXPECT_NEAR(usual, 1.7 * EyeNoise{}.of(18.0) / 18.0, 0.06);
}

TEST(EyeObserver, EveryBarCanBeMissed) {
  EXPECT_TRUE(eyeBarsMet(someEye()));
  const auto met_after = [](const auto& spoil) {
    EyeMeasurement found = someEye();
    spoil(found);
    return eyeBarsMet(found);
  };
  EXPECT_FALSE(met_after([](auto& found) { found.first.threshold = {.median = 0.4, .low = 0.3, .high = 0.5}; }));
  EXPECT_FALSE(met_after([](auto& found) { found.first.threshold.high = 1.57; }));
  EXPECT_FALSE(met_after([](auto& found) { found.d_prime_sink = 1.9; }));
  EXPECT_FALSE(met_after([](auto& found) { found.d_prime_rings = 1.9; }));
}

TEST(EyeObserver, TwelvePressesOfAChangeOf40PercentAreDistinguishableInThePicture) {
  const StudyPage page = studyEye({.quick = true});
  const auto number = [&](const std::string& name) {
    for (const auto& [key, value] : page.numbers) {
      if (key == name) return value;
    }
    return std::nan("");
  };
  EXPECT_GE(number("d_prime_sink"), 2.0);
  EXPECT_GE(number("d_prime_rings"), 2.0);
  EXPECT_NEAR(number("sink_stiffer_px"), 0.6 * number("sink_normal_px"), 0.1 * number("sink_normal_px"))
      << "by Hooke's law, and linear in the picture";
  EXPECT_LE(number("threshold_stiffness_percent"), 60.0);
  EXPECT_TRUE(says(page.findings, "Simulated, no person took part"));
}

}  // namespace
}  // namespace palpate::study

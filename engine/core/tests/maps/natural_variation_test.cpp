// A random field judged by its statistics: many places of a plane, at two densities, and of a box.
#include "palpate/maps/natural_variation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace palpate::maps {
namespace {

/// A square of so many millimetres, tilted so that no axis of it is an axis of the body's.
std::vector<Vec3> tiltedSquare(double size_mm, double step_mm) {
  const Vec3 along = Vec3(2, 1, -1).normalized();
  const Vec3 across = along.cross(Vec3(0.3, -1, 0.5)).normalized();
  std::vector<Vec3> places;
  for (double y = 0; y < size_mm; y += step_mm) {
    for (double x = 0; x < size_mm; x += step_mm) places.emplace_back(Vec3(-400, 90, 30) + x * along + y * across);
  }
  return places;
}

struct Statistics {
  double mean = 0.0;
  double variation = 0.0;  ///< standard deviation over mean
};

Statistics statisticsOf(const std::vector<double>& values) {
  Statistics found;
  for (const double value : values) found.mean += value / static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - found.mean) * (value - found.mean);
  found.variation = std::sqrt(squares / static_cast<double>(values.size())) / found.mean;
  return found;
}

/// Of the logarithms' deviations from the one at places shifted by this much.
double correlation(const std::vector<Vec3>& places, const Vec3& shift, const NaturalVariation& variation) {
  std::vector<Vec3> shifted = places;
  for (Vec3& place : shifted) place += shift;
  const std::vector<double> here = variationAt(places, variation);
  const std::vector<double> there = variationAt(shifted, variation);
  const double middle = -0.5 * std::log1p(variation.variation * variation.variation);
  double both = 0.0, one = 0.0, other = 0.0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    const double a = std::log(here[i]) - middle;
    const double b = std::log(there[i]) - middle;
    both += a * b;
    one += a * a;
    other += b * b;
  }
  return both / std::sqrt(one * other);
}

TEST(NaturalVariation, OffIsOneAndChangesNoBit) {
  const std::vector<Vec3> places = tiltedSquare(100, 7);
  EXPECT_EQ(variationAt(places, {}), std::vector<double>(places.size(), 1.0));
  std::vector<double> stiffness(places.size(), 1.0 / 3.0);
  applyVariation(places, {.variation = 0.0, .seed = 9}, stiffness);
  EXPECT_EQ(stiffness, std::vector<double>(places.size(), 1.0 / 3.0));
}

TEST(NaturalVariation, HasTheMeanAndTheSpreadThatIsAskedForAtEveryDensity) {
  for (const double asked : {0.05, 0.15, 0.5}) {
    for (const double step_mm : {4.0, 9.0}) {
      const std::vector<double> factors =
          variationAt(tiltedSquare(1500, step_mm), {.variation = asked, .length_mm = 12.0, .seed = 3});
      const Statistics found = statisticsOf(factors);
      // Some 10,000 places that know nothing of each other: the mean is uncertain by a hundredth of the spread.
      EXPECT_NEAR(found.mean, 1.0, 0.04 * asked) << asked << " " << step_mm;
      EXPECT_NEAR(found.variation, asked, 0.05 * asked) << asked << " " << step_mm;
      EXPECT_GT(*std::min_element(factors.begin(), factors.end()), 0.2);
      EXPECT_LT(*std::max_element(factors.begin(), factors.end()), 4.0);
    }
  }
}

TEST(NaturalVariation, CorrelatesOverTheLengthInEveryDirection) {
  const std::vector<Vec3> places = tiltedSquare(1200, 10);
  for (const double length_mm : {6.0, 12.0, 20.0}) {
    const NaturalVariation variation{.variation = 0.2, .length_mm = length_mm, .seed = 11};
    for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 0.6, 0.8), Vec3(0.577, 0.577, -0.577)}) {
      for (const double share : {0.25, 0.5, 1.0, 2.0}) {
        EXPECT_NEAR(correlation(places, share * length_mm * direction, variation), std::exp(-share * share), 0.04)
            << length_mm << " " << direction.transpose() << " " << share;
      }
    }
  }
}

TEST(NaturalVariation, IsAFunctionOfThePlaceAndNotOfItsNumber) {
  const NaturalVariation variation{.variation = 0.3, .length_mm = 15.0, .seed = 5};
  std::vector<Vec3> places = tiltedSquare(300, 6);
  const std::vector<double> once = variationAt(places, variation);
  std::reverse(places.begin(), places.end());
  std::vector<double> again = variationAt(places, variation);
  std::reverse(again.begin(), again.end());
  EXPECT_EQ(once, again);
}

TEST(NaturalVariation, IsSmooth) {
  const NaturalVariation variation{.variation = 0.3, .length_mm = 12.0, .seed = 5};
  std::vector<Vec3> line;
  for (int i = 0; i < 20000; ++i) line.emplace_back(0.01 * i - 50.0, 0.3 * 0.01 * i, 7.0);
  const std::vector<double> factors = variationAt(line, variation);
  double steepest = 0.0;
  for (std::size_t i = 1; i < factors.size(); ++i) {
    steepest = std::max(steepest, std::abs(std::log(factors[i] / factors[i - 1])));
  }
  // The root mean square of the slope is 0.294 sqrt(2) / 12 a millimetre; four of them over 0.01 mm, and the noise's
  // own end at the sixth lattice point, exp(-8).
  EXPECT_LT(steepest, 4 * 0.294 * 1.42 / 12.0 * 0.0105 + 1e-3);
}

TEST(NaturalVariation, AnotherSeedIsAnotherBody) {
  const std::vector<Vec3> places = tiltedSquare(1000, 10);
  const auto deviations = [&](std::uint32_t seed) {
    std::vector<double> factors = variationAt(places, {.variation = 0.2, .length_mm = 12.0, .seed = seed});
    for (double& factor : factors) factor -= 1.0;
    return factors;
  };
  for (const std::uint32_t seed : {0u, 2u, 3u, 4'000'000'000u}) {
    const std::vector<double> a = deviations(1);
    const std::vector<double> b = deviations(seed);
    double both = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) both += a[i] * b[i];
    EXPECT_LT(std::abs(both) / (0.04 * static_cast<double>(a.size())), 0.06) << seed;
  }
}

/// Some as one machine had them.
TEST(NaturalVariation, IsTheSameOnEveryMachine) {
  const std::vector<Vec3> places = {{0, 0, 0}, {12.5, -3.25, 100}, {-333, 210, 41}};
  const std::vector<double> factors = variationAt(places, {.variation = 0.2, .length_mm = 12.0, .seed = 1});
  const std::vector<double> written = {0.87132759404829419, 1.0550158984223115, 1.0315269588179599};
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(factors[i], written[i], 1e-12) << i;
}

}  // namespace
}  // namespace palpate::maps

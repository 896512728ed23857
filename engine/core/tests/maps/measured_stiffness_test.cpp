#include "palpate/maps/measured_stiffness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "palpate/base/random.h"
#include "support/error_message.h"

namespace palpate::maps {

using support::thrownMessage;

constexpr auto kGri = StiffnessInterpolation::gri;
constexpr auto kThinPlate = StiffnessInterpolation::thin_plate;
constexpr auto kPolynomial = StiffnessInterpolation::polynomial;

std::vector<Vec2> scattered(std::size_t number, std::uint64_t seed = 7) {
  Random random(seed);
  std::vector<Vec2> places;
  for (std::size_t i = 0; i < number; ++i) places.emplace_back(random.uniform(-180, 180), random.uniform(300, 700));
  return places;
}

std::vector<double> sampled(const std::vector<Vec2>& places, const std::function<double(const Vec2&)>& f) {
  std::vector<double> values;
  for (const Vec2& place : places) values.push_back(f(place));
  return values;
}

KeyPoint stiffPoint(double x, double y, double n_per_mm) { return {"K", {x, y}, {}, n_per_mm}; }

/// Seven places like the dissertation's.
std::vector<KeyPoint> sevenPoints() {
  return {stiffPoint(0, 73, 0.9),       stiffPoint(0, -62, 0.7),  stiffPoint(0, -173, 0.6),   stiffPoint(-100, 5, 0.5),
          stiffPoint(-100, -117, 0.35), stiffPoint(100, 5, 0.52), stiffPoint(100, -117, 0.33)};
}

MeasuredStiffness by(StiffnessInterpolation interpolation, std::size_t degree = 2) {
  MeasuredStiffness settings;
  settings.interpolation = interpolation;
  settings.polynomial_degree = degree;
  return settings;
}

TEST(ThinPlate, GoesThroughEveryValue) {
  for (const std::size_t n : {3u, 7u, 200u}) {
    const auto places = scattered(n);
    Random random(n);
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(random.uniform(0.2, 1.5));
    const ThinPlateSpline spline(places, values);
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(spline.at(places[i]), values[i], 1e-9) << n;
  }
}

TEST(ThinPlate, ReproducesAffineFunctionsEverywhere) {
  const auto affine = [](const Vec2& p) { return 0.4 + 1e-3 * p.x() - 2e-3 * p.y(); };
  const auto places = scattered(12);
  const ThinPlateSpline spline(places, sampled(places, affine));
  for (const Vec2& p : scattered(50, 3)) EXPECT_NEAR(spline.at(3.0 * p), affine(3.0 * p), 1e-9);
}

// The kernel depends on distances only, so turning and shifting the places turns and shifts the surface.
TEST(ThinPlate, DoesNotDependOnTheFrame) {
  const auto places = scattered(9);
  std::vector<Vec2> turned;
  for (const Vec2& p : places) turned.emplace_back(p.y() + 5000.0, -p.x() - 70.0);
  const auto values =
      sampled(places, [](const Vec2& p) { return std::sin(0.01 * p.x()) + 0.3 * std::cos(0.02 * p.y()); });
  const ThinPlateSpline a(places, values);
  const ThinPlateSpline b(turned, values);
  for (const Vec2& p : scattered(30, 5)) EXPECT_NEAR(a.at(p), b.at(Vec2(p.y() + 5000.0, -p.x() - 70.0)), 1e-8);
}

TEST(ThinPlate, CoincidentPlacesAreAveraged) {
  std::vector<Vec2> places = scattered(6);
  std::vector<double> values(6, 0.5);
  places.push_back(places[2]);
  values.push_back(0.9);
  EXPECT_NEAR(ThinPlateSpline(places, values).at(places[2]), 0.7, 1e-9);
}

TEST(ThinPlate, RefusesWhatDeterminesNoPlane) {
  const std::string line = "thin-plate spline: requires three key points that are not on one line";
  const auto error = [](const std::vector<Vec2>& places) {
    return thrownMessage([&] { ThinPlateSpline(places, std::vector<double>(places.size(), 1.0)); });
  };
  EXPECT_EQ(error({}), line);
  EXPECT_EQ(error({{0, 0}}), line);
  EXPECT_EQ(error({{0, 0}, {1, 5}}), line);
  EXPECT_EQ(error({{0, 0}, {1, 5}, {2, 10}, {-3, -15}}), line);
  EXPECT_EQ(error({{0, 0}, {1, 5}, {1, 5}}), line);
  EXPECT_EQ(error({{0, 0}, {1, 5}, {NAN, 10}}), "thin-plate spline: points and values must be finite");
  EXPECT_EQ(error(std::vector<Vec2>(2001, Vec2(0, 0))), "thin-plate spline: 2001 key points; expected at most 2000");
}

TEST(Polynomial, ReproducesPolynomialsOfItsDegree) {
  for (std::size_t degree = 0; degree <= kMaxPolynomialDegree; ++degree) {
    const auto f = [&](const Vec2& p) {  // far from the origin, where plain powers of millimetres are hopeless
      double value = 0.3;
      for (std::size_t d = 1; d <= degree; ++d) value += std::pow(0.006 * p.x() - 0.004 * (p.y() - 500), d) / (1.0 + d);
      return value;
    };
    const auto places = scattered(polynomialTerms(degree) + 20);
    const PolynomialSurface surface(places, sampled(places, f), degree);
    for (const Vec2& p : scattered(30, 11)) EXPECT_NEAR(surface.at(p), f(p), 1e-8) << degree;
  }
}

TEST(Polynomial, IsTheLeastSquaresFit) {
  const std::vector<Vec2> places{{0, 0}, {10, 0}, {0, 10}, {10, 10}};
  const PolynomialSurface mean(places, std::vector<double>{1, 2, 3, 6}, 0);
  EXPECT_NEAR(mean.at(Vec2(5, 5)), 3.0, 1e-12);
  // z = 1 + 0.3 x + 0.4 y but for the twist 0.5 (1, -1, -1, 1), which a plane cannot follow.
  const PolynomialSurface plane(places, std::vector<double>{1.5, 3.5, 4.5, 8.5}, 1);
  EXPECT_NEAR(plane.at(Vec2(0, 0)), 1.0, 1e-12);
  EXPECT_NEAR(plane.at(Vec2(10, 10)), 8.0, 1e-12);
}

TEST(Polynomial, TooFewPlacesOrTooRegularOnesAreRefused) {
  const auto error = [](const std::vector<Vec2>& places, std::size_t degree) {
    return thrownMessage([&] { PolynomialSurface(places, std::vector<double>(places.size(), 1.0), degree); });
  };
  EXPECT_EQ(error(scattered(7), 3), "polynomial of degree 3: requires 10 key points, got 7");
  EXPECT_EQ(error({{0, 0}, {1, 1}, {2, 2}}, 1),
            "polynomial of degree 1: the key points determine only 2 of its 3 terms; lower the degree or add points");
  EXPECT_EQ(error(scattered(100), 9), "polynomial: degree 9 is too high; expected at most 8");
  EXPECT_EQ(error({{0, 0}, {1, INFINITY}, {2, 2}}, 1), "polynomial: points and values must be finite");
}

TEST(MeasuredStiffness, PointsAreMetAndFadeToTheBasicValue) {
  std::vector<KeyPoint> keys(3);
  keys[0].position_mm = {0, 0};
  keys[0].stiffness_n_per_mm = 0.9;
  keys[1].position_mm = {50, 0};
  keys[1].stiffness_n_per_mm = 0.4;
  keys[2].position_mm = {25, 0};  // an ellipse only: no say in stiffness
  const std::vector<Vec3> positions{{0, 0, 5}, {50, 0, -7}, {1000, 0, 0}, {25, 0, 0}};
  const auto k = measuredStiffness(positions, keys, {100.0, 0.5}).n_per_mm;
  EXPECT_DOUBLE_EQ(k[0], 0.9);
  EXPECT_DOUBLE_EQ(k[1], 0.4);
  EXPECT_DOUBLE_EQ(k[2], 0.5);
  EXPECT_GT(k[3], 0.4);
  EXPECT_LT(k[3], 0.9);
}

TEST(MeasuredStiffness, InterpolationsAreExactAtTheKeysAndTheTrendSaysHowFarOff) {
  const auto keys = sevenPoints();
  EXPECT_EQ(MeasuredStiffnessField(keys, by(kGri)).fitError().max, 0.0);
  EXPECT_LT(MeasuredStiffnessField(keys, by(kThinPlate)).fitError().max, 1e-12);
  double last = 1.0;
  for (const std::size_t degree : {0u, 1u, 2u}) {
    const MeasuredStiffnessField field(keys, by(kPolynomial, degree));
    double rms = 0.0;
    double max = 0.0;
    for (const KeyPoint& key : keys) {
      const double miss = std::abs(field.fittedAt(key.position_mm) - *key.stiffness_n_per_mm);
      rms += miss * miss / 7.0;
      max = std::max(max, miss);
    }
    EXPECT_NEAR(field.fitError().rms, std::sqrt(rms), 1e-15);
    EXPECT_NEAR(field.fitError().max, max, 1e-15);
    EXPECT_LT(field.fitError().rms, last);  // more terms, nearer
    last = field.fitError().rms;
  }
}

TEST(MeasuredStiffness, GriTakesAnyNumberOfKeys) {
  for (const std::size_t n : {0u, 1u, 2u, 7u, 10000u}) {
    std::vector<KeyPoint> keys;
    Random random(n);
    for (const Vec2& p : scattered(n)) keys.push_back(stiffPoint(p.x(), p.y(), random.uniform(0.2, 1.0)));
    const MeasuredStiffnessField field(keys, {20.0, 0.5});
    EXPECT_NEAR(field.fitError().max, 0.0, 1e-12) << n;
    EXPECT_EQ(field.at(Vec2(1e6, 0)), 0.5) << n;
    EXPECT_GE(field.at(Vec2(0, 500)), 0.2) << n;
    EXPECT_LE(field.at(Vec2(0, 500)), 1.0) << n;
  }
}

TEST(MeasuredStiffness, KeysWithoutAStiffnessAreLeftOut) {
  auto keys = sevenPoints();
  keys.push_back({"none", {50, 50}, {100.0, 1.0}, {}});
  const MeasuredStiffnessField with(keys, by(kThinPlate));
  const MeasuredStiffnessField without(sevenPoints(), by(kThinPlate));
  EXPECT_EQ(with.at(Vec2(50, 50)), without.at(Vec2(50, 50)));
}

TEST(MeasuredStiffness, CoincidentKeysAreAveragedAndTheirDisagreementReported) {
  auto keys = sevenPoints();
  keys.push_back(stiffPoint(0, 73, 1.1));
  for (const auto interpolation : {kGri, kThinPlate}) {
    const MeasuredStiffnessField field(keys, by(interpolation));
    EXPECT_NEAR(field.at(Vec2(0, 73)), 1.0, 1e-9);
    EXPECT_NEAR(field.fitError().max, 0.1, 1e-9);
  }
}

// Far outside, a plane or parabola through the keys crosses zero; the body must still push back.
TEST(MeasuredStiffness, FitsThatRunAwayAreLimitedAndCounted) {
  const std::vector<Vec3> positions{{0, 0, 0}, {0, -5000, 0}, {0, 9000, 10}, {20, -50, 3}};
  for (const auto interpolation : {kThinPlate, kPolynomial}) {
    const StiffnessOfPositions stiffness = measuredStiffness(positions, sevenPoints(), by(interpolation));
    EXPECT_EQ(stiffness.limited, 2u);
    for (const double k : stiffness.n_per_mm) {
      EXPECT_GE(k, 0.33 / 4.0 - 1e-12);
      EXPECT_LE(k, 4.0 * 0.9 + 1e-12);
    }
  }
  EXPECT_EQ(measuredStiffness(positions, sevenPoints()).limited, 0u);
}

TEST(MeasuredStiffness, ZeroEverywhereStillPushesBackALittle) {
  std::vector<KeyPoint> keys{stiffPoint(0, 0, 0.0), stiffPoint(100, 0, 0.0), stiffPoint(0, 100, 0.0)};
  EXPECT_EQ(MeasuredStiffnessField(keys, by(kThinPlate)).at(Vec2(10, 10)), 0.01);
}

TEST(MeasuredStiffness, TooFewKeysAreAnError) {
  EXPECT_EQ(thrownMessage([] { MeasuredStiffnessField({}, by(kPolynomial, 1)); }),
            "polynomial of degree 1: requires 3 key points, got 0");
  EXPECT_EQ(thrownMessage([] { MeasuredStiffnessField({}, by(kThinPlate)); }),
            "thin-plate spline: requires three key points that are not on one line");
}

}  // namespace palpate::maps

#include "palpate/maps/polar_contour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "palpate/base/random.h"
#include "support/error_message.h"

namespace palpate::maps {

constexpr double kPi = std::numbers::pi;

/// Radii between 50 and 150 mm.
PolarContour raggedContour(std::size_t radii, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> radii_mm;
  for (std::size_t i = 0; i < radii; ++i) radii_mm.push_back(random.uniform(50.0, 150.0));
  return contourOf(radii_mm);
}

/// Largest relative difference of location ratios all round.
double worstDifference(const PolarContour& contour, const Ellipse& ellipse) {
  double worst = 0.0;
  for (int i = 0; i < 3600; ++i) {
    const Vec2 offset(std::cos(i * kPi / 1800), std::sin(i * kPi / 1800));
    const double wanted = locationRatio(ellipse, offset);
    worst = std::max(worst, std::abs(locationRatio(contour, offset) - wanted) / wanted);
  }
  return worst;
}

TEST(PolarContour, KeepsItsRadii) {
  const std::vector<double> radii{100, 80, 60, 90, 120};
  const PolarContour contour = contourOf(radii);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    EXPECT_NEAR(radiusAt(contour, 2 * kPi * static_cast<double>(i) / 5), radii[i], 1e-9);
    EXPECT_NEAR(radiusAt(contour, 2 * kPi * static_cast<double>(i) / 5 - 4 * kPi), radii[i], 1e-9);
  }
}

TEST(PolarContour, LocationRatioIsDistanceOverRadius) {
  const PolarContour contour = contourOf(std::vector<double>{100, 50, 100, 50});
  EXPECT_DOUBLE_EQ(locationRatio(contour, Vec2(50, 0)), 0.5);
  EXPECT_NEAR(locationRatio(contour, Vec2(0, -25)), 0.5, 1e-12);
  EXPECT_EQ(locationRatio(contour, Vec2(0, 0)), 0.0);
}

// The bounds that docs/explanation/maps.md states.
TEST(PolarContour, EllipseComesBackWithinTheStatedBound) {
  for (const double degree : {0.0, 17.0, 90.0, 121.0}) {
    const auto worst = [&](double aspect, std::size_t radii) {
      const Ellipse ellipse{150.0, aspect, degree * kPi / 180};
      return worstDifference(contourOf(ellipse, radii), ellipse);
    };
    EXPECT_LT(worst(1.0, 8), 1e-14);
    EXPECT_LT(worst(0.7, 16), 7e-3);
    EXPECT_LT(worst(0.7, 32), 1e-3);
    EXPECT_LT(worst(0.7, 64), 1e-4);
    EXPECT_LT(worst(0.4, 64), 1e-3);
  }
}

TEST(PolarContour, IsSmoothAndPositiveAllRound) {
  for (const std::size_t radii : {3u, 7u, 64u}) {
    const PolarContour contour = raggedContour(radii, radii);
    constexpr double kStep = 1e-4;
    for (double angle = -4.0; angle < 4.0; angle += 0.0137) {
      const double before = radiusAt(contour, angle - kStep);
      const double here = radiusAt(contour, angle);
      const double after = radiusAt(contour, angle + kStep);
      EXPECT_GT(here, 0.0);
      EXPECT_LT(std::abs((after - here) - (here - before)) / kStep, 20.0) << radii << " at " << angle;  // no kink
    }
  }
}

TEST(PolarContour, EmptyContourHoldsNothingButItsCentre) {
  const PolarContour empty = contourOf(Ellipse{});
  EXPECT_EQ(empty.count, 0u);
  EXPECT_EQ(locationRatio(empty, Vec2(0, 0)), 0.0);
  EXPECT_EQ(locationRatio(empty, Vec2(1e-9, 0)), std::numeric_limits<double>::infinity());
  EXPECT_EQ(radiusAt(empty, 1.0), 0.0);
}

TEST(PolarContour, RefusesWhatIsNoContour) {
  EXPECT_EQ(support::thrownMessage([] { contourOf(std::vector<double>{1, 2}); }), "contour: 2 radii; expected 3 to 64");
  EXPECT_EQ(support::thrownMessage([] { contourOf(std::vector<double>(65, 1.0)); }),
            "contour: 65 radii; expected 3 to 64");
  EXPECT_EQ(support::thrownMessage([] {
              contourOf(std::vector<double>{1, 0, 3});
            }),
            "contour: radius 2 of 3 must be above 0 mm, got 0");
  EXPECT_EQ(support::thrownMessage([] {
              contourOf(std::vector<double>{1, 2, NAN});
            }),
            "contour: radius 3 of 3 must be above 0 mm, got nan");
  EXPECT_EQ(support::thrownMessage([] { contourOf(Ellipse{100.0, 1.0}, 2); }), "contour: 2 radii; expected 3 to 64");
}

TEST(PolarContour, LiesUndistortedOnTheTangentPlane) {
  const PolarContour contour = raggedContour(12, 4);
  for (const Vec3& normal : {Vec3(0, 0, 2), Vec3(0.3, -0.2, 0.9), Vec3(1, 0, 0), Vec3(0.1, 0.2, -1)}) {
    const SurfaceContour lifted = contourOnSurface(contour, normal);
    EXPECT_NEAR(lifted.axis_x.norm(), 1.0, 1e-12);
    EXPECT_NEAR(lifted.axis_y.norm(), 1.0, 1e-12);
    EXPECT_NEAR(lifted.axis_x.dot(lifted.axis_y), 0.0, 1e-12);
    EXPECT_NEAR(lifted.axis_x.dot(normal), 0.0, 1e-12);
    const Vec3 offset = 30.0 * lifted.axis_x - 40.0 * lifted.axis_y;
    EXPECT_NEAR(locationRatio(lifted, offset), locationRatio(contour, Vec2(30, -40)), 1e-12);
  }
}

TEST(PolarContour, OnLevelSkinTheMapAxesAreKeptFromEitherSide) {
  for (const double z : {1.0, -1.0}) {
    const SurfaceContour lifted = contourOnSurface(raggedContour(5, 1), Vec3(0, 0, z));
    EXPECT_LT((lifted.axis_x - Vec3::UnitX()).norm(), 1e-12);
    EXPECT_LT((lifted.axis_y - Vec3::UnitY()).norm(), 1e-12);
  }
}

TEST(PolarContour, NoNormalGivesAnEmptyContour) {
  EXPECT_EQ(contourOnSurface(raggedContour(5, 1), Vec3::Zero()).contour.count, 0u);
  EXPECT_EQ(contourOnSurface(raggedContour(5, 1), Vec3(NAN, 0, 1)).contour.count, 0u);
}

}  // namespace palpate::maps

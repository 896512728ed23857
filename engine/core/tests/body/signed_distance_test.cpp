// Distances and curves against closed forms.
#include "palpate/body/signed_distance.h"

#include <gtest/gtest.h>

#include <numbers>

#include "palpate/body/cubic_spline.h"

namespace palpate::body {
namespace {

TEST(SignedDistance, CapsuleIsExact) {
  const Capsule capsule{{0, 0, 0}, {0, 10, 0}, 2.0, 2.0};
  EXPECT_DOUBLE_EQ(capsule.distance({5, 5, 0}), 3.0);
  EXPECT_DOUBLE_EQ(capsule.distance({0, 15, 0}), 3.0);
  EXPECT_DOUBLE_EQ(capsule.distance({0, 5, 0}), -2.0);
}

TEST(SignedDistance, EllipsesAreZeroOnTheirSurfaceAndExactOnTheirAxes) {
  for (double angle = 0.0; angle < 6.0; angle += 0.7) {
    EXPECT_NEAR(ellipseDistance(7 * std::cos(angle), 2 * std::sin(angle), 7, 2), 0.0, 1e-12);
    EXPECT_NEAR(ellipsoidDistance({7 * std::cos(angle), 0, 2 * std::sin(angle)}, {7, 3, 2}), 0.0, 1e-12);
  }
  EXPECT_DOUBLE_EQ(ellipseDistance(10, 0, 7, 2), 3.0);
  EXPECT_DOUBLE_EQ(ellipseDistance(0, 5, 7, 2), 3.0);
  EXPECT_DOUBLE_EQ(ellipseDistance(0, 0, 7, 2), -2.0);
}

TEST(SignedDistance, PlateHasAStadiumSection) {
  const PlateCapsule plate({0, 0, 0}, {0, 20, 0}, Vec3::UnitX(), {5.0, 1.0});
  EXPECT_DOUBLE_EQ(plate.distance({0, 10, 3}), 2.0);
  EXPECT_DOUBLE_EQ(plate.distance({7, 10, 0}), 2.0);
  EXPECT_DOUBLE_EQ(plate.distance({4, 10, 1}), 0.0);
}

TEST(SignedDistance, SuperellipseIsACircleForExponentTwo) {
  EXPECT_NEAR(superellipseDistance(3, 4, 2, 2, 2.0), 3.0, 1e-12);
  EXPECT_NEAR(superellipseDistance(2, 0, 2, 5, 2.4), 0.0, 1e-12);
}

TEST(SignedDistance, SmoothUnionFillsASeamByAQuarterOfItsWidth) {
  EXPECT_DOUBLE_EQ(smoothUnion(0.0, 0.0, 2.0), -0.5);
  EXPECT_DOUBLE_EQ(smoothUnion(0.0, 3.0, 2.0), 0.0);
  EXPECT_DOUBLE_EQ(smoothDifference(-5.0, -1.0, 2.0), 1.0);
}

TEST(CubicSpline, PassesThroughItsPoints) {
  const std::vector<Vec3> points = {{0, 0, 0}, {3, 1, 0}, {5, 5, 2}, {9, 4, -1}};
  const CubicSpline spline(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR((spline.at(spline.knot(i)) - points[i]).norm(), 0.0, 1e-12);
}

TEST(CubicSpline, ClosedThroughACircleIsNearlyACircleAndEvenlySpaced) {
  std::vector<Vec3> points;
  for (int i = 0; i < 12; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 12;
    points.emplace_back(10 * std::cos(angle), 10 * std::sin(angle), 0);
  }
  const auto even = CubicSpline(points, CubicSpline::Ends::closed).evenly(50);
  ASSERT_EQ(even.size(), 50u);
  const double step = 2.0 * std::numbers::pi * 10.0 / 50;
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_NEAR(even[i].norm(), 10.0, 0.01);
    EXPECT_NEAR((even[(i + 1) % 50] - even[i]).norm(), step, 0.01);
  }
}

}  // namespace
}  // namespace palpate::body

#include "palpate/maps/ellipse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/golden.h"

namespace palpate::maps {

using test::goldenRows;
using test::vec3;

/// Angle between two undirected axes, in degree.
double axisDifference(double a_deg, double b_deg) {
  const double folded = std::fmod(std::abs(a_deg - b_deg), 180.0);
  return std::min(folded, 180.0 - folded);
}

TEST(Ellipse, LocationRatioIsThatOfTheTrueEllipse) {
  for (const auto& c : goldenRows("ellipse_q", "cases")) {
    const SurfaceEllipse ellipse{vec3(c["OA"]), c["aspect_minor_over_major"]};
    const double q = locationRatio(ellipse, vec3(c["OD"]));
    EXPECT_NEAR(q, c["q_ellipse"], 1e-12 * std::max(1.0, q)) << c;
  }
}

TEST(Ellipse, TwoDimensionalRatioAgreesWithTheOneOnTheSurface) {
  const Ellipse flat{120.0, 0.6, 0.7};
  const SurfaceEllipse lifted = liftedOntoSurface(flat, Vec3::UnitZ());
  EXPECT_DOUBLE_EQ(locationRatio(flat, Vec2(30, -50)), locationRatio(lifted, Vec3(30, -50, 0)));
}

TEST(Ellipse, CentreIsZeroAndAnEmptyEllipseHoldsNothingElse) {
  EXPECT_EQ(locationRatio(Ellipse{100.0, 0.5, 0.3}, Vec2(0, 0)), 0.0);
  EXPECT_EQ(locationRatio(Ellipse{}, Vec2(0, 0)), 0.0);
  EXPECT_EQ(locationRatio(Ellipse{}, Vec2(1e-9, 0)), std::numeric_limits<double>::infinity());
}

TEST(Ellipse, FullAxesInCentimetreBecomeCanonical) {
  for (const auto& c : goldenRows("ellipse_normalise", "cases")) {
    const Ellipse e = ellipseFromFullAxesCm(c["in_major_cm"], c["in_minor_cm"], c["in_deg"]);
    EXPECT_NEAR(e.half_major_mm, c["half_major_mm"], 1e-12) << c;
    EXPECT_NEAR(e.aspect, c["aspect"], 1e-12) << c;
    EXPECT_NEAR(axisDifference(e.direction_rad / kRadPerDeg, c["deg"]), 0.0, 1e-9) << c;
    EXPECT_GE(e.direction_rad, 0.0);
    EXPECT_LT(e.direction_rad, std::numbers::pi);
  }
}

// The measured ratio is major/minor; taken as minor/major it would stretch the ellipse across itself.
TEST(Ellipse, RatioAboveOneIsNotMistakenForTheAspect) {
  for (const auto& c : goldenRows("ellipse_normalise", "misuse")) {
    const double half_major = c["half_major"];
    const Ellipse e = canonicalEllipse(half_major, half_major / c["ratio"].get<double>(), 0.0);
    EXPECT_NEAR(locationRatio(e, Vec2(c["OD"][0], c["OD"][1])), c["q_correct"], 1e-12) << c;
  }
}

TEST(Ellipse, LogTensorComesBack) {
  for (const double degree : {0.0, 1e-9, 30.0, 90.0, 121.0, 179.999}) {
    const Ellipse e{130.0, 0.73, degree * kRadPerDeg};
    const Ellipse back = ellipseOf(logTensor(e));
    EXPECT_NEAR(back.half_major_mm, 130.0, 1e-10);
    EXPECT_NEAR(back.aspect, 0.73, 1e-13);
    EXPECT_NEAR(axisDifference(back.direction_rad / kRadPerDeg, degree), 0.0, 1e-9);
  }
}

TEST(Ellipse, CircleHasNoDirectionAndSaysSo) {
  const Ellipse circle = ellipseOf(logTensor({90.0, 1.0, 0.3}));
  EXPECT_NEAR(circle.half_major_mm, 90.0, 1e-12);
  EXPECT_EQ(circle.aspect, 1.0);
  EXPECT_DOUBLE_EQ(circle.direction_rad, std::numbers::pi / 2);
}

TEST(Projection, FootOfThePointLiesOnThePlane) {
  for (const auto& c : goldenRows("projection", "cases")) {
    const Vec3 foot = projectedOnPlane(vec3(c["J"]), vec3(c["O"]), vec3(c["N"]));
    EXPECT_LT((foot - vec3(c["D"])).norm(), 1e-12) << c;
    EXPECT_NEAR((foot - vec3(c["O"])).dot(vec3(c["N"])), 0.0, 1e-12);
  }
}

TEST(Lift, KeepsDirectionSeenAlongZAndRestoresLength) {
  for (const auto& c : goldenRows("ellipse_lift", "cases")) {
    const auto& expected = c["recommended_same_direction_length_R"];
    if (expected.is_null()) continue;
    const Ellipse flat{c["half_major"], 0.8, c["deg"].get<double>() * kRadPerDeg};
    const SurfaceEllipse lifted = liftedOntoSurface(flat, vec3(c["normal"]));
    EXPECT_LT((lifted.half_major - vec3(expected)).norm(), 1e-9) << c;
    EXPECT_EQ(lifted.aspect, 0.8);
  }
}

TEST(Lift, VerticalSurfaceGetsAnAxisOfFullLengthInItsPlane) {
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.6, 0.8, 0)}) {
    for (const double degree : {0.0, 30.0, 53.130102354155978, 90.0}) {
      const SurfaceEllipse lifted = liftedOntoSurface({100.0, 0.5, degree * kRadPerDeg}, normal);
      EXPECT_NEAR(lifted.half_major.norm(), 100.0, 1e-9) << degree;
      EXPECT_NEAR(lifted.half_major.dot(normal), 0.0, 1e-9) << degree;
    }
  }
}

TEST(Lift, NoNormalGivesAnEmptyEllipse) {
  EXPECT_TRUE(liftedOntoSurface({100.0, 0.5, 0.0}, Vec3::Zero()).half_major.isZero());
  EXPECT_TRUE(liftedOntoSurface({100.0, 0.5, 0.0}, Vec3(NAN, 0, 1)).half_major.isZero());
}

}  // namespace palpate::maps

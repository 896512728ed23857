#include "palpate/maps/contour_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "palpate/base/random.h"
#include "support/error_message.h"
#include "support/expect_each.h"

namespace palpate::maps {

using support::thrownMessage;

std::vector<ContourPoint> raggedPoints(std::size_t number, std::size_t radii) {
  Random random(number);
  std::vector<ContourPoint> points;
  for (std::size_t i = 0; i < number; ++i) {
    std::vector<double> radii_mm;
    for (std::size_t r = 0; r < radii; ++r) radii_mm.push_back(random.uniform(50.0, 150.0));
    points.push_back({"K", {random.uniform(-200, 200), random.uniform(-200, 200)}, contourOf(radii_mm)});
  }
  return points;
}

TEST(ContourMap, PointsKeepTheirOwnContour) {
  const auto points = raggedPoints(7, 12);
  const PolarContourMap map(points);
  for (const ContourPoint& point : points) {
    const PolarContour here = map.at(point.position_mm.x(), point.position_mm.y());
    ASSERT_EQ(here.count, 12u);
    for (std::size_t i = 0; i < 12; ++i) EXPECT_DOUBLE_EQ(here.log_radii[i], point.contour.log_radii[i]);
  }
}

TEST(ContourMap, OutOfAllReachItIsTheBasicCircle) {
  for (const std::size_t number : {0u, 1u, 2u, 7u, 10000u}) {
    const PolarContour far = PolarContourMap(raggedPoints(number, 8), {200.0, 80.0}).at(1e5, 0.0);
    EXPECT_EQ(far.count, number == 0 ? kMaxContourRadii : 8u);
    for (std::size_t i = 0; i < far.count; ++i) EXPECT_NEAR(std::exp(far.log_radii[i]), 80.0, 1e-11);
  }
}

TEST(ContourMap, StaysWithinWhatWasMeasured) {
  for (const std::size_t number : {1u, 2u, 7u, 10000u}) {
    const PolarContourMap map(raggedPoints(number, 5), {200.0, 100.0});
    for (const Vec2& place : {Vec2(0, 0), Vec2(100, -50), Vec2(-190, 190)}) {
      const PolarContour here = map.at(place.x(), place.y());
      for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_GE(std::exp(here.log_radii[i]), 50.0 - 1e-9);
        EXPECT_LE(std::exp(here.log_radii[i]), 150.0 + 1e-9);
      }
    }
  }
}

TEST(ContourMap, CoincidentPointsAreAveraged) {
  std::vector<ContourPoint> points{{"A", {3, 4}, contourOf(std::vector<double>(4, 50.0))},
                                   {"B", {3, 4}, contourOf(std::vector<double>(4, 200.0))}};
  EXPECT_NEAR(radiusAt(PolarContourMap(points).at(3, 4), 0.0), 100.0, 1e-9);  // of the logarithms
}

TEST(ContourMap, LeftAndRightAreMirrored) {
  const PolarContourMap map(contourPointsOf(dissertationKeyPoints()));
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const double x = random.uniform(-200, 200);
    const double y = random.uniform(-300, 300);
    const double angle = random.uniform(0, 6);
    EXPECT_NEAR(radiusAt(map.at(x, y), angle), radiusAt(map.at(-x, y), std::numbers::pi - angle), 1e-9);
  }
}

// Each direction is blended on its own, so contours of ellipses need not make the ellipse of the ellipse map: their
// difference is what two ways of averaging the same data differ by.
TEST(ContourMap, ContoursOfEllipsesGiveNearlyTheEllipseMap) {
  const PolarContourMap contours(contourPointsOf(dissertationKeyPoints()));
  const EllipseMap ellipses(dissertationKeyPoints());
  double worst = 0.0;
  for (double x = -200; x <= 200; x += 25) {
    for (double y = -300; y <= 300; y += 25) {
      for (double angle = 0.0; angle < 3.0; angle += 0.3) {
        const Vec2 offset(std::cos(angle), std::sin(angle));
        const double q = locationRatio(ellipses.at(x, y), offset);
        worst = std::max(worst, std::abs(locationRatio(contours.at(x, y), offset) / q - 1.0));
      }
    }
  }
  EXPECT_LT(worst, 0.02);
}

TEST(ContourMap, RefusesWhatDoesNotFit) {
  auto points = raggedPoints(2, 8);
  points[1].contour = contourOf(std::vector<double>(9, 50.0));
  EXPECT_EQ(thrownMessage([&] { PolarContourMap{points}; }),
            "contour map: every contour needs the same number of radii");
  EXPECT_EQ(thrownMessage([] {
              PolarContourMap({}, {200.0, 0.0});
            }),
            "contour map: the basic radius must be above 0 mm");
}

TEST(ContourPoints, AreReadWithTheirPlaceAndRadii) {
  const auto points = parseContourPoints("name,x_mm,y_mm,r0_mm,r1_mm,r2_mm\nA,1,-2.5,30,40,50\nB,0,7,3,4,5\n", "t");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].name, "A");
  EXPECT_EQ(points[0].position_mm, Vec2(1, -2.5));
  ASSERT_EQ(points[0].contour.count, 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(std::exp(points[0].contour.log_radii[i]), 30.0 + 10.0 * i, 1e-12);
  EXPECT_EQ(points[1].position_mm, Vec2(0, 7));
}

TEST(ContourPoints, HeaderIsOptionalAndEmptyIsFine) {
  EXPECT_EQ(parseContourPoints("name,x_mm,y_mm,r0_mm,r1_mm,r2_mm\nA,1,2,3,4,5\n", "t").size(), 1u);
  EXPECT_EQ(parseContourPoints("# only a comment\nA,1,2,3,4,5\nB,1,2,3,4,5", "t").size(), 2u);
  EXPECT_TRUE(parseContourPoints("", "t").empty());
}

TEST(ContourPoints, MistakesAreNamedWithTheirLine) {
  const auto error = [](std::string_view text) { return thrownMessage([&] { parseContourPoints(text, "t.csv"); }); };
  support::expectEach(
      error,
      {{"A,1,2,3,4", "t.csv:1: expected name,x_mm,y_mm and 3 to 64 radii, found 5 fields"},
       {"A,1,2,3,4,5\nB,1,2,3,4,5,6", "t.csv:2: 4 radii, but the rows before it have 3"},
       {"A,1,2,3,x,5", "t.csv:1: r1_mm is not a number: 'x'"},
       {"A,1,2,3,4,-5", "t.csv:1: r2_mm = -5 is out of range: 0.001 to 10,000"},
       {"A,1,inf,3,4,5", "t.csv:1: y_mm must be finite, got inf"},
       {"name,x,y,a,b,c", "t.csv:1: expected the header name,x_mm,y_mm,r0_mm,r1_mm,r2_mm, found 'name,x,y,a,b,c'"}});
}

}  // namespace palpate::maps

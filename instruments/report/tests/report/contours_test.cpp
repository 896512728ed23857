// Contour lines lie where a known function has their level.
#include "report/charts/drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::figures {

namespace {

Field square(int cells, double half) {
  return {.origin = Vec2(-half, -half),
          .step = Vec2::Constant(2.0 * half / cells),
          .columns = cells + 1,
          .rows = cells + 1};
}

}  // namespace

TEST(Contours, OfADistanceAreClosedCircles) {
  Field field = square(60, 50.0);
  sampleField(field, [](double x, double y) { return std::hypot(x, y); });
  const auto lines = contourLines(field, 30.0);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  EXPECT_GT(lines[0].size(), 60u);
  for (const Vec2& point : lines[0]) EXPECT_NEAR(point.norm(), 30.0, 0.05);
}

TEST(Contours, OfASlopeRunFromBorderToBorder) {
  Field field = square(10, 5.0);
  sampleField(field, [](double x, double) { return x; });
  const auto lines = contourLines(field, 1.25);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].size(), 11u);
  for (const Vec2& point : lines[0]) EXPECT_DOUBLE_EQ(point.x(), 1.25);
}

TEST(Contours, DoNotReachLevelsThatDoNotOccur) {
  Field field = square(10, 5.0);
  sampleField(field, [](double x, double y) { return x + y; });
  EXPECT_TRUE(contourLines(field, 11.0).empty());
  EXPECT_TRUE(contourLines(field, -11.0).empty());
}

TEST(Contours, OfASaddleAreTwoLinesThatDoNotCross) {
  Field field = square(1, 1.0);
  field.values = {1.0, 0.0, 0.0, 1.0};  // high below left and above right
  EXPECT_EQ(contourLines(field, 0.4).size(), 2u);
  EXPECT_EQ(contourLines(field, 0.6).size(), 2u);
  // Below the mean the low corners are cut off, above it the high ones.
  for (const auto& line : contourLines(field, 0.4)) EXPECT_GT((0.5 * (line[0] + line[1])).norm(), 0.5);
}

TEST(Contours, StopAtTheOutside) {
  Field field = square(20, 10.0);
  sampleField(field, [](double x, double y) { return x > 4.0 ? std::numeric_limits<double>::quiet_NaN() : y; });
  const auto lines = contourLines(field, 0.5);
  ASSERT_EQ(lines.size(), 1u);
  const auto [first, last] = std::ranges::minmax(lines[0], {}, [](const Vec2& point) { return point.x(); });
  EXPECT_DOUBLE_EQ(first.x(), -10.0);
  EXPECT_DOUBLE_EQ(last.x(), 4.0) << "as far as the values go, and no farther";
}

}  // namespace palpate::figures

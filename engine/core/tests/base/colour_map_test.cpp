#include "palpate/base/colour_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace palpate {

/// Relative luminance of an sRGB colour (ITU-R BT.709).
double luminance(const Colour& c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
}

double difference(const Colour& a, const Colour& b) {
  return std::hypot(a.red - b.red, a.green - b.green, a.blue - b.blue);
}

TEST(ColourMap, PublishedEndsAndMiddles) {
  EXPECT_EQ(bytesOf(colourOf(ColourMap::viridis, 0.0)), (ColourBytes{68, 1, 84}));
  EXPECT_EQ(bytesOf(colourOf(ColourMap::viridis, 1.0)), (ColourBytes{253, 231, 37}));
  EXPECT_EQ(bytesOf(colourOf(ColourMap::cividis, 0.0)), (ColourBytes{0, 32, 77}));
  EXPECT_EQ(bytesOf(colourOf(ColourMap::cividis, 1.0)), (ColourBytes{255, 234, 70}));
}

// The table that Moreland printed for 33 steps; its own rounding is one level.
TEST(ColourMap, CoolWarmFollowsThePrintedTable) {
  struct Row {
    double value;
    ColourBytes printed;
  };
  for (const Row& row : {Row{0.0, {59, 76, 192}}, Row{0.25, {141, 176, 254}}, Row{0.5, {221, 221, 221}},
                         Row{0.75, {244, 154, 123}}, Row{1.0, {180, 4, 38}}}) {
    const ColourBytes ours = bytesOf(colourOf(ColourMap::cool_warm, row.value));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(ours[c], row.printed[c], 2) << row.value << " " << c;
  }
}

TEST(ColourMap, SequentialMapsGrowBrighterAllTheWay) {
  for (const ColourMap map : {ColourMap::viridis, ColourMap::cividis}) {
    for (int i = 1; i <= 100; ++i) {
      EXPECT_GT(luminance(colourOf(map, i / 100.0)), luminance(colourOf(map, (i - 1) / 100.0))) << i;
    }
  }
}

TEST(ColourMap, DivergingMapIsBrightestInTheMiddle) {
  for (int i = 1; i <= 50; ++i) {
    EXPECT_LT(luminance(colourOf(ColourMap::cool_warm, 0.5 + i / 100.0)),
              luminance(colourOf(ColourMap::cool_warm, 0.5 + (i - 1) / 100.0)));
    EXPECT_LT(luminance(colourOf(ColourMap::cool_warm, 0.5 - i / 100.0)),
              luminance(colourOf(ColourMap::cool_warm, 0.5 - (i - 1) / 100.0)));
  }
}

TEST(ColourMap, CyclicMapClosesAndKeepsItsBrightness) {
  EXPECT_LT(difference(colourOf(ColourMap::cyclic, 0.0), colourOf(ColourMap::cyclic, 1.0)), 1e-12);
  EXPECT_LT(difference(colourOf(ColourMap::cyclic, 0.3), colourOf(ColourMap::cyclic, -1.7)), 1e-9);
  for (int i = 0; i < 100; ++i) EXPECT_NEAR(luminance(colourOf(ColourMap::cyclic, i / 100.0)), 0.42, 0.06) << i;
}

TEST(ColourMap, HasNoJumps) {
  for (const ColourMap map : {ColourMap::viridis, ColourMap::cividis, ColourMap::cool_warm, ColourMap::cyclic}) {
    for (int i = 0; i < 1000; ++i) {
      EXPECT_LT(difference(colourOf(map, i / 1000.0), colourOf(map, (i + 1) / 1000.0)), 0.01) << i;
    }
  }
}

TEST(ColourMap, OutsideIsClampedAndNoValueIsGrey) {
  EXPECT_LT(difference(colourOf(ColourMap::viridis, -5.0), colourOf(ColourMap::viridis, 0.0)), 1e-12);
  EXPECT_LT(difference(colourOf(ColourMap::cool_warm, 1e300), colourOf(ColourMap::cool_warm, 1.0)), 1e-12);
  for (const ColourMap map : {ColourMap::viridis, ColourMap::cividis, ColourMap::cool_warm, ColourMap::cyclic}) {
    EXPECT_EQ(difference(colourOf(map, std::numeric_limits<double>::quiet_NaN()), kNoColour), 0.0);
  }
  EXPECT_EQ(difference(colourOf(ColourMap::cyclic, std::numeric_limits<double>::infinity()), kNoColour), 0.0);
}

}  // namespace palpate

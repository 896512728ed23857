#include "palpate/view/overlays/legend.h"

#include <gtest/gtest.h>

#include "palpate/view/offscreen.h"

namespace palpate::view {
namespace {

TEST(RoundSteps, AreOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(roundStepUp(0.3), 0.5);
  EXPECT_DOUBLE_EQ(roundStepUp(20.0), 20.0);
  EXPECT_DOUBLE_EQ(roundStepUp(51.0), 100.0);
  EXPECT_DOUBLE_EQ(roundStepDown(49.0), 20.0);
  EXPECT_DOUBLE_EQ(roundStepDown(0.1), 0.1);
}

TEST(RoundMarks, LieWithinTheRange) {
  EXPECT_EQ(roundMarks(-20.0, 20.0, 5), (std::vector<double>{-20.0, -10.0, 0.0, 10.0, 20.0}));
  EXPECT_EQ(roundMarks(0.3, 1.2, 5), (std::vector<double>{0.4, 0.6000000000000001, 0.8, 1.0, 1.2000000000000002}));
  EXPECT_EQ(roundMarks(100.0, 200.0, 5), (std::vector<double>{100.0, 150.0, 200.0}));
  EXPECT_EQ(roundMarks(3.0, 3.0, 5), (std::vector<double>{3.0}));
}

TEST(MarkText, HasTheDecimalsOfTheStep) {
  EXPECT_EQ(markText(-10.0, 10.0), "\u221210");
  EXPECT_EQ(markText(0.6000000000000001, 0.2), "0.6");
  EXPECT_EQ(markText(-1e-17, 0.5), "0.0");
}

TEST(Legend, ShowsEachValueInTheColourOfTheSkin) {
  const OffscreenContext context;
  const Target target(120, 240);
  Drawing page;
  page.begin({120.0f, 240.0f}, 1.0);
  Look look;
  look.colouring = Colouring::strain;
  const LegendPlace place{{40.0f, 40.0f}, {16.0f, 160.0f}};
  const Legend legend{"strain", "%", "", "", look.range(), ColourMap::cool_warm, {}};
  drawLegend(page, legend, place, inksFor(look));
  page.end();
  target.bind();
  page.present(120, 240);
  const Image image = target.read();
  for (const double value : {-19.0, -7.0, 0.0, 12.5, 19.9}) {
    const int y = static_cast<int>(40.0 + 160.0 * (1.0 - heightOnBar(legend, value)));
    const ColourBytes expected = bytesOf(colourOf(ColourMap::cool_warm, rangeFraction(look.range(), value)));
    for (std::size_t channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(image.at(48, y)[channel], expected[channel], 2) << value;
    }
  }
}

TEST(Legend, HoldsValuesBeyondItsEnds) {
  const Legend legend{"strain", "%", "", "", {-20.0, 20.0}, ColourMap::cool_warm, {}};
  EXPECT_EQ(heightOnBar(legend, 35.0), 1.0);
  EXPECT_EQ(heightOnBar(legend, -35.0), 0.0);
}

}  // namespace
}  // namespace palpate::view

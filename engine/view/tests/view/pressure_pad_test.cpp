// The pressure under a fingertip as it is drawn.
#include "palpate/view/overlays/pressure_pad.h"

#include <gtest/gtest.h>

#include <numeric>

#include "palpate/view/overlays/overlays.h"
#include "view/tests/view/lump_world.h"

namespace palpate::view {
namespace {

double lightness(const ColourBytes& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

TEST(PressurePad, GrowsLighterFromNothingToTheTopOfItsScale) {
  for (int i = 1; i <= 50; ++i) EXPECT_GT(lightness(heatColour(i / 50.0)), lightness(heatColour((i - 1) / 50.0))) << i;
  EXPECT_EQ(heatColour(-1.0), heatColour(0.0));
  EXPECT_EQ(heatColour(2.0), heatColour(1.0));
}

TEST(PressurePad, HasARoundScaleThatALightTouchDoesNotFill) {
  PadReading light, firm;
  light.greatest_kpa = 1.2;
  firm.greatest_kpa = 33.0;
  EXPECT_EQ(padScaleTop({}), 5.0);
  EXPECT_EQ(padScaleTop(std::array{light}), 5.0);
  EXPECT_EQ(padScaleTop(std::array{light, firm}), 50.0) << "one scale for all fingers";
}

TEST(PressurePad, AddsUpToTheForceOfTheFinger) {
  const auto world = lumpyTorso();
  const FingerMark finger = fingertipAt(*world, kLumpX, kLumpY, 5.0);
  const PadReader reader(*world);
  EXPECT_EQ(reader.missing(), "");
  const auto readings = reader.read({&finger, 1}, 0.0);
  ASSERT_EQ(readings.size(), 1u);
  const PadReading& reading = readings.front();
  ASSERT_EQ(reading.kpa.size(), 16u) << "four along a side where the scene says nothing";
  const double taxel_mm2 = 16.0;
  const double force_n = std::accumulate(reading.kpa.begin(), reading.kpa.end(), 0.0) * taxel_mm2 / 1000.0;
  EXPECT_NEAR(force_n, finger.contact.force.dot(finger.contact.normal), 1e-6);
  EXPECT_EQ(reading.greatest_kpa, *std::max_element(reading.kpa.begin(), reading.kpa.end()));
}

TEST(PressurePad, RisesOverALump) {
  const auto lumpy = lumpyTorso();
  const auto plain = lumpyTorso({});
  const FingerMark over = fingertipAt(*lumpy, kLumpX, kLumpY, 5.0);
  const FingerMark without = fingertipAt(*plain, kLumpX, kLumpY, 5.0);
  const double peak = PadReader(*lumpy).read({&over, 1}, 0.0).front().greatest_kpa;
  EXPECT_GT(peak, 1.2 * PadReader(*plain).read({&without, 1}, 0.0).front().greatest_kpa);
}

TEST(PressurePad, TakesTheFormOfTheScenesFinger) {
  scene::Scene scene;
  scene.fingers.resize(2);
  scene.fingers[1].pad = 8;
  scene.fingers[1].pad_mm = 12.0;
  EXPECT_EQ(fingerPad(scene, 0).taxels, 4u);
  EXPECT_EQ(fingerPad(scene, 1).taxels, 8u);
  EXPECT_EQ(fingerPad(scene, 1).size_mm, 12.0);
  EXPECT_EQ(fingerPad(scene, 7).taxels, 4u);
}

TEST(PressurePad, LiesOnTheSkinUnderTheFingerAndNowhereElse) {
  const auto world = lumpyTorso();
  const FingerMark finger = fingertipAt(*world, kLumpX, kLumpY, 5.0);
  DrawnSkin skin;
  skin.copyAll(deformedBy(*world, {&finger, 1}));
  Look look;
  look.show(Overlay::pressure);
  Overlays overlays(*world);
  const auto& patches = overlays.shapes(look, skin, {&finger, 1}).seen_through.points;
  ASSERT_FALSE(patches.empty());
  EXPECT_EQ(patches.size() % 6, 0u) << "whole taxels";
  for (const PaintedPoint& point : patches) {
    const Vec3 away = point.place.cast<double>() - finger.contact.proxy;
    EXPECT_LT(std::abs(away.x()), 10.0);
    EXPECT_LT(std::abs(away.y()), 10.0);
  }
  FingerMark lifted;
  lifted.contact.tip = finger.contact.tip + Vec3(0.0, 0.0, 50.0);
  EXPECT_TRUE(overlays.shapes(look, skin, {&lifted, 1}).seen_through.points.empty());
}

TEST(PressurePad, SaysWhereItIsNotKnown) {
  const auto world = flatWorld();
  const PadReader reader(*world);
  EXPECT_NE(reader.missing(), "");
  const FingerMark finger = pressedFinger(*world, {50.0, 50.0, 0.0}, 6.0);
  EXPECT_TRUE(reader.read({&finger, 1}, 0.0).empty());
}

}  // namespace
}  // namespace palpate::view

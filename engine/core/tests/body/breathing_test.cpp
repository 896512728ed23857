// Breathing: which places of a trunk move, how far, when, and back again.
#include "palpate/body/trunk/breathing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace palpate::body {
namespace {

/// A spine upright at the back, 100 mm behind the front's 0.
std::vector<SkinLandmark> spine() {
  std::vector<SkinLandmark> landmarks;
  const std::vector<std::pair<const char*, double>> levels = {
      {"L5", -350.0}, {"T12", -150.0}, {"T10", -100.0}, {"T8", -50.0}, {"T2", 100.0}};
  for (const auto& [level, y] : levels) {
    landmarks.push_back({std::string("spinous_") + level, level, Vec3(0, y, 100), Vec3::UnitZ(), Vec3(0, y, 92)});
  }
  return landmarks;
}

BreathField makeBreathField(const std::optional<Support>& support = {}) {
  return *BreathField::of({.on = true, .depth_mm = 2.0, .per_minute = 15.0}, spine(), support, 0.0);
}

TEST(Breathing, GoesInAndOutByItsDepthAndRate) {
  const BreathField breath = makeBreathField();
  EXPECT_EQ(breath.lift(0.0), 0.0);
  EXPECT_NEAR(breath.lift(2.0), 2.0, 1e-12) << "breathed in: half of 60 s / 15";
  EXPECT_NEAR(breath.lift(4.0), 0.0, 1e-12);
  EXPECT_NEAR(breath.lift(1.0), 1.0, 1e-12);
  for (double s = 0.0; s < 20.0; s += 0.05) {
    EXPECT_LT(std::abs(breath.lift(s + 0.001) - breath.lift(s)), 0.0016) << "smooth: 2 mm * pi / 4 s, at most";
  }
}

TEST(Breathing, MovesTheBackOverTheLowerRibsAndLeavesThePelvis) {
  const BreathField breath = makeBreathField();
  EXPECT_DOUBLE_EQ(breath.share({0, -100, 100}), 1.0);
  EXPECT_DOUBLE_EQ(breath.share({80, -100, 100}), 1.0);
  EXPECT_EQ(breath.share({0, -400, 100}), 0.0);
  const double shoulders = breath.share({150, 120, 100});
  EXPECT_GT(shoulders, 0.1);
  EXPECT_LT(shoulders, 0.5);
}

TEST(Breathing, WidensAStandingBodyToBothSides) {
  const BreathField breath = makeBreathField();
  EXPECT_DOUBLE_EQ(breath.share({0, -100, 0}), -1.0);
  EXPECT_EQ(breath.share({0, -100, 50}), 0.0);
}

TEST(Breathing, LeavesTheFrontOfALyingBodyOnItsTable) {
  const BreathField breath = makeBreathField(Support{{0, 0, 0}, Vec3::UnitZ()});
  for (double y = -400; y < 200; y += 20) EXPECT_EQ(breath.share({30, y, 0}), 0.0);
  EXPECT_DOUBLE_EQ(breath.share({0, -100, 100}), 1.0);
}

TEST(Breathing, FindsTheRestOfAMovedPlaceAgain) {
  const BreathField breath = makeBreathField();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-500.0, 500.0);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 rest(anywhere(random), anywhere(random), 0.4 * anywhere(random));
    EXPECT_LT((breath.rest(breath.moved(rest, 2.0), 2.0) - rest).norm(), 2e-4) << rest.transpose();
  }
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(breath.rest({0, 0, infinite}, 2.0).z(), infinite);
  EXPECT_TRUE(std::isnan(breath.rest(Vec3::Constant(std::nan("")), 2.0).x()));
}

TEST(Breathing, NeedsASpineAndToBeAskedFor) {
  EXPECT_FALSE(BreathField::of({.on = false}, spine(), {}, 0.0));
  EXPECT_FALSE(BreathField::of({.on = true}, {}, {}, 0.0));
  std::vector<SkinLandmark> upside_down = spine();
  for (SkinLandmark& landmark : upside_down) landmark.position.y() *= -1.0;
  EXPECT_FALSE(BreathField::of({.on = true}, upside_down, {}, 0.0));
}

}  // namespace
}  // namespace palpate::body

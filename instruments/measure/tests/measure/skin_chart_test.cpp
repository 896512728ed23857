#include "palpate/measure/skin_chart.h"

#include <gtest/gtest.h>

#include "measure/tests/measure/drawn_dots.h"
#include "palpate/base/error.h"

namespace palpate::measure {
namespace {

SkinChart chartOf(const DrawnSheet& sheet, HeadTowards head = HeadTowards::top) {
  return {growGrid(drawnDots(sheet, atRest).before), sheet.spacing_mm, head};
}

TEST(SkinChart, MeasuresAlongTheSkinHoweverTheCameraIsTilted) {
  for (const double tilt : {0.0, 15.0, 30.0}) {
    const DrawnSheet sheet{.tilt_deg = tilt};
    const SkinChart chart = chartOf(sheet);
    for (const Vec2& place : {Vec2(3.0, -40.0), Vec2(-70.0, 90.0), Vec2(101.0, -120.0)}) {
      const Vec2 motion(7.0, 12.0);
      const Vec2 measured = chart.skinAt(seen(sheet, place + motion)) - chart.skinAt(seen(sheet, place));
      EXPECT_LT((measured - motion).norm(), 0.02 * motion.norm()) << tilt << " " << place.transpose();
    }
  }
}

TEST(SkinChart, FindsThePictureOfAPlaceAgain) {
  const DrawnSheet sheet{.tilt_deg = 25.0, .roll_deg = -8.0};
  const SkinChart chart = chartOf(sheet);
  for (const Vec2& place_px : {Vec2(800.0, 1000.0), Vec2(500.0, 1300.0), Vec2(1100.0, 700.0)})
    EXPECT_LT((chart.pictureAt(chart.skinAt(place_px)) - place_px).norm(), 1e-4);
}

TEST(SkinChart, ItsSlopeIsWhatDifferencesSay) {
  const SkinChart chart = chartOf({.tilt_deg = 20.0});
  const Vec2 at(700.0, 900.0);
  const Mat2 slope = chart.jacobianAt(at);
  for (int axis = 0; axis < 2; ++axis) {
    const Vec2 step = 1e-3 * Vec2::Unit(axis);
    EXPECT_LT(((chart.skinAt(at + step) - chart.skinAt(at - step)) / 2e-3 - slope.col(axis)).norm(), 1e-6);
  }
}

TEST(SkinChart, TurnsSoThatTheHeadIsUp) {
  const Vec2 from(800.0, 1000.0);
  const auto moved = [&](HeadTowards head, const Vec2& by_px) {
    const SkinChart chart = chartOf({}, head);
    return Vec2(chart.skinAt(from + by_px) - chart.skinAt(from));
  };
  const double mm = 20.0 / 4.0;  // 20 px
  EXPECT_LT((moved(HeadTowards::top, {0.0, -20.0}) - Vec2(0.0, mm)).norm(), 0.1);
  EXPECT_LT((moved(HeadTowards::top, {20.0, 0.0}) - Vec2(mm, 0.0)).norm(), 0.1);
  EXPECT_LT((moved(HeadTowards::bottom, {0.0, 20.0}) - Vec2(0.0, mm)).norm(), 0.1);
  EXPECT_LT((moved(HeadTowards::left, {-20.0, 0.0}) - Vec2(0.0, mm)).norm(), 0.1);
  EXPECT_LT((moved(HeadTowards::left, {0.0, -20.0}) - Vec2(mm, 0.0)).norm(), 0.1);
  EXPECT_LT((moved(HeadTowards::right, {20.0, 0.0}) - Vec2(0.0, mm)).norm(), 0.1);
  EXPECT_LT((moved(HeadTowards::right, {0.0, 20.0}) - Vec2(mm, 0.0)).norm(), 0.1);
}

TEST(SkinChart, CoversWhatLiesAmongTheDotsOnly) {
  const DrawnSheet sheet;
  const SkinChart chart = chartOf(sheet);
  EXPECT_TRUE(chart.covers(chart.skinAt(seen(sheet, {0.0, 0.0}))));
  EXPECT_TRUE(chart.covers(chart.skinAt(seen(sheet, {130.0, 160.0}))));
  EXPECT_FALSE(chart.covers(chart.skinAt(seen(sheet, {140.0, 0.0}))));
  EXPECT_FALSE(chart.covers({1e30, 0.0}));
}

TEST(SkinChart, RefusesDotsInALine) {
  DotGrid line;
  line.spacing_px = 50.0;
  for (int i = 0; i < 12; ++i) line.dots.push_back({{i, 0}, {{50.0 * i, 100.0}, 9.0}});
  EXPECT_THROW(SkinChart(line, 30.0, HeadTowards::top), Error);
  line.dots.resize(4);
  EXPECT_THROW(SkinChart(line, 30.0, HeadTowards::top), Error);
}

}  // namespace
}  // namespace palpate::measure

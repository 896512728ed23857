// The observer of lumps against the table of cues that its prototype gave, and against what probabilities must do.
#include "palpate/lumps/lump_observer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "palpate/elements/stack_solver.h"
#include "palpate/lumps/lump_sheet.h"
#include "support/error_message.h"

namespace palpate::lumps {
namespace {

/// One soft tissue under skin, as silicone breasts have it; solved as deep as people press.
const LumpSheet& silicone() {
  static const LumpSheet sheet = [] {
    elements::StackSettings settings;
    settings.press.depths_mm = {2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0};
    settings.press.field_depths_mm = elements::fieldDepths(14.0);
    settings.drag.reset();
    return LumpSheet(
        elements::solveStack({.layers = {{"skin", 1.5, 100.0}, {"silicone", 40.0, 12.0}}}, settings).press.table);
  }();
  return sheet;
}

constexpr double kPressN = 3.1;

tissue::LumpShape ball(double diameter_mm, double young_kpa, double centre_mm) {
  const double half = 0.5 * diameter_mm;
  return {.half_axes_mm = {half, half, half}, .depth_mm = centre_mm - half, .young_kpa = young_kpa};
}

ComparedSkin::Press pressBeside(const ComparedSkin& skin, const Vec2& beside_mm) {
  return skin.press(LumpSheet::foot() + Vec3(beside_mm.x(), beside_mm.y(), 0.0), Vec3::UnitZ(), kPressN);
}

LumpCue cueBeside(const tissue::LumpShape& lump, const Vec2& beside_mm, std::size_t taxels) {
  const ComparedSkin skin = silicone().with(lump);
  return skin.cue(pressBeside(skin, beside_mm), taxels);
}

TEST(LumpObserver, FeelsTheForceOfFiniteElements) {
  // Percent of the force without the lump, a press of 12 mm over the middle, solved with the lump in the mesh.
  struct Row {
    double diameter_mm, young_kpa, centre_mm, percent;
  };
  for (const Row& row : {Row{5, 200, 8, 2.67}, Row{5, 200, 12, 1.59}, Row{10, 40, 8, 10.2}, Row{10, 200, 8, 22.9},
                         Row{10, 200, 12, 14.0}}) {
    const LumpCue cue = cueBeside(ball(row.diameter_mm, row.young_kpa, row.centre_mm), {0, 0}, 8);
    EXPECT_NEAR(100.0 * cue.force, row.percent, 0.16 * row.percent) << row.diameter_mm << " mm, " << row.centre_mm;
  }
  EXPECT_NEAR(silicone().depthAt(3.1), 12.0, 0.1);
}

TEST(LumpObserver, FeelsThePatternOfItsPrototypeAtTheSameForce) {
  // Percent, of the same press, as printed; lumps with their centre 8 and 12 mm deep.
  struct Row {
    double diameter_mm, young_kpa, force_8, force_12, pattern_8, pattern_12;
  };
  constexpr std::array kTable = {Row{3, 40, 0.29, 0.18, 1.9, 0.5},   Row{3, 200, 0.51, 0.32, 3.4, 1.0},
                                 Row{5, 40, 1.3, 0.8, 9.1, 2.6},     Row{5, 200, 2.5, 1.5, 17.0, 4.6},
                                 Row{10, 40, 11.0, 6.4, 80.0, 21.0}, Row{10, 200, 24.0, 12.0, 177.0, 41.0}};
  // Two digits are printed; the engine's taxels are means of an area and the prototype's were points. A pattern grows
  // with the force of its lump, which the prototype knew less well.
  const auto near = [](const LumpCue& cue, double force, double printed) {
    const double felt = 100.0 * cue.pattern * force / (100.0 * cue.force);
    return std::max(0.1, 0.08 * printed) > std::abs(felt - printed);
  };
  for (const Row& row : kTable) {
    const LumpCue medium = cueBeside(ball(row.diameter_mm, row.young_kpa, 8.0), {0, 0}, 8);
    const LumpCue deep = cueBeside(ball(row.diameter_mm, row.young_kpa, 12.0), {0, 0}, 8);
    EXPECT_TRUE(near(medium, row.force_8, row.pattern_8)) << row.diameter_mm << " mm: " << medium.pattern;
    EXPECT_TRUE(near(deep, row.force_12, row.pattern_12)) << row.diameter_mm << " mm: " << deep.pattern;
  }
}

TEST(LumpObserver, ATickTellsWhatASecondPressWithoutTheLumpsTells) {
  for (const double young_kpa : {120.0, 4.0}) {
    const ComparedSkin skin = silicone().with(ball(6.0, young_kpa, 7.0));
    for (const double beside : {0.0, 3.0, 9.0}) {
      const ComparedSkin::Press press = pressBeside(skin, {beside, 0.5 * beside});
      ASSERT_TRUE(press.reached);
      EXPECT_NEAR(press.without.force.z(), kPressN, 1e-3 * kPressN);
      const LumpCue both = skin.cue(press, 8);
      const LumpCue one = computeCue(press.with, skin.surface().lumps.get(), skin.ground(), 8);
      EXPECT_NEAR(one.force, both.force, 1e-9);
      EXPECT_NEAR(one.pattern, both.pattern, 1e-6);
      EXPECT_EQ(both.force > 0.0, young_kpa > 12.0);
      EXPECT_GT(both.pattern, std::abs(both.force));
    }
  }
}

TEST(LumpObserver, ASofterLumpIsFeltByAFallOfTheSameForm) {
  const LumpCue hard = cueBeside(ball(5.0, 24.0, 8.0), {0, 0}, 8);
  const LumpCue soft = cueBeside(ball(5.0, 6.0, 8.0), {0, 0}, 8);
  EXPECT_LT(soft.force, 0.0);
  EXPECT_NEAR(soft.pattern / -soft.force, hard.pattern / hard.force, 0.05 * hard.pattern / hard.force);
}

TEST(LumpObserver, FeelsNothingWhereThereIsNothing) {
  const ComparedSkin bare = silicone().with(std::nullopt);
  const LumpCue cue = bare.cue(pressBeside(bare, {0, 0}), 8);
  EXPECT_EQ(cue.force, 0.0);
  EXPECT_EQ(cue.pattern, 0.0);
  EXPECT_EQ(detectionProbability(computeClarity(cue, {}), {}), 0.0);
  const LumpCue air = computeCue(contact::FingerOutput{}, nullptr, bare.ground(), 8);
  EXPECT_EQ(computeClarity(air, {}), 0.0);
  // The bone is nearer than the force.
  EXPECT_FALSE(bare.press(LumpSheet::foot(), Vec3::UnitZ(), 1e4).reached);
}

TEST(LumpObserver, AStrokeTellsWhatPressesOnItsWayTellAndIsClearestNearTheLump) {
  const ComparedSkin skin = silicone().with(ball(5.0, 200.0, 8.0));
  const double depth_mm = silicone().depthAt(kPressN);
  const std::vector<LumpCue> cues = strokePast(skin, 3.0, depth_mm, 8);
  ASSERT_EQ(cues.size(), 17u);
  for (const std::size_t at : {0, 6, 8, 11}) {
    const LumpCue pressed = skin.cue(pressBeside(skin, {3.0, static_cast<double>(at) - 8.0}), 8);
    EXPECT_NEAR(cues[at].force, pressed.force, 0.01 * pressed.force) << at;
    EXPECT_NEAR(cues[at].pattern, pressed.pattern, 0.02 * pressed.pattern) << at;
  }
  EXPECT_NEAR(cues.front().force, cues.back().force, 1e-6);
  double clearest = 0.0;
  for (const LumpCue& cue : cues) clearest = std::max(clearest, computeClarity(cue, {}));
  EXPECT_EQ(maxClarity(cues, {}), clearest);
  EXPECT_GT(clearest, computeClarity(cues.front(), {}));
  EXPECT_GT(clearest, maxClarity(strokePast(skin, 8.0, depth_mm, 8), {}));
}

TEST(LumpObserver, WithoutTheFieldOnlyTheForceCounts) {
  const LumpCue cue = cueBeside(ball(5.0, 200.0, 8.0), {0, 0}, 8);
  EXPECT_NEAR(computeClarity(cue, {.field = false}), cue.force / 0.08, 1e-12);
  EXPECT_NEAR(computeClarity(cue, {.taxels = 0}), cue.force / 0.08, 1e-12);
  EXPECT_NEAR(computeClarity(cue, {}), std::hypot(cue.force / 0.08, cue.pattern / 0.036), 1e-12);
  EXPECT_EQ(cueBeside(ball(5.0, 200.0, 8.0), {0, 0}, 0).pattern, 0.0);
}

TEST(LumpObserver, FinerTaxelsTellASmallLumpBetter) {
  // Over the middle, where four taxels share a bump that one of sixteen has nearly for itself.
  double before = 0.0;
  for (const std::size_t taxels : {2, 4, 8, 16}) {
    const double pattern = cueBeside(ball(5.0, 200.0, 8.0), {0, 0}, taxels).pattern;
    EXPECT_GT(pattern, 1.1 * before) << taxels;
    before = pattern;
  }
}

TEST(LumpObserver, FindsHalfOfWhatIsAsClearAsItsThresholdAndNeverAll) {
  const LumpObserver later;
  EXPECT_NEAR(detectionProbability(1.0, later), 0.49, 1e-12);
  EXPECT_NEAR(detectionProbability(std::exp(later.spread), later), 0.98 * 0.841345, 1e-5);
  EXPECT_LE(detectionProbability(1e30, later), 0.98);
  EXPECT_NEAR(twoIntervals(0.0), 0.5, 1e-12);
  EXPECT_NEAR(twoIntervals(std::sqrt(2.0)), 0.841345, 1e-6);
}

TEST(LumpObserver, TraineesOfAGroupFindAsOftenAsItsFormulaAndAgreeWithThemselves) {
  const LumpObserver observer{.pattern_weber = 0.08, .spread = 1.5};
  Random random(7);
  const double clarity = 2.5;
  constexpr int kPeople = 4000;
  constexpr int kLumps = 8;
  double all = 0.0;
  double squares = 0.0;
  for (int person = 0; person < kPeople; ++person) {
    const double skill = drawSkill(observer, random);
    int found = 0;
    for (int lump = 0; lump < kLumps; ++lump) found += finds(clarity, skill, observer, random) ? 1 : 0;
    all += found;
    squares += found * found;
  }
  const double mean = all / kPeople;
  EXPECT_NEAR(mean / kLumps, detectionProbability(clarity, observer), 0.015);
  // Were the spread between lumps alone, people would differ as coins do.
  const double p = mean / kLumps;
  EXPECT_GT(squares / kPeople - mean * mean, 2.0 * kLumps * p * (1.0 - p));
}

TEST(LumpObserver, StrokesPassTheLumpAtMostHalfTheirDistance) {
  Random random(1);
  double widest = 0.0;
  for (int i = 0; i < 1000; ++i) widest = std::max(widest, std::abs(drawStroke(random)));
  EXPECT_LE(widest, 8.0);
  EXPECT_GT(widest, 7.8);
}

TEST(LumpObserver, SaysWhichOfItsNumbersMakesNoSense) {
  EXPECT_NO_THROW(check(LumpObserver{}));
  EXPECT_EQ(support::thrownMessage([] { check(LumpObserver{.spread = 0.0}); }),
            "lump observer: spread = 0 must be above 0");
  EXPECT_EQ(support::thrownMessage([] { check(LumpObserver{.taxels = 17}); }),
            "lump observer: taxels = 17 is out of range: 2 to 16, or 0");
}

}  // namespace
}  // namespace palpate::lumps

#include "palpate/training/staircase.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulated_answers.h"

namespace palpate::training {

namespace {

const std::vector<double> kVhbRising(kVhbLevels.rbegin(), kVhbLevels.rend());

/// In steps of 2 %, so that steps do not blur where it hovers.
std::vector<double> fineLevels() {
  std::vector<double> levels;
  for (double change = 0.02; change < 1.0; change *= 1.02) levels.push_back(change);
  return levels;
}

/// Mean share of right answers at the changes that a long walk turned at.
double rightWhereItTurns(const StaircaseRule& rule) {
  const Psychometric trainee{.threshold = 0.2, .slope = 1.8, .lapse = 0.0, .guess = 1.0 / 12.0};
  Staircase staircase(fineLevels(), 0.3, rule);
  Random random(8);
  for (int i = 0; i < 200'000; ++i)
    staircase.answer(random.uniform() < probabilityCorrect(trainee, staircase.change()));
  double sum = 0.0;
  for (const double change : staircase.reversals()) sum += std::log(change);
  return probabilityCorrect(trainee, std::exp(sum / static_cast<double>(staircase.reversals().size())));
}

}  // namespace

TEST(Staircase, HoversWhereTheRuleAims) {
  EXPECT_NEAR(rightWhereItTurns({}), 0.707, 0.01) << "two down, one up: the root of one half";
  EXPECT_NEAR(rightWhereItTurns({.right_for_harder = 3}), 0.794, 0.01) << "three down, one up: the cube root";
  EXPECT_NEAR(rightWhereItTurns({.right_for_harder = 1, .easier_steps = 3}), 0.75, 0.01) << "steps of one to three";
}

TEST(Staircase, WalksTheLevelsInDoubleStepsUntilItTurnedTwice) {
  Staircase staircase(kVhbRising, 0.5, twoDownOneUp(kVhbRising));
  const auto twice_right = [&] {
    staircase.answer(true);
    staircase.answer(true);
    return staircase.change();
  };
  EXPECT_EQ(staircase.change(), 0.50);
  staircase.answer(true);
  EXPECT_EQ(staircase.change(), 0.50) << "one right answer alone moves nothing";
  staircase.answer(true);
  EXPECT_EQ(staircase.change(), 0.28) << "two places at once";
  EXPECT_EQ(twice_right(), 0.14);
  EXPECT_EQ(twice_right(), 0.07);
  EXPECT_EQ(twice_right(), 0.07) << "there is nothing smaller";
  staircase.answer(false);
  EXPECT_EQ(staircase.change(), 0.14) << "turned once";
  EXPECT_EQ(twice_right(), 0.10) << "turned twice: single steps";
  staircase.answer(false);
  EXPECT_EQ(staircase.change(), 0.14);
  EXPECT_EQ(staircase.reversals(), (std::vector<double>{0.07, 0.14, 0.10}));
}

TEST(Staircase, StepsAreAboutTwentyPercentOnEveryList) {
  EXPECT_EQ(twoDownOneUp(kVhbRising).harder_steps, 1u);
  const std::vector<double> adaptive = adaptiveLevels(ChangeMeaning::compliance);
  const std::size_t steps = twoDownOneUp(adaptive).harder_steps;
  EXPECT_NEAR(adaptive[steps] / adaptive[0], 1.2, 0.02);
}

TEST(Mastery, ReplaysAScriptedSession) {
  // Which answers are right, and the changes that are asked for, from 50 %.
  struct Step {
    double change;
    bool right;
  };
  const std::vector<Step> script = {
      {0.50, true},  {0.50, true},  {0.50, true},                 // 3 of 3: settled without the fourth
      {0.40, true},  {0.40, false}, {0.40, true},  {0.40, true},  // 3 of 4
      {0.28, false}, {0.28, true},  {0.28, false},                // the second wrong one ends it
      {0.40, true},  {0.40, true},  {0.40, true},                 // back up, mastered again
      {0.28, true},  {0.28, true},  {0.28, false}, {0.28, true},  //
      {0.20, false}, {0.20, false},                               //
      {0.28, true},
  };
  Block block({.method = Method::mastery, .stop = {20, 20}}, 3);
  for (const Step& step : script) {
    ASSERT_FALSE(block.finished());
    EXPECT_EQ(block.next().change, step.change) << block.next().number;
    block.answer({.answer = 1, .correct = step.right});
  }
  EXPECT_TRUE(block.finished());
  EXPECT_EQ(block.result().level, 0.28);
  EXPECT_EQ(block.result().trials, 20);
  EXPECT_EQ(block.result().correct, 14);
}

TEST(Mastery, ByGuessingIsOneInFiveHundredAmongTwelveAndNearlyOneInThreeAmongTwo) {
  const auto share_mastered = [](int choices) {
    constexpr int kBlocks = 100'000;
    Random random(17);
    int mastered = 0;
    for (int i = 0; i < kBlocks; ++i) {
      Mastery mastery(kVhbRising, 0.5);
      while (mastery.settled() == 0) mastery.answer(random.below(static_cast<std::uint64_t>(choices)) == 0);
      if (mastery.mastered()) ++mastered;
    }
    return static_cast<double>(mastered) / kBlocks;
  };
  EXPECT_NEAR(share_mastered(12), 0.002, 0.001);
  EXPECT_NEAR(share_mastered(2), 0.3125, 0.005);
}

TEST(Mastery, EndsWhenTheSmallestLevelIsMastered) {
  Block block({.method = Method::mastery, .stop = {10, 40}}, 3);
  while (!block.finished()) block.answer({.answer = block.next().site, .correct = true});
  EXPECT_EQ(block.answered(), 3 * 7);
  EXPECT_EQ(block.result().level, 0.07);
}

}  // namespace palpate::training

#include "palpate/training/trainee/observer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "support/error_message.h"

namespace palpate::training {
namespace {

using support::thrownMessage;

constexpr int kPlaces = 12;

/// How often it names the place that is `ratio` times as stiff, of so many trials.
double shareRight(const ObserverSettings& settings, double ratio, int trials, int block = 0) {
  Random random(11);
  std::array<int, kPlaces> sites{};
  std::iota(sites.begin(), sites.end(), 1);
  int right = 0;
  for (int i = 0; i < trials; ++i) {
    const int truth = 1 + static_cast<int>(random.below(kPlaces));
    std::array<double, kPlaces> felt{};
    felt.fill(1.0);
    felt[static_cast<std::size_t>(truth) - 1] = ratio;
    if (decide(sites, felt, settings, block, kPlaces, random) == truth) ++right;
  }
  return static_cast<double>(right) / trials;
}

/// As docs/explanation/training-methods.md defines T: halfway between guessing and what lapses leave.
double halfway(double lapse) { return 1.0 / 12.0 + (1.0 - 1.0 / 12.0 - lapse) / 2.0; }

TEST(Observer, ReadsItsWordsAndSaysThemAgain) {
  const ObserverSettings read = observerNamed(" weber=0.28, weber_end=0.14,learning_blocks=2,lapse=0,sites=8,seed=9");
  EXPECT_EQ(read.weber, 0.28);
  EXPECT_EQ(read.weber_end, 0.14);
  EXPECT_EQ(read.learning_blocks, 2.0);
  EXPECT_EQ(read.lapse, 0.0);
  EXPECT_EQ(read.sites, 8);
  EXPECT_EQ(read.seed, 9u);
  EXPECT_EQ(formatObserver(observerNamed(formatObserver(read))), formatObserver(read));
  EXPECT_EQ(observerNamed("").weber, ObserverSettings().weber);
}

TEST(Observer, NamesTheKeyThatItDoesNotTake) {
  EXPECT_NE(thrownMessage([] { observerNamed("webber=0.2"); }).find("weber"), std::string::npos);
  EXPECT_NE(thrownMessage([] { observerNamed("weber"); }).find("has no value"), std::string::npos);
  EXPECT_NE(thrownMessage([] { observerNamed("weber=much"); }).find("weber = 'much' must be a number"),
            std::string::npos);
  EXPECT_NE(thrownMessage([] { observerNamed("lapse=0.9"); }).find("lapse"), std::string::npos);
  EXPECT_NE(thrownMessage([] { observerNamed("sites=7.5"); }).find("whole number"), std::string::npos);
  EXPECT_NE(thrownMessage([] { observerNamed("weber=0.2,,"); }).find("has no value"), std::string::npos);
}

TEST(Observer, IsHalfRightAtItsThreshold) {
  constexpr int kTrials = 40000;  // standard error 0.25 %
  ObserverSettings settings;
  for (const double weber : {0.07, 0.2, 0.4}) {
    settings.weber = weber;
    EXPECT_NEAR(shareRight(settings, 1.0 / (1.0 - weber), kTrials), halfway(settings.lapse), 0.01) << weber;
  }
}

TEST(Observer, ReadsAChangeAsTheProtocolDeclaresIt) {
  ObserverSettings settings;
  settings.meaning = ChangeMeaning::stiffness;
  EXPECT_NEAR(shareRight(settings, 1.2, 40000), halfway(settings.lapse), 0.01);
}

TEST(Observer, GuessesWhereThereIsNothingAndLapsesWhereThereIsMuch) {
  ObserverSettings settings;
  settings.lapse = 0.24;
  EXPECT_NEAR(shareRight(settings, 1.0, 40000), 1.0 / 12.0, 0.006);
  settings.weber = 0.02;
  EXPECT_NEAR(shareRight(settings, 2.0, 40000), 0.76, 0.008);
  settings.lapse = 0.0;
  EXPECT_EQ(shareRight(settings, 2.0, 2000), 1.0);
}

TEST(Observer, LearnsTowardsItsEnd) {
  const ObserverSettings settings = observerNamed("weber=0.28,weber_end=0.14,learning_blocks=2");
  EXPECT_DOUBLE_EQ(weberNow(settings, 0), 0.28);
  EXPECT_NEAR(weberNow(settings, 2), 0.14 + 0.14 / std::exp(1.0), 1e-12);
  EXPECT_NEAR(weberNow(settings, 40), 0.14, 1e-6);
  EXPECT_DOUBLE_EQ(weberNow(observerNamed("weber=0.28"), 40), 0.28);
  EXPECT_GT(shareRight(settings, 1.0 / 0.86, 4000, 6), shareRight(settings, 1.0 / 0.86, 4000, 0) + 0.1);
}

TEST(Observer, LeavesOutOtherSitesInEveryTrial) {
  ObserverSettings settings;
  settings.sites = 8;
  Random random(3);
  std::array<int, kPlaces> searched{};
  constexpr int kTrials = 3000;
  for (int i = 0; i < kTrials; ++i) {
    const std::vector<int> sites = sitesSearched(settings, kPlaces, random);
    ASSERT_EQ(sites.size(), 8u);
    ASSERT_TRUE(std::ranges::adjacent_find(sites, std::greater_equal<>()) == sites.end());
    for (const int site : sites) ++searched.at(static_cast<std::size_t>(site) - 1);
  }
  for (const int times : searched) EXPECT_NEAR(static_cast<double>(times) / kTrials, 8.0 / 12.0, 0.04);
  settings.sites = 40;
  EXPECT_EQ(sitesSearched(settings, kPlaces, random).size(), 12u);
}

TEST(Observer, NamesOnlyWhatItFelt) {
  ObserverSettings settings;
  settings.lapse = 0.5;
  Random random(5);
  constexpr std::array kFelt = {2, 9, 11};
  constexpr std::array kRatios = {1.0, 1.3, 1.0};
  std::array<int, kPlaces> named{};
  for (int i = 0; i < 600; ++i) {
    const int site = decide(kFelt, kRatios, settings, 0, kPlaces, random);
    ++named.at(static_cast<std::size_t>(site) - 1);
  }
  EXPECT_EQ(named[1] + named[8] + named[10], 600);
  EXPECT_GT(named[8], named[1]);
  EXPECT_GT(named[8], named[10]);
  EXPECT_GT(named[1], 0);
}

TEST(Observer, GuessesAmongAllWhereItFeltNothing) {
  Random random(5);
  std::array<int, kPlaces> named{};
  for (int i = 0; i < 6000; ++i) ++named.at(static_cast<std::size_t>(decide({}, {}, {}, 0, kPlaces, random)) - 1);
  for (const int times : named) EXPECT_NEAR(times / 6000.0, 1.0 / 12.0, 0.02);
}

}  // namespace
}  // namespace palpate::training

// Sittings with lumps in numbers, against hands and tables.
#include "palpate/training/report/lump_statistics.h"

#include <gtest/gtest.h>

namespace palpate::training {
namespace {

using lumps::LumpTrial;

TEST(LumpStatistics, DPrimeIsThatOfTheTables) {
  // (18 + 1/2) / 21 = 0.881 -> z 1.180; (2 + 1/2) / 11 = 0.2273 -> z -0.748: by a table of the normal distribution.
  const DPrime prime = dPrime({18, 20}, {2, 10});
  EXPECT_NEAR(prime.value, 1.928, 0.002);
  // Variances p (1 - p) / (n phi(z)^2): 0.1262 and 0.1755, their sum's root 0.5493, times 1.96 = 1.0767.
  EXPECT_NEAR(prime.high - prime.value, 1.0767, 0.001);
  EXPECT_NEAR(prime.value - prime.low, prime.high - prime.value, 1e-12);
  EXPECT_NEAR(dPrime({5, 10}, {5, 10}).value, 0.0, 1e-9) << "guessing";
  EXPECT_LT(dPrime({10, 10}, {0, 10}).value, 10.0) << "finite also where nothing went wrong";
}

LumpTrial body(int size, int depth, bool found, int said_size) {
  LumpTrial trial{.hidden = {{.size = size, .depth = depth, .cue = 3.0}}, .findings = {}, .over = true};
  if (found) trial.findings.push_back({.place_mm = Vec2(3.0, 4.0), .size = said_size, .mobile = 0});
  return trial;
}

TEST(LumpStatistics, CountsEachKindAndWhatWasSaidOfIt) {
  std::vector<LumpTrial> trials = {body(0, 0, false, 0), body(0, 2, true, 1), body(2, 0, true, 2)};
  trials.push_back({.hidden = {}, .findings = {}, .over = true});
  LumpTrial in_vain{.hidden = {}, .findings = {}, .over = true};
  in_vain.findings.push_back({.place_mm = Vec2(0.0, 0.0)});
  trials.push_back(in_vain);
  trials.push_back({.hidden = {{}}, .findings = {}, .over = false});  // goes on: does not count yet
  const LumpStatistics statistics = lumpStatistics(trials, {});
  EXPECT_EQ(statistics.found.part, 2);
  EXPECT_EQ(statistics.found.whole, 3);
  EXPECT_EQ(statistics.size.found[0].part, 1);
  EXPECT_EQ(statistics.size.found[0].whole, 2);
  EXPECT_EQ(statistics.size.found[1].whole, 0);
  EXPECT_EQ(statistics.depth.found[0].part, 1);
  EXPECT_EQ(statistics.depth.found[2].part, 1);
  EXPECT_EQ(statistics.size.said[0][1], 1) << "a small one was called middle";
  EXPECT_EQ(statistics.size.said[2][2], 1);
  EXPECT_EQ(statistics.mobility_right.part, 2);
  EXPECT_NEAR(statistics.error_mm.median, 5.0, 1e-12);
  EXPECT_EQ(statistics.known_without.part, 1);
  EXPECT_EQ(statistics.known_without.whole, 2);
  EXPECT_EQ(statistics.counts.false_places, 1);
  ASSERT_TRUE(statistics.prime);
}

TEST(LumpStatistics, WithoutEmptyBodiesThereIsNoDPrime) {
  EXPECT_FALSE(lumpStatistics({body(0, 0, true, 0)}, {}).prime);
}

}  // namespace
}  // namespace palpate::training

// A burst of inattention is seen in the answers; attentive people are hardly ever warned.
#include "palpate/training/attention.h"

#include <gtest/gtest.h>

#include <vector>

#include "palpate/training/learning_curve.h"
#include "teach/tests/training/simulated_answers.h"

namespace palpate::training {
namespace {

struct Tested {
  ThresholdSummary threshold;
  AttentionCheck attention;
};

double meanSlope(const Posterior& posterior) {
  double mean = 0.0;
  std::size_t cell = 0;
  for (std::size_t t = 0; t < posterior.lnThresholds().size(); ++t) {
    for (const double slope : posterior.slopes()) {
      for (std::size_t l = 0; l < posterior.lapses().size(); ++l) mean += posterior.weights()[cell++] * slope;
    }
  }
  return mean;
}

/// A test of 40 trials in which `bursts` runs of `length` answers are guesses.
Tested tested(double threshold, int bursts, int length, std::uint64_t seed) {
  Block block({}, seed);
  Random random(seed + 1'000'000);
  std::vector<bool> away(40, false);
  for (int i = 0; i < bursts; ++i) {
    const auto from = random.below(41 - static_cast<std::uint64_t>(length));
    for (int j = 0; j < length; ++j) away[from + static_cast<std::size_t>(j)] = true;
  }
  const Psychometric trainee{.threshold = threshold, .slope = idealSlope(12)};
  std::vector<Answer> answers;
  while (!block.finished()) {
    const PlannedTrial trial = block.next();
    TrialOutcome outcome = simulateAnswer(trainee, trial, random);
    if (away[answers.size()]) {
      outcome.correct = random.uniform() < 1.0 / 12;
      outcome.answer = outcome.correct ? trial.site : trial.site % 12 + 1;
    }
    answers.push_back({trial.change, outcome.correct, 12});
    block.answer(outcome);
  }
  const ThresholdSummary summary = block.result().threshold;
  return {summary, checkAttention(answers, 12, summary.median, meanSlope(block.posterior()))};
}

double pairThreshold(int pair) { return 0.10 + 0.04 * (pair % 5); }

struct Shares {
  int tests = 0, warned = 0, pairs = 0, changed = 0, changed_without_warning = 0;
};

/// People who do not change, tested twice.
Shares simulateShares(int pairs, int bursts, int length) {
  Shares shares;
  for (int i = 0; i < pairs; ++i) {
    const auto seed = 100 * static_cast<std::uint64_t>(bursts) + 10'000 * static_cast<std::uint64_t>(i);
    const Tested before = tested(pairThreshold(i), bursts, length, seed + 1);
    const Tested now = tested(pairThreshold(i), bursts, length, seed + 2);
    shares.tests += 2;
    shares.warned += static_cast<int>(before.attention.warned()) + static_cast<int>(now.attention.warned());
    ++shares.pairs;
    if (!changeBetween(before.threshold, now.threshold).clear) continue;
    ++shares.changed;
    shares.changed_without_warning += static_cast<int>(!before.attention.warned() && !now.attention.warned());
  }
  return shares;
}

TEST(Attention, AttentivePeopleAreHardlyEverWarned) {
  const Shares shares = simulateShares(100, 0, 0);
  EXPECT_LE(shares.warned, 4) << "of " << shares.tests << ": 2 %";
}

TEST(Attention, BurstsAreSeenAndNotCalledChange) {
  const Shares shares = simulateShares(60, 2, 5);
  EXPECT_GE(shares.warned, shares.tests / 2);
  EXPECT_LE(shares.changed_without_warning, 1) << "of " << shares.changed << " called changed";
}

TEST(Attention, MissesOfEasyChangesInARowCountAndThoseNearTheThresholdDoNot) {
  const auto answered = [](double change, int misses) {
    std::vector<Answer> answers;
    for (int i = 0; i < 40; ++i) answers.push_back({change, i < 10 || i >= 10 + misses, 12});
    return checkAttention(answers, 12, 0.15, 1.8);
  };
  EXPECT_TRUE(answered(0.5, 2).warned());
  EXPECT_EQ(answered(0.5, 2).easy, 40);
  EXPECT_EQ(answered(0.5, 2).easy_missed, 2);
  EXPECT_FALSE(answered(0.5, 1).warned()) << "everybody lapses once";
  EXPECT_FALSE(answered(0.15, 4).warned());
  EXPECT_EQ(answered(0.15, 4).easy, 0);
}

}  // namespace
}  // namespace palpate::training

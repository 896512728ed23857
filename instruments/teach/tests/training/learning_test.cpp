#include <gtest/gtest.h>

#include <cmath>

#include "palpate/training/group_estimate.h"
#include "palpate/training/learning_curve.h"
#include "simulated_answers.h"

namespace palpate::training {

namespace {

std::vector<Answer> answersAt(double threshold, std::uint64_t seed, int trials = 40) {
  std::vector<Answer> answers;
  Block block({.stop = {trials, trials}}, seed);
  Random random(seed + 500);
  while (!block.finished()) {
    const PlannedTrial trial = block.next();
    const TrialOutcome outcome = simulateAnswer({.threshold = threshold}, trial, random);
    answers.push_back({trial.change, outcome.correct, 12});
    block.answer(outcome);
  }
  return answers;
}

/// Six sessions from 28 to 14 %.
double learnt(int session) { return 0.14 + 0.14 * std::exp(-session / 1.5); }

std::vector<SessionAnswers> sixSessions(std::uint64_t seed) {
  std::vector<SessionAnswers> sessions;
  for (int session = 0; session < 6; ++session) {
    sessions.push_back({answersAt(learnt(session), 100 * seed + static_cast<std::uint64_t>(session))});
  }
  return sessions;
}

}  // namespace

TEST(LearningCurve, BeginsWithTheFirstSessionAlone) {
  const std::vector<SessionAnswers> sessions = sixSessions(1);
  const std::vector<LearningPoint> points = filteredThresholds(sessions);
  ASSERT_EQ(points.size(), 6u);
  Posterior first;
  for (const Answer& answer : sessions[0].answers) first.add(answer);
  EXPECT_EQ(points[0].threshold.median, first.summary().median) << "later sessions do not reach back";
  EXPECT_EQ(points[0].trials, 40);
  const std::vector<LearningPoint> cut = filteredThresholds(std::span(sessions).first(3));
  EXPECT_EQ(points[2].threshold.median, cut[2].threshold.median);
}

TEST(LearningCurve, CarriesOverWhatWasKnownAndFollowsWhatChanges) {
  double filtered = 0.0;
  double separate = 0.0;
  double bias = 0.0;
  constexpr int kPeople = 25;
  for (std::uint64_t person = 0; person < kPeople; ++person) {
    const std::vector<SessionAnswers> sessions = sixSessions(person);
    const std::vector<LearningPoint> points = filteredThresholds(sessions);
    for (int session = 1; session < 6; ++session) {
      const double truth = std::log(learnt(session));
      const auto at = static_cast<std::size_t>(session);
      Posterior alone;
      for (const Answer& answer : sessions[at].answers) alone.add(answer);
      const double error = std::log(points[at].threshold.median) - truth;
      bias += error / (5.0 * kPeople);
      filtered += error * error / (5.0 * kPeople);
      separate += std::pow(std::log(alone.summary().median) - truth, 2) / (5.0 * kPeople);
    }
  }
  EXPECT_LT(std::sqrt(filtered), std::sqrt(separate));
  EXPECT_LT(std::sqrt(filtered), 0.15);
  EXPECT_LT(std::abs(bias), 0.06);
}

TEST(LearningCurve, ASessionWithoutAnswersKnowsLess) {
  std::vector<SessionAnswers> sessions = sixSessions(3);
  sessions[3].answers.clear();
  const std::vector<LearningPoint> points = filteredThresholds(sessions);
  EXPECT_EQ(points[3].trials, 0);
  EXPECT_GT(points[3].threshold.sd_ln, points[2].threshold.sd_ln + 0.05);
}

TEST(LearningCurve, IsFittedByAnExponentialWhoseBandHoldsTheTruth) {
  int inside = 0;
  int all = 0;
  for (std::uint64_t person = 0; person < 6; ++person) {
    const auto fit = fitLearning(sixSessions(person));
    ASSERT_TRUE(fit.has_value());
    EXPECT_GT(fit->start.median, fit->end.median);
    for (const CurvePoint& point : fit->curve) {
      if (point.session != std::floor(point.session)) continue;
      ++all;
      const double truth = learnt(static_cast<int>(point.session));
      if (point.low <= truth && truth <= point.high) ++inside;
      EXPECT_LE(point.low, point.median);
      EXPECT_LE(point.median, point.high);
    }
  }
  EXPECT_EQ(all, 36);
  EXPECT_GE(inside, 31);
}

TEST(LearningCurve, OfTwoSessionsIsNone) {
  std::vector<SessionAnswers> sessions = sixSessions(1);
  sessions.resize(2);
  EXPECT_FALSE(fitLearning(sessions).has_value());
}

TEST(RealChange, IsPlannedByItsTrials) {
  EXPECT_NEAR(factorOfRealChange(40, 40), 1.45, 0.005);
  EXPECT_NEAR(factorOfRealChange(20, 20), 1.67, 0.005);
}

TEST(RealChange, IsSeldomSeenWhereNothingChanged) {
  int seen = 0;
  constexpr int kPeople = 120;
  for (std::uint64_t person = 0; person < kPeople; ++person) {
    ThresholdSummary results[2];
    for (int i = 0; i < 2; ++i) {
      Posterior posterior;
      for (const Answer& answer : answersAt(0.2, 9000 + 2 * person + static_cast<std::uint64_t>(i))) {
        posterior.add(answer);
      }
      results[i] = posterior.summary();
    }
    if (changeBetween(results[0], results[1]).clear) ++seen;
  }
  EXPECT_LE(seen, 13) << "five percent of 120, and three sd";
}

TEST(ThresholdLikelihood, KnowsNoPriorAndDifferencesOfTwo) {
  const ThresholdLikelihood nothing = thresholdLikelihood({});
  for (const double value : nothing.values) EXPECT_NEAR(value, 1.0, 1e-9);
  const std::vector<Answer> before = answersAt(0.28, 1, 200);
  const std::vector<Answer> after = answersAt(0.14, 2, 200);
  const ThresholdLikelihood change = changeLikelihood(thresholdLikelihood(before), thresholdLikelihood(after));
  const auto most = std::max_element(change.values.begin(), change.values.end()) - change.values.begin();
  EXPECT_NEAR(change.places[static_cast<std::size_t>(most)], std::log(0.5), 0.25);
}

TEST(GroupEstimate, FindsMeanAndSpreadOfPeopleNotOfMeasurements) {
  constexpr double kMean = 0.28;
  constexpr double kSpread = 0.3;
  std::vector<ThresholdLikelihood> before;
  std::vector<ThresholdLikelihood> change;
  Random random(4);
  for (std::uint64_t person = 0; person < 60; ++person) {
    const double threshold = kMean * std::exp(kSpread * random.normal() - 0.5 * kSpread * kSpread);
    before.push_back(thresholdLikelihood(answersAt(threshold, 2 * person)));
    change.push_back(changeLikelihood(before.back(), thresholdLikelihood(answersAt(0.5 * threshold, 2 * person + 1))));
  }
  const GroupEstimate group = groupThreshold(before);
  EXPECT_NEAR(group.mean, kMean, 0.03);
  EXPECT_LT(group.low, kMean);
  EXPECT_GT(group.high, kMean);
  EXPECT_NEAR(group.sd_ln, kSpread, 0.1);
  const GroupChange halved = groupChange(change);
  EXPECT_TRUE(halved.real());
  EXPECT_LT(halved.low, 2.0);
  EXPECT_GT(halved.high, 2.0);
  EXPECT_LT(halved.sd_ln, 0.2) << "everybody gained as much";
}

TEST(GroupEstimate, IsNotPulledTowardsThePrior) {
  // Ten answers each: medians of single people move a third of the way to 22 %.
  std::vector<ThresholdLikelihood> people;
  double medians = 0.0;
  for (std::uint64_t person = 0; person < 60; ++person) {
    const std::vector<Answer> answers = answersAt(0.08, 40 + person, 10);
    people.push_back(thresholdLikelihood(answers));
    Posterior posterior;
    for (const Answer& answer : answers) posterior.add(answer);
    medians += posterior.summary().mean_ln / 60.0;
  }
  const GroupEstimate group = groupThreshold(people);
  EXPECT_LT(std::abs(group.mean_ln - std::log(0.08)), std::abs(medians - std::log(0.08)));
}

TEST(GroupEstimate, OfOnePersonIsNone) {
  const std::vector<ThresholdLikelihood> one{thresholdLikelihood({})};
  EXPECT_EQ(groupThreshold(one).people, 1);
  EXPECT_EQ(groupThreshold(one).mean, 0.0);
  EXPECT_FALSE(groupChange(one).real());
}

TEST(Student, IsAsTabled) {
  EXPECT_NEAR(student95(3), 3.182, 0.004);
  EXPECT_NEAR(student95(5), 2.571, 0.001);
  EXPECT_NEAR(student95(9), 2.262, 0.001);
  EXPECT_NEAR(student95(88), 1.987, 0.001);
}

}  // namespace palpate::training

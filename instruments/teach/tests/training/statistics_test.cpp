// The numbers of a report: counted by hand where they are counts, against the block's own result where they are
// thresholds, against the truth where trainees were made. tools/check_report.py computes all of them once more.
#include <gtest/gtest.h>

#include <cmath>

#include "palpate/training/report/training_statistics.h"
#include "support/temporary_folder.h"
#include "teach/tests/support/made_trainees.h"

namespace palpate::training {
namespace {

TrialRow answered(double change, int truth, int answer, int felt = 12) {
  TrialRow trial;
  trial.change = change;
  trial.site_true = truth;
  trial.site_answer = answer;
  trial.correct = truth == answer;
  trial.sites_felt = felt;
  trial.seconds = 10.0;
  return trial;
}

TrialStatistics statisticsOf(const std::vector<TrialRow>& trials) {
  std::vector<ChosenTrial> chosen;
  for (const TrialRow& trial : trials) chosen.push_back({.row = &trial, .choices = 12, .felt_ms = 300.0});
  return trialStatistics(chosen);
}

TEST(TrainingStatistics, AccuracyIsCountedForEachChangeAndCorrectedForChance) {
  std::vector<TrialRow> trials = {answered(0.2, 1, 1), answered(0.2, 2, 3), answered(0.2, 4, 4),
                                  answered(0.2, 5, 5), answered(0.4, 7, 7), answered(0.4, 8, 8, 2)};
  const TrialStatistics found = statisticsOf(trials);
  ASSERT_EQ(found.levels.size(), 2u);
  EXPECT_EQ(found.levels[0].middle, 0.2);
  EXPECT_EQ(found.levels[0].right.part, 3);
  EXPECT_DOUBLE_EQ(found.levels[0].right.share(), 0.75);
  EXPECT_DOUBLE_EQ(found.levels[0].corrected(), (0.75 - 1.0 / 12) / (11.0 / 12));
  EXPECT_DOUBLE_EQ(found.levels[1].chance, 0.5 * (1.0 / 12 + 1.0 / 2)) << "two places felt: one in two";
  EXPECT_EQ(found.correct, 5);
}

TEST(TrainingStatistics, SharesHaveWilsonsInterval) {
  const ShareInterval eight = wilsonInterval(8, 10);  // by hand, z = 1.959964
  EXPECT_NEAR(eight.low, 0.490162, 1e-6);
  EXPECT_NEAR(eight.high, 0.943318, 1e-6);
  EXPECT_EQ(wilsonInterval(0, 4).low, 0.0);
  EXPECT_EQ(wilsonInterval(4, 4).high, 1.0);
}

TEST(TrainingStatistics, QuartilesLieBetweenNeighbours) {
  const Spread four = computeSpread({4.0, 1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(four.lower_quartile, 1.75);
  EXPECT_DOUBLE_EQ(four.median, 2.5);
  EXPECT_DOUBLE_EQ(four.upper_quartile, 3.25);
  EXPECT_EQ(computeSpread({}).count, 0u);
  EXPECT_EQ(computeSpread({7.0}).upper_quartile, 7.0);
}

TEST(TrainingStatistics, WarmUpsAndTrialsWhoseTargetWasNeverFeltDoNotCount) {
  std::vector<TrialRow> trials(4, answered(0.2, 1, 1));
  trials[0].kind = TrialKind::warm_up;
  trials[1].excluded = "target not felt";
  trials[2].sites_felt = 1;  // nothing to compare with
  trials[3].kind = TrialKind::easy;
  trials[3].correct = false;
  const TrialStatistics found = statisticsOf(trials);
  EXPECT_EQ(found.shown, 4);
  EXPECT_EQ(found.warm_up, 1);
  EXPECT_EQ(found.excluded, 2);
  EXPECT_EQ(found.counted, 1);
  EXPECT_EQ(found.easy_wrong, 1);
  EXPECT_EQ(found.not_all_felt, 1);
  EXPECT_EQ(found.seconds.count, 3u) << "what was put to the trainee took its time";
}

TEST(TrainingStatistics, WrongAnswersAreSortedByWhereTheyWent) {
  std::vector<TrialRow> trials = {answered(0.2, 3, 4),  answered(0.2, 3, 9), answered(0.2, 6, 7),
                                  answered(0.2, 3, 12), answered(0.2, 3, 0), answered(0.2, 3, 3)};
  const TrialStatistics found = statisticsOf(trials);
  EXPECT_EQ(found.wrong.beside, 1);
  EXPECT_EQ(found.wrong.other_side, 1);
  EXPECT_EQ(found.wrong.elsewhere, 2) << "6 and 7 are the ends of two columns, no neighbours";
  EXPECT_EQ(found.wrong.none, 1);
  EXPECT_EQ(found.answers.at(3, 9), 1);
  EXPECT_EQ(found.answers.at(3, 0), 1);
  EXPECT_EQ(found.answers.of(3), 5);
}

TEST(TrainingStatistics, ASiteIsFeltWhenItWasPressedLongEnough) {
  std::vector<TrialRow> trials(2, answered(0.2, 1, 1));
  trials[0].visits = {{.site = 5, .presses = 2, .dwell_ms = 300.0, .peak_force_n = 2.0, .deepest_mm = 6.0}};
  trials[1].visits = {{.site = 5, .presses = 1, .dwell_ms = 299.0, .peak_force_n = 1.0, .deepest_mm = 4.0}};
  const SiteFelt five = statisticsOf(trials).felt.at(4);
  EXPECT_EQ(five.trials, 2);
  EXPECT_EQ(five.felt, 1);
  EXPECT_DOUBLE_EQ(five.presses, 1.5);
  EXPECT_DOUBLE_EQ(five.dwell_s, 0.2995);
  EXPECT_DOUBLE_EQ(five.peak_force_n, 1.5);
  EXPECT_EQ(five.greatest_force_n, 2.0);
}

TEST(TrainingStatistics, ResultsDifferOnlyWhereTheyAreFurtherApartThanBothLeaveOpen) {
  const auto result = [](double median, double factor) {
    return ThresholdSummary{.median = median, .low = median / factor, .high = median * factor};
  };
  EXPECT_TRUE(changeBetween(result(0.28, 1.3), result(0.14, 1.3)).clear);
  EXPECT_DOUBLE_EQ(changeBetween(result(0.28, 1.3), result(0.14, 1.3)).ratio, 0.5);
  EXPECT_FALSE(changeBetween(result(0.28, 1.7), result(0.14, 1.7)).clear);
  EXPECT_FALSE(changeBetween(result(0.2, 1.1), result(0.2, 1.1)).clear);
}

// --- of made trainees

class MadeRecord : public testing::Test {
 protected:
  MadeRecord() : store_(folder_ / "made.results", Store::Open::create_too), made_(store_) {}
  TrainingRecord record() {
    return trainingRecord(store_, [](const TraineeRow&) { return true; });
  }
  support::TemporaryFolder folder_;
  Store store_;
  support::MadeTrainees made_;
};

TEST_F(MadeRecord, AThresholdIsTheOneThatTheBlockFound) {
  made_.add(1);
  const TrainingRecord all = record();
  const TraineeStatistics trainee = trainingStatistics(all).trainees.at(0);
  ASSERT_EQ(trainee.points.size(), 5u);
  for (const ThresholdPoint& point : trainee.points) {
    ASSERT_TRUE(point.threshold);
    EXPECT_NEAR(point.threshold->median, point.stored, 1e-12);
    EXPECT_NEAR(point.threshold->high, point.stored_high, 1e-12);
  }
  EXPECT_EQ(trainee.changed_results, 0);
}

TEST_F(MadeRecord, AChangedRecordIsNoticed) {
  made_.add(1);
  TrainingRecord all = record();
  TrialRow& trial = all.trainees.at(0).sessions.at(0).blocks.at(0).trials.at(20);
  trial.correct = !trial.correct;
  EXPECT_EQ(trainingStatistics(all).trainees.at(0).changed_results, 1);
}

TEST_F(MadeRecord, FirstAndLastTestAreComparedAndNoExamination) {
  support::MadeCourse course;
  course.kinds.push_back(SessionKind::exam);
  made_.add(3, course);
  const TraineeStatistics trainee = trainingStatistics(record()).trainees.at(0);
  ASSERT_TRUE(trainee.compared);
  EXPECT_EQ(trainee.points[trainee.compared->before].kind, SessionKind::pre_test);
  EXPECT_EQ(trainee.points[trainee.compared->now].kind, SessionKind::post_test);
  EXPECT_EQ(trainee.latest()->kind, SessionKind::post_test);
  EXPECT_NE(trainee.points.back().verdict, Verdict::none);
}

TEST_F(MadeRecord, AnotherDeviceBeginsAnewAndIsNotCompared) {
  made_.add(4);
  TrainingRecord all = record();
  for (std::size_t i = 3; i < 5; ++i) all.trainees.at(0).sessions.at(i).row.device = "another";
  const TraineeStatistics trainee = trainingStatistics(all).trainees.at(0);
  ASSERT_TRUE(trainee.compared && trainee.compared->why_not);
  ASSERT_EQ(trainee.curve.size(), 5u);
  const ThresholdSummary& begun = trainee.curve[3].filtered;
  EXPECT_NEAR(begun.median, trainee.points[3].threshold->median, 1e-12) << "nothing is known of the new device";
  EXPECT_NE(trainee.curve[2].filtered.median, trainee.points[2].threshold->median);
  EXPECT_FALSE(trainee.learning) << "two blocks make no curve";
}

TEST_F(MadeRecord, WithoutEnoughAnswersThereIsNoThreshold) {
  made_.add(5);
  TrainingRecord all = record();
  all.trainees.at(0).sessions.resize(1);
  all.trainees.at(0).sessions[0].blocks.at(0).trials.resize(12);  // three of them are warm-ups
  const TraineeStatistics trainee = trainingStatistics(all).trainees.at(0);
  EXPECT_FALSE(trainee.points.at(0).threshold);
  EXPECT_TRUE(trainee.curve.empty());
  EXPECT_EQ(trainee.latest(), nullptr);
}

TEST_F(MadeRecord, AClassFindsTheThresholdsItsTraineesWereMadeWith) {
  support::MadeCourse course;
  course.kinds = {SessionKind::pre_test, SessionKind::post_test};
  for (std::uint64_t seed = 1; seed <= 16; ++seed) made_.add(seed, course);
  const ClassStatistics all = trainingStatistics(record()).all;
  ASSERT_EQ(all.occasions.size(), 2u);
  EXPECT_EQ(all.occasions[0].medians.count, 16u);
  // Four answers in ten of one person's 40 are left open: 0.14 of ln T, a fourth of that for sixteen. Three of those.
  EXPECT_NEAR(std::log(all.occasions[0].group.mean), std::log(0.28), 0.12);
  EXPECT_NEAR(std::log(all.occasions[1].group.mean), std::log(0.14), 0.12);
  ASSERT_TRUE(all.change);
  // A lapse in an easy trial after some misses looks like a burst of inattention in 2 to 3 of 100 attentive tests
  // (docs/explanation/training-methods.md), here in 3 of 32: those three people are compared with nothing.
  EXPECT_EQ(all.change->trainees, 13);
  EXPECT_LT(all.change->group.low, 2.0);
  EXPECT_GT(all.change->group.high, 2.0);
  EXPECT_EQ(all.change->clearly_worse, 0);
  for (const AnswerBox& box : all.collapsed) {
    EXPECT_NEAR(box.expected, box.right.share(), 0.05 + 2.5 * std::sqrt(0.25 / box.right.whole)) << box.middle;
  }
}

TEST_F(MadeRecord, AFittedCurveRisesFromChanceAndHoldsItsMiddleInItsBand) {
  made_.add(6);
  const TraineeStatistics trainee = trainingStatistics(record()).trainees.at(0);
  const FittedCurve curve = fittedCurve(computePosterior(trainee.points.at(0)), curveChanges());
  EXPECT_NEAR(curve.changes.front(), 0.03, 1e-12);
  EXPECT_NEAR(curve.changes.back(), 1.0, 1e-12);
  EXPECT_GE(curve.low.front(), 1.0 / 12);
  for (std::size_t i = 0; i < curve.changes.size(); ++i) {
    EXPECT_LE(curve.low[i], curve.mean[i]);
    EXPECT_GE(curve.high[i], curve.mean[i]);
    EXPECT_GT(curve.mean[i], i > 0 ? curve.mean[i - 1] : 0.0);
  }
}

TEST(TrainingRecord, WithoutAnybodyAllIsEmpty) {
  const TrainingStatistics nothing = trainingStatistics({});
  EXPECT_TRUE(nothing.trainees.empty());
  EXPECT_TRUE(nothing.all.occasions.empty());
  EXPECT_FALSE(nothing.all.change);
  EXPECT_EQ(nothing.all.tests.shown, 0);
}

}  // namespace
}  // namespace palpate::training

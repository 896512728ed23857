// The study of training: its arithmetic on cells made by hand, its sentences, and a small cut of the measurement
// itself.
#include <gtest/gtest.h>

#include <cmath>

#include "report/tests/report/says.h"
#include "teach/study/training_measurement.h"
#include "teach/study/training_numbers.h"

namespace palpate::study {

namespace {

training::ThresholdSummary reportedAs(double median, double low, double high) {
  return {.median = median, .low = low, .high = high};
}

std::vector<RecoveryCell> goodCells() {
  std::vector<RecoveryCell> cells;
  for (const double truth : {0.07, 0.14, 0.28, 0.40}) {
    cells.push_back({.truth = truth, .bias_points = 0.3, .sd_ln = 0.14, .coverage = 0.96, .mean_trials = 35.0});
  }
  return cells;
}

/// Where everything is as it should be.
TrainingMeasurement someTraining() {
  TrainingMeasurement found;
  for (const AskedBy method : {AskedBy::marginal_psi, AskedBy::two_down, AskedBy::constant}) {
    found.methods.push_back(
        {.method = method, .cells = goodCells(), .error_ln = {0.5, 0.1}, .least_to_15 = 30, .most_to_15 = 35});
  }
  for (const char* name : {"turns", "first", "up and down"}) {
    found.readings.push_back({.name = name, .least_ratio = 1.3, .most_ratio = 1.4, .sd_ln = 0.2, .coverage = 0.8});
  }
  for (const char* name : {"lapse rate 0", "lapse rate 6 %", "slope 1.2", "slope 2.7"}) {
    found.robust.push_back({name, goodCells()});
  }
  found.stop_rules.push_back({"0.35", goodCells()});
  found.two_intervals = {"two intervals", goodCells()};
  const RecoveryCell corrected{.truth = 0.28, .bias_points = -1.0, .coverage = 0.98};
  const RecoveryCell naive{.truth = 0.28, .bias_points = 16.0};
  found.exploration.push_back({.searched = 8, .corrected = corrected, .naive = naive, .usable = 27.0});
  found.exam.push_back(
      {.truth = 0.14, .fixed_pass = 0.99, .pass = 0.97, .not_yet = 0.0, .repeat = 0.03, .mean_trials = 20});
  found.exam.push_back(
      {.truth = 0.28, .fixed_pass = 0.01, .pass = 0.0, .not_yet = 0.95, .repeat = 0.05, .mean_trials = 22});
  found.power.push_back({10, 0.98});
  found.learning.push_back({40, 0.14, 0.12, 0.01});
  found.changes.push_back({40, 1.45, 0.05, 0.9});
  found.example.mean_before = 0.275;
  found.example.sd_before = 0.09;
  found.example.mean_after = 0.142;
  found.example.sd_after = 0.045;
  found.next_level_us_p99 = 50.0;
  return found;
}

double numberNamedOf(const TrainingMeasurement& found, const std::string& name) {
  for (const auto& [key, value] : trainingPairs(found)) {
    if (key == name) return value;
  }
  return std::nan("");
}

bool allMet(const TrainingMeasurement& found) {
  for (const TrainingBar& bar : trainingBars(found)) {
    if (!bar.met) return false;
  }
  return true;
}

}  // namespace

TEST(TrainingStudy, ACellIsBiasSpreadAndCoverage) {
  const RecoveryCell cell = summariseCell(
      0.20, {reportedAs(0.22, 0.15, 0.3), reportedAs(0.20, 0.21, 0.3), reportedAs(0.24, 0.2, 0.3)}, {20, 30, 40});
  EXPECT_NEAR(cell.bias_points, 2.0, 1e-12);
  EXPECT_NEAR(cell.coverage, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(cell.mean_trials, 30.0, 1e-12);
  const double mean = (std::log(1.1) + std::log(1.2)) / 3.0;
  EXPECT_NEAR(cell.sd_ln, std::sqrt((std::pow(std::log(1.1), 2) + std::pow(std::log(1.2), 2)) / 3.0 - mean * mean),
              1e-12);
}

TEST(TrainingStudy, EveryBarCanBeMissed) {
  EXPECT_TRUE(allMet(someTraining()));
  const auto missed_after = [](const auto& spoil) {
    TrainingMeasurement found = someTraining();
    spoil(found);
    return !allMet(found);
  };
  EXPECT_TRUE(missed_after([](auto& found) { found.methods[0].cells[2].bias_points = -1.1; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.methods[1].cells[0].sd_ln = 0.17; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.methods[0].cells[1].coverage = 0.92; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.methods[0].cells[1].coverage = 0.995; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.methods[0].cells[3].bias_points = -1.6; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.robust[1].cells[0].bias_points = 1.9; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.robust[3].cells[0].coverage = 0.85; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.stop_rules[0].cells[0].mean_trials = 41; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.two_intervals.cells[0].sd_ln = 0.18; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.exploration[0].corrected.bias_points = 3.0; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.exploration[0].naive.bias_points = 5.0; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.exam[0].fixed_pass = 0.97; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.exam[1].pass = 0.03; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.exam[1].repeat = 0.11; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.power[0].power = 0.9; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.example.mean_after = 0.16; }));
  EXPECT_TRUE(missed_after([](auto& found) { found.next_level_us_p99 = 1001.0; }));
}

TEST(TrainingStudy, NumbersForProgramsHaveTheirNames) {
  const TrainingMeasurement found = someTraining();
  EXPECT_EQ(numberNamedOf(found, "bias_points_max"), 0.3) << "of 7 to 28 %";
  EXPECT_EQ(numberNamedOf(found, "sd_ln_t_max"), 0.14);
  EXPECT_EQ(numberNamedOf(found, "coverage_min"), 0.96);
  EXPECT_EQ(numberNamedOf(found, "coverage_max"), 0.96);
  EXPECT_EQ(numberNamedOf(found, "next_level_us_p99"), 50.0);
  EXPECT_NEAR(numberNamedOf(found, "exploration_error_percent"), 100.0 / 28.0, 1e-12);
  EXPECT_EQ(numberNamedOf(found, "exam_pass_14"), 0.99);
  EXPECT_EQ(numberNamedOf(found, "exam_pass_28"), 0.01);
  EXPECT_NEAR(numberNamedOf(found, "effect_pre"), 27.5, 1e-9);
  EXPECT_NEAR(numberNamedOf(found, "effect_post"), 14.2, 1e-9);
}

TEST(TrainingStudy, SaysWhatItsNumbersSay) {
  TrainingMeasurement found = someTraining();
  EXPECT_TRUE(says(trainingFindings(found), "is asked for is reached"));
  EXPECT_TRUE(says(trainingFindings(found), "is worth more than any method"));
  EXPECT_TRUE(says(trainingFindings(found), "which few would notice"));
  found.exploration[0].corrected.bias_points = 9.0;
  found.methods[1].cells[0].sd_ln = 0.3;
  EXPECT_TRUE(says(trainingFindings(found), "is not reached: "));
  EXPECT_TRUE(says(trainingFindings(found), "the correction does not repair it"));
  EXPECT_FALSE(says(trainingFindings(found), "which few would notice"));
}

TEST(TrainingStudy, GivesTheSameForTheSameSeedAndOthersForAnother) {
  TrainingPlan plan = trainingPlan(true, 12);
  const TrainingMeasurement one = measureTraining(plan, {});
  const TrainingMeasurement again = measureTraining(plan, {});
  plan.seed = 2;
  const TrainingMeasurement other = measureTraining(plan, {});
  EXPECT_EQ(one.methods[0].cells[1].bias_points, again.methods[0].cells[1].bias_points);
  EXPECT_EQ(one.example.mean_before, again.example.mean_before);
  EXPECT_NE(one.methods[0].cells[1].bias_points, other.methods[0].cells[1].bias_points);
}

TEST(TrainingStudy, MethodsAskForAsManyTrialsAsTheyAreGiven) {
  for (int method = 0; method <= static_cast<int>(AskedBy::mastery); ++method) {
    const AskedTest test = askedTest(static_cast<AskedBy>(method), usualTrainee(0.14), 25, 7);
    EXPECT_EQ(test.answers.size(), 25u) << method;
    for (const training::Answer& answer : test.answers) EXPECT_EQ(answer.choices, 12);
  }
  EXPECT_THROW(parallelFor(10,
                           [](std::size_t i) {
                             if (i == 5) throw 1;
                           }),
               int);
}

}  // namespace palpate::study

// The numbers of a report: of each trainee (results, learning curve, touch and answers, data quality), and of a class
// (the same of all together, results by occasion).
//
//   TrainingRecord ─ trainingStatistics ─► TrainingStatistics ─► page, JSON (instruments/teach/report)
//
// Pure: the same rows give the same numbers. Each can be had again from the exported tables (tools/check_report.py).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "palpate/training/group_estimate.h"
#include "palpate/training/learning_curve.h"
#include "palpate/training/report/threshold_points.h"

namespace palpate::training {

/// Equipment of a session, and its problems.
struct SessionQuality {
  SessionRow row;
  std::map<std::string, int> events;  ///< by kind; their texts are not shown
};

/// Left-out trials by reason, in the words of the record.
using Reasons = std::map<std::string, int>;

/// The learning curve's point behind a block: the estimate from all blocks of the same device up to it.
struct FilteredPoint {
  std::size_t point = 0;  ///< in TraineeStatistics::points
  ThresholdSummary filtered;
};

/// An exponential through the newest points of one device.
struct FittedLearning {
  std::size_t first = 0;  ///< in TraineeStatistics::curve: session 0 of the fit; the others follow
  LearningFit fit;
};

/// The first and the last test that measured a threshold.
struct TestsCompared {
  std::size_t before = 0, now = 0;  ///< in TraineeStatistics::points
  std::optional<std::string> why_not = {};
  ThresholdChange change = {};  ///< where they may be compared
};

struct TraineeStatistics {
  Uuid id;
  std::vector<ThresholdPoint> points = {};
  std::vector<FilteredPoint> curve = {};
  std::optional<FittedLearning> learning = {};  ///< newest device, three blocks or more
  TrialStatistics tests = {}, practice = {};
  std::optional<TestsCompared> compared = {};  ///< with two tests or more
  std::vector<SessionQuality> sessions = {};
  Reasons excluded = {};
  int changed_results = 0;  ///< blocks whose stored threshold is not what their trials give

  /// The newest test that measured a threshold, else the newest block that has one; null: none has.
  const ThresholdPoint* latest() const;
};

/// An occasion of the class: "pre-test 1", "practice 3".
struct Occasion {
  SessionKind kind = SessionKind::practice;
  int nth = 1;
  Spread medians = {};       ///< spread of the trainees' own thresholds
  GroupEstimate group = {};  ///< estimate for the class behind them
  Reasons verdicts = {};     ///< examinations: how many of each
};

/// The same trainees before and after: of those who have both.
struct ClassChange {
  int trainees = 0;
  GroupChange group;
  int clearly_better = 0, clearly_worse = 0;  ///< single trainees whose change is clear
};

struct ClassStatistics {
  std::vector<Occasion> occasions;  ///< in the order in which the class came to them
  TrialStatistics tests = {}, practice = {};
  std::optional<ClassChange> change;  ///< first and last test of each
  /// Answers of tests against the change in units of each block's own threshold: do all follow one curve?
  std::vector<AnswerBox> collapsed;
};

struct TrainingStatistics {
  std::vector<TraineeStatistics> trainees;
  ClassStatistics all;
};

/// Statistics that cost time and are not needed in every report.
struct StatisticsRequest {
  bool curves = true;  ///< single trainees: filtered and fitted
  bool groups = true;  ///< the class: mean and change
};
TrainingStatistics trainingStatistics(const TrainingRecord& record, const StatisticsRequest& request = {});

}  // namespace palpate::training

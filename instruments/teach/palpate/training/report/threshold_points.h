// The thresholds of one trainee, block by block, from the answers themselves: the points of the learning curve, what
// tests are compared by, and the psychometric function behind each with its band.
//
//   TraineeRecord ─ thresholdPoints ─► ThresholdPoint ... ─► training_statistics.h
//
// A block's own result is in its row too; here it is computed again, so that a report and the record can be held
// against each other (`stored`).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "palpate/training/attention.h"
#include "palpate/training/posterior.h"
#include "palpate/training/report/training_record.h"
#include "palpate/training/report/trial_statistics.h"

namespace palpate::training {

/// Fewer answers than this add little to the prior: no threshold is shown.
inline constexpr int kMinShownAnswers = 10;

/// Test, examination and retention: no feedback, even tissue. Else practice.
bool isTest(SessionKind kind);

struct ThresholdPoint {
  Uuid block;
  SessionKind kind = SessionKind::practice;
  int nth = 1;  ///< number among the trainee's sessions of this kind
  std::int64_t start_ms = 0;
  Method method = Method::marginal_psi;
  ChangeMeaning meaning = ChangeMeaning::compliance;
  std::string protocol_id;
  int protocol_version = 1;
  std::string device;
  int choices = 12;
  bool finished = false;
  Verdict verdict = Verdict::none;
  std::optional<double> level;  ///< mastery
  TrialStatistics trials;
  /// With kMinShownAnswers and where the method measures one.
  std::optional<ThresholdSummary> threshold;
  double slope = 0.0, lapse = 0.0;                           ///< posterior means
  AttentionCheck attention = {};                             ///< where there is a threshold
  double stored = 0.0, stored_low = 0.0, stored_high = 0.0;  ///< from the block's row
  std::vector<Answer> answers;                               ///< counted answers
  Prior prior;
};

/// Oldest first; blocks without any trial are left out, and free exploration.
std::vector<ThresholdPoint> thresholdPoints(const TrainingRecord& record, const TraineeRecord& trainee);

/// A test with a threshold that was made to measure one. An examination stops as soon as it is sure of its verdict, and
/// so knows the threshold less well.
bool measuresThreshold(const ThresholdPoint& point);

/// The trials of a block as they are counted; they point into `block`.
std::vector<ChosenTrial> chosenTrials(const TrainingRecord& record, const BlockRecord& block);

/// The posterior of the answers, from a flat start.
Posterior computePosterior(const ThresholdPoint& point);

/// Probability of a right answer by the posterior: its mean and the middle 95 % of it, change by change.
struct FittedCurve {
  std::vector<double> changes, mean, low, high;
};
FittedCurve fittedCurve(const Posterior& posterior, const std::vector<double>& changes);

/// From 3 % to 100 %, even on a logarithmic axis: where fitted curves are drawn.
std::vector<double> curveChanges();

/// Why two results must not be compared, in words; nothing: they may. A burst of inattention in either is a reason.
std::optional<std::string> notComparable(const ThresholdPoint& a, const ThresholdPoint& b);

}  // namespace palpate::training

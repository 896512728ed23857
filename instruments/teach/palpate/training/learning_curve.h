// How one person's threshold falls over sessions, with how far to trust it.
//
//   answers of each session ─ filteredThresholds ─► a point and a 95 % interval a session
//                           ─ fitLearning ─► an exponential through them, with its band
//   two separate results    ─ changeBetween ─► their difference, or too early to tell
//
// Points are filtered: each knows its own session and those before it, never later ones. Smoothing backwards makes them
// calmer and pulls the first session towards later learning, by 11 to 15 %: the very change that is looked for.
// Based on: Heathcote, Brown, Mewhort, Psychonomic Bulletin & Review 7:185, 2000 (single learners are exponential).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "palpate/training/posterior.h"

namespace palpate::training {

/// Counted answers of one session, in any order.
struct SessionAnswers {
  std::vector<Answer> answers;
};

struct LearningPoint {
  int trials = 0;
  ThresholdSummary threshold;
};

/// How far ln T is believed to wander from one session to the next: a trainee who halves T in six sessions moves by
/// 0.14 a session on average, more in the first.
inline constexpr double kWanderBetweenSessions = 0.2;

/// A point for each session. A session without answers has the estimate of the one before, less surely.
std::vector<LearningPoint> filteredThresholds(std::span<const SessionAnswers> sessions, int choices = 12,
                                              const Prior& prior = {}, double wander = kWanderBetweenSessions);

/// A place on the curve and where 95 % of all curves pass that fit.
struct CurvePoint {
  double session = 0.0;  ///< from 0; between sessions too
  double median = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// T of session n, from 0: end + (start - end) exp(-n / pace).
struct LearningFit {
  CurvePoint start;  ///< T of the first session
  CurvePoint end;    ///< where T would come to rest
  double pace_sessions = 0.0;
  std::vector<CurvePoint> curve;  ///< from the first session to the last
};

/// Fits the answers themselves, not the points. Nothing for fewer than three sessions with answers.
std::optional<LearningFit> fitLearning(std::span<const SessionAnswers> sessions, int choices = 12,
                                       const Prior& prior = {});

/// For planning: the factor by which two separate results with these numbers of trials must differ, about 1.45 for 40
/// and 40 trials, 1.67 for 20 and 20. changeBetween goes by their own intervals instead.
double factorOfRealChange(int trials_before, int trials_after);

/// How two results that share no answers differ (not filtered points): the one rule of summaries, reports and study.
struct ThresholdChange {
  double ratio = 1.0;  ///< now over before: below 1 is better
  double low = 0.0, high = 0.0;
  /// The difference of ln T is larger than what both results leave open together: root of the sum of their half widths'
  /// squares. False: too early to call.
  bool clear = false;
};
ThresholdChange changeBetween(const ThresholdSummary& before, const ThresholdSummary& now);

}  // namespace palpate::training

// How one person's threshold falls over sessions, with how far to trust it.
//
//   answers of each session ─ filteredThresholds ─► a point and a 95 % interval a session
//                           ─ fitLearning ─► an exponential through them, with its band
//   two separate results    ─ changeBetween ─► better, worse, or too early to say
//
// Points are filtered: each knows its own session and those before it, never later ones. Smoothing backwards makes them
// calmer and pulls the first session towards what was learnt since, by 11 to 15 %: the very change that is looked for.
// Based on: Heathcote, Brown, Mewhort, Psychonomic Bulletin & Review 7:185, 2000 (single learners are exponential).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "palpate/training/posterior.h"

namespace palpate::training {

/// What counted in one session, in any order.
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

/// A point for each session. A session without answers knows what the one before it did, less surely.
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

/// By what factor two separate results of so many trials differ for an unchanged person, one time in twenty: 1.45 for
/// 40 and 40 trials, 1.67 for 20 and 20.
double factorOfRealChange(int trials_before, int trials_after);

enum class ChangeVerdict { too_early, better, worse };

/// Of two results that share no answers (not of filtered points), medians compared.
struct RealChange {
  ChangeVerdict verdict = ChangeVerdict::too_early;
  double factor = 1.0;  ///< before over after: over 1 is better
  double needed = 1.0;
};
RealChange changeBetween(const ThresholdSummary& before, int trials_before, const ThresholdSummary& after,
                         int trials_after);

}  // namespace palpate::training

// Whether a trainee paid attention throughout a block, from the answers alone: misses in a row where the trainee's own
// threshold leaves hardly any.
//
//   answers in order, fitted T and slope ─ checkAttention ─► AttentionCheck ─► report; a comparison that is not made
//
// In a burst of inattention answers are guesses, whatever there is to feel, and T rises as if skill had been lost. The
// check adds up, answer by answer, how much likelier a guess explains it than the fitted curve does (a cumulative sum
// that never falls below 0): one miss of an easy change counts much, one near the threshold little, a right answer
// takes some of it back. Based on: Page, "Continuous inspection schemes", Biometrika 41:100, 1954.
#pragma once

#include <span>

#include "palpate/training/posterior.h"

namespace palpate::training {

/// F from which on a change is easy.
inline constexpr double kEasyShare = 0.9;
/// Natural logarithm of how much likelier guesses are; an attentive block reaches it in 1 to 2 of 100
/// (docs/explanation/training-methods.md).
inline constexpr double kBurstEvidence = 5.25;

struct AttentionCheck {
  int easy = 0;           ///< answers to easy changes
  int easy_missed = 0;    ///< easy changes missed
  double evidence = 0.0;  ///< the highest that the sum came to, nat
  bool warned() const { return evidence >= kBurstEvidence; }
};

/// `answers` in the order in which they were given; threshold and slope of the block, for `choices` places.
AttentionCheck checkAttention(std::span<const Answer> answers, int choices, double threshold, double slope);

}  // namespace palpate::training

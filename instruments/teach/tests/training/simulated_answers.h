// A trainee who is a psychometric function: answers as often right as it says.
#pragma once

#include "palpate/base/random.h"
#include "palpate/training/block.h"
#include "palpate/training/psychometric.h"

namespace palpate::training {

inline TrialOutcome simulateAnswer(const Psychometric& trainee, const PlannedTrial& trial, Random& random) {
  const bool right = random.uniform() < probabilityCorrect(trainee, trial.change);
  return {.answer = right ? trial.site : trial.site % 12 + 1, .correct = right};
}

/// A block answered to its end.
inline Block answered(const BlockSettings& settings, const Psychometric& trainee, std::uint64_t seed) {
  Block block(settings, seed);
  Random random(seed + 1'000'000);
  while (!block.finished()) block.answer(simulateAnswer(trainee, block.next(), random));
  return block;
}

}  // namespace palpate::training

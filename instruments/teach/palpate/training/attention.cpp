#include "palpate/training/attention.h"

#include <algorithm>
#include <cmath>

#include "palpate/training/psychometric.h"

namespace palpate::training {

AttentionCheck checkAttention(std::span<const Answer> answers, int choices, double threshold, double slope) {
  AttentionCheck check;
  double sum = 0.0;
  for (const Answer& answer : answers) {
    if (answer.choices < 2) continue;  // nothing to choose
    // Seen through fewer places the same observer has another curve.
    const bool fewer = answer.choices != choices;
    const Psychometric attentive{.threshold = threshold * (fewer ? thresholdFactor(answer.choices, choices) : 1.0),
                                 .slope = slope * (fewer ? idealSlope(answer.choices) / idealSlope(choices) : 1.0),
                                 .guess = 1.0 / answer.choices};
    const double right = probabilityCorrect(attentive, answer.change);
    const double ratio = answer.correct ? attentive.guess / right : (1.0 - attentive.guess) / (1.0 - right);
    sum = std::max(0.0, sum + std::log(ratio));
    check.evidence = std::max(check.evidence, sum);
    const double felt = (right - attentive.guess) / (1.0 - attentive.guess - attentive.lapse);
    if (felt < kEasyShare) continue;
    ++check.easy;
    check.easy_missed += answer.correct ? 0 : 1;
  }
  return check;
}

}  // namespace palpate::training

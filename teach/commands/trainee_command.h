// `palpate train --trainee WORDS`: a simulated trainee instead of a person, without a window.
#pragma once

#include <cstdint>
#include <string>

#include "teach/commands/train_options.h"

namespace palpate::app {

/// What only a simulated trainee can be asked for.
struct TraineeOptions {
  bool programme = false;  ///< the whole course: pre-test, six practices, post-test
  bool fast = false;       ///< without a body
  int trainees = 1;
  double spread = 0.33;  ///< of the thresholds of several: SD of the logarithm
  std::string hand = "thimble,touch_x";
  std::string start = "2026-01-05T09:00:00Z";  ///< of the first sitting
  int most_trials = 0;
};

void addTraineeOptions(CLI::App& command, TraineeOptions& options);

/// The exit code: 0, or that of the signal that ended it. Throws Error.
int runTrainee(const TrainOptions& options, const TraineeOptions& simulated);

}  // namespace palpate::app

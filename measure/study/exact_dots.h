// A pair without pixels: the dots of a synthetic case as a perfect camera program would find them, with a little noise.
//
// A thousand times as fast as pictures: for questions that pixels do not decide.
#pragma once

#include "palpate/measure/measurement.h"
#include "palpate/measure/synthesis/synthetic_pair.h"

namespace palpate::study {

/// `noise_mm`: sd of each place along each axis. Neither strays nor marks under stick or hand are among them.
measure::DotPair exactDots(const measure::SyntheticCase& made, const measure::SyntheticTruth& truth,
                           double noise_mm = 0.05);

}  // namespace palpate::study

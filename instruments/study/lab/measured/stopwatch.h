// Timing of short work in a study: the shortest of some runs, because other load only ever adds.
#pragma once

#include <algorithm>
#include <limits>

#include "palpate/base/stopwatch.h"

namespace palpate::study {

/// Microseconds of the fastest of `runs` calls.
template <class Work>
double shortestMicroseconds(int runs, Work&& work) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const Clock::time_point start = Clock::now();
    work();
    shortest = std::min(shortest, microsecondsSince(start));
  }
  return shortest;
}

}  // namespace palpate::study

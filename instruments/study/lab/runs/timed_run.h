// Times each tick of a run, with nothing else in the loop.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "lab/counters/thread_counts.h"
#include "lab/runs/contact_run.h"
#include "palpate/base/stopwatch.h"

namespace palpate::bench {

namespace detail {

/// Cost of two readings of the clock with nothing between them.
inline double emptyTimerMicroseconds() {
  std::vector<double> samples(2000);
  for (double& sample : samples) {
    const Clock::time_point start = Clock::now();
    sample = microsecondsSince(start);
  }
  return lab::computePercentiles(std::move(samples)).p50;
}

}  // namespace detail

/// Calls `tick(k)` once for each of the times, which it sets, and counts over all of them.
template <class Tick>
lab::ThreadCounts timeTicks(std::vector<double>& us, Tick&& tick) {
  const double empty_us = detail::emptyTimerMicroseconds();
  const lab::ThreadCounts before = lab::countsOfThisThread();
  for (std::size_t k = 0; k < us.size(); ++k) {
    const Clock::time_point start = Clock::now();
    tick(k);
    us[k] = std::max(0.0, microsecondsSince(start) - empty_us);
  }
  return lab::countsSince(before);
}

/// `step` takes a tip and gives a FingerOutput.
template <class Step>
FingerRun timedRun(std::span<const Vec3> tips, Step&& step) {
  FingerRun run;
  run.outputs.resize(tips.size());
  run.tick_us.resize(tips.size());
  run.counts = timeTicks(run.tick_us, [&](std::size_t k) { run.outputs[k] = step(tips[k]); });
  return run;
}

}  // namespace palpate::bench

// Steps a finger along its tips and times each step, with nothing else in the loop.
#pragma once

#include <algorithm>
#include <chrono>
#include <span>
#include <vector>

#include "bench/runs/contact_run.h"
#include "lab/counters/thread_counts.h"

namespace palpate::bench {

namespace detail {

using Clock = std::chrono::steady_clock;

inline double microseconds(Clock::duration d) { return std::chrono::duration<double, std::micro>(d).count(); }

/// What two readings of the clock cost when nothing is between them.
inline double emptyTimerMicroseconds() {
  std::vector<double> samples(2000);
  for (double& sample : samples) {
    const Clock::time_point start = Clock::now();
    sample = microseconds(Clock::now() - start);
  }
  return lab::percentilesOf(std::move(samples)).p50;
}

}  // namespace detail

/// `step` takes a tip and gives a FingerOutput.
template <class Step>
FingerRun timedRun(std::span<const Vec3> tips, Step&& step) {
  const double empty_us = detail::emptyTimerMicroseconds();
  FingerRun run;
  run.outputs.resize(tips.size());
  run.tick_us.resize(tips.size());
  const lab::ThreadCounts before = lab::countsOfThisThread();
  for (std::size_t k = 0; k < tips.size(); ++k) {
    const detail::Clock::time_point start = detail::Clock::now();
    run.outputs[k] = step(tips[k]);
    run.tick_us[k] = std::max(0.0, detail::microseconds(detail::Clock::now() - start) - empty_us);
  }
  run.counts = lab::countsSince(before);
  return run;
}

}  // namespace palpate::bench

// What must not have been asked of the system, where that can be counted. An empty count is no zero: a build that
// counts and says nothing fails.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "lab/counters/thread_counts.h"

namespace palpate::support {

/// `calls` were counted and are none, or this build cannot count.
inline void expectNone(const std::optional<std::uint64_t>& calls, const std::string& of_what = {}) {
  if (lab::kCountsCalls) {
    EXPECT_EQ(calls, 0u) << of_what;
  }
}

/// `work` does not ask for memory on this thread.
template <class Work>
void expectNoAllocation(Work&& work) {
  const lab::ThreadCounts before = lab::countsOfThisThread();
  work();
  expectNone(lab::countsSince(before).allocations);
}

}  // namespace palpate::support

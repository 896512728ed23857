#include "lab/counters/thread_counts.h"

#include "lab/counters/allocation_count.h"
#include "lab/counters/lock_count.h"

#ifdef __linux__
#include <sys/resource.h>
#endif

namespace palpate::lab {

namespace {

std::optional<std::uint64_t> pageFaultsOfThisThread() {
#ifdef __linux__
  rusage usage{};
  if (getrusage(RUSAGE_THREAD, &usage) == 0) return static_cast<std::uint64_t>(usage.ru_minflt + usage.ru_majflt);
#endif
  return std::nullopt;
}

std::optional<std::uint64_t> difference(std::optional<std::uint64_t> after, std::optional<std::uint64_t> before) {
  if (!after || !before) return std::nullopt;
  return *after - *before;
}

}  // namespace

ThreadCounts countsOfThisThread() { return {allocationsOfThisThread(), locksOfThisThread(), pageFaultsOfThisThread()}; }

ThreadCounts countsSince(const ThreadCounts& before) {
  const ThreadCounts now = countsOfThisThread();
  return {difference(now.allocations, before.allocations), difference(now.locks, before.locks),
          difference(now.page_faults, before.page_faults)};
}

}  // namespace palpate::lab

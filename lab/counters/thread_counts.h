// What a stretch of work asked of the system: a servo tick must ask for nothing.
#pragma once

#include <cstdint>
#include <optional>

namespace palpate::lab {

/// Each is empty where it cannot be counted (see allocation_count.h, lock_count.h).
struct ThreadCounts {
  std::optional<std::uint64_t> allocations;
  std::optional<std::uint64_t> locks;
  std::optional<std::uint64_t> page_faults;  ///< minor and major; Linux only
};

/// Of the calling thread since it started.
ThreadCounts countsOfThisThread();

/// Of the calling thread since `before` was taken on it.
ThreadCounts countsSince(const ThreadCounts& before);

}  // namespace palpate::lab

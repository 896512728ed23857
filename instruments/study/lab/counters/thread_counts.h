// Counts system requests of a stretch of work - memory, locks, pages: a servo tick must make none.
//
// Linked into a program, thread_counts.cpp puts itself in front of the C library's allocator and locks, and counts the
// calls of each thread. Nothing can be counted where a sanitizer is there already, or where the C library is not glibc,
// whose internal names the calls go on to: those counts are empty, which is not zero.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define PALPATE_SANITIZED 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PALPATE_SANITIZED 1
#endif

namespace palpate::lab {

/// Whether this build counts allocations and locks.
#if defined(__GLIBC__) && !defined(PALPATE_SANITIZED)
#define PALPATE_CAN_INTERPOSE 1
inline constexpr bool kCountsCalls = true;
#else
inline constexpr bool kCountsCalls = false;
#endif

/// Allocations made by the calling thread since it started: operator new, malloc and their relatives.
std::optional<std::uint64_t> allocationsOfThisThread();

/// Mutexes and read-write locks that the calling thread has requested since it started, whether it got them or not.
/// std::mutex and its relatives are these; a condition variable cannot be waited for without one.
std::optional<std::uint64_t> locksOfThisThread();

struct ThreadCounts {
  std::optional<std::uint64_t> allocations;
  std::optional<std::uint64_t> locks;
  std::optional<std::uint64_t> page_faults;  ///< minor and major; Linux only
};

/// Counts of the calling thread since it started.
ThreadCounts countsOfThisThread();

/// Counts of the calling thread since `before` was taken on it.
ThreadCounts countsSince(const ThreadCounts& before);

}  // namespace palpate::lab

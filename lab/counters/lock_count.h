// Counts locks, so that a tick can be shown to take none.
#pragma once

#include <cstdint>
#include <optional>

namespace palpate::lab {

/// Mutexes and read-write locks that the calling thread has asked for since it started, whether it got them or not.
/// std::mutex and its relatives are these; a condition variable cannot be waited for without one. Nothing where they
/// cannot be counted: with a sanitizer and with a C library other than glibc.
std::optional<std::uint64_t> locksOfThisThread();

}  // namespace palpate::lab

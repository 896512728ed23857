// Counts heap allocations, so that a tick can be shown to make none.
#pragma once

#include <cstdint>
#include <optional>

namespace palpate::lab {

/// Allocations made by the calling thread since it started: operator new, malloc and their relatives. Nothing where
/// they cannot be counted: with a sanitizer (which replaces malloc itself) and with a C library other than glibc.
std::optional<std::uint64_t> allocationsOfThisThread();

}  // namespace palpate::lab

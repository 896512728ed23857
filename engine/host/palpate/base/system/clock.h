// The clock that a maker's runtime (OpenXR) knows how to turn into its own time.
#pragma once

#include <cstdint>
#include <ctime>

namespace palpate::system {

#ifdef _WIN32
using RawClock = std::int64_t;  // the performance counter
#else
using RawClock = std::timespec;  // CLOCK_MONOTONIC
#endif

/// False where the system has none.
bool readRawClock(RawClock& clock) noexcept;

}  // namespace palpate::system

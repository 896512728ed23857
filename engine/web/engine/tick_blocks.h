// The duration of a tick, in WebAssembly (bench_exports.cpp) and in native code (engine/web/tests/reference.cpp): timed
// by the same lines, or the two could not be compared.
#pragma once

#include <algorithm>
#include <chrono>
#include <span>
#include <vector>

#include "palpate/contact/finger.h"
#include "palpate/contact/surface.h"

namespace palpate::web {

/// Ticks between two readings of the clock. A single one is not timed: a call out of WebAssembly takes half as long,
/// and varies from run to run.
inline constexpr std::size_t kTicksOfBlock = 20;

/// A new finger along the tips, into `outputs` (one per tip); returns the mean time of a tick, us, of each block.
inline std::vector<double> timeBlocks(const contact::Surface& surface, const contact::FingerSettings& settings,
                                      std::span<const Vec3> tips, std::span<contact::FingerOutput> outputs) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> tick_us;
  contact::FingerState state;
  for (std::size_t from = 0; from < tips.size(); from += kTicksOfBlock) {
    const std::size_t end = std::min(tips.size(), from + kTicksOfBlock);
    const Clock::time_point before = Clock::now();
    for (std::size_t i = from; i < end; ++i) outputs[i] = contact::step(surface, settings, state, tips[i]);
    const std::chrono::duration<double, std::micro> passed = Clock::now() - before;
    tick_us.push_back(passed.count() / static_cast<double>(end - from));
  }
  return tick_us;
}

}  // namespace palpate::web

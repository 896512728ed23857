// Cost of a tick with many fingers on one world, as learning and sweeps need them, against one finger in a plain loop,
// and whether threads hold each other up.
//
// Every finger goes along the same path, from a place that it came to along it. A batch moves each a few ticks at a
// time, one finger after the other, as a vectorised environment does; a rollout takes each along its whole way first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "palpate/base/progress.h"
#include "palpate/scene/world.h"

namespace palpate::bench {

struct BatchSettings {
  std::size_t fingers = 1024;
  std::size_t action_ticks = 10;  ///< one finger's ticks in a batch, before the next
  std::size_t threads = 2;        ///< compared with one
  double seconds = 4.0;           ///< to measure for; each pass is made twice at least
};

/// Rates of one order of the ticks, in the fastest pass: other programs only slow it down.
struct BatchRates {
  double one_thread_ticks_per_s = 0.0;
  double ticks_per_s = 0.0;  ///< all threads together
  double scaling() const { return one_thread_ticks_per_s > 0.0 ? ticks_per_s / one_thread_ticks_per_s : 0.0; }
};

struct BatchFigures {
  std::size_t triangles = 0;
  std::size_t pass_ticks = 0;       ///< all fingers together
  double touching = 0.0;            ///< share of a pass's ticks
  double native_ticks_per_s = 0.0;  ///< one finger alone on one thread
  BatchRates batch, rollout;
  std::size_t different = 0;  ///< fingers that felt otherwise with more threads, to the bit
  std::optional<std::uint64_t> allocations = 0, locks = 0;  ///< during all ticks
};

/// `path`: one tip per tick, repeated. Throws Error where settings and world do not suit.
BatchFigures measureBatch(const scene::World& world, const contact::FingerSettings& finger, std::span<const Vec3> path,
                          const BatchSettings& settings, const Progress& progress = {});

}  // namespace palpate::bench

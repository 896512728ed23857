// Costs of a servo tick other than contact: guards and passivity, a recording, and many fingers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "palpate/base/progress.h"
#include "palpate/device/finger_path.h"
#include "palpate/scene/world.h"

namespace palpate::bench {

// Cost of guards and passivity in a servo tick: the product's tick against one that sends the contact's force as it is.

/// Cost for one tick of one finger, us.
struct SafetyCost {
  double safety_us = 0.0;  ///< guards, start rule, toe, passivity, clamp, rate guard
  double tick_us = 0.0;    ///< the whole tick with them
  std::size_t blocks = 0;  ///< compared, each with the same block of the other
  double ratio() const { return tick_us > 0.0 ? safety_us / tick_us : 0.0; }
};

/// Runs blocks of the paths' ticks in turn with and without, each with its own fingers, for about `seconds`; the
/// medians. Devices take their forces, so that the controller has a loop to look after.
SafetyCost measureSafety(const scene::World& world, const device::FingerPaths& paths, double seconds);

// Cost of a recording: in the servo thread, on the disk, in a replay, in a search.

struct RecordingRunSettings {
  double seconds = 20.0;    ///< recorded and felt again, of simulated time
  double long_hours = 0.5;  ///< length of the recording that is searched
  std::filesystem::path folder;
};

struct RecordingRun {
  std::size_t fingers = 0;
  double record_us_per_tick = 0.0;  ///< handing a tick of all fingers to the recorder
  double tick_us = 0.0;             ///< the same ticks, of all fingers
  std::size_t blocks = 0;           ///< compared
  double bytes_per_tick = 0.0;      ///< all fingers', in the finished file
  double write_mb_per_s = 0.0;      ///< bytes a second of simulated time
  double write_times_real_time = 0.0;
  double replay_times_real_time = 0.0;
  bool identical = false;
  double long_hours = 0.0;
  double long_mb = 0.0;
  double open_s = 0.0;  ///< worst of several openings of the long recording
  double seek_s = 0.0;  ///< opening it and reading the first tick at a random time, the worst
  std::uint64_t dropped = 0;
};

/// Records the world's fingers on their paths, again and again. Throws Error for a folder that cannot be written.
RecordingRun measureRecording(const scene::World& world, const device::FingerPaths& paths,
                              const RecordingRunSettings& settings, const Progress& progress = {});

// Cost of a tick with many fingers on one world, as learning and sweeps need them, against one finger in a plain loop,
// and whether threads hold each other up.
//
// Every finger goes along the same path, from a place that it came to along it. A batch moves each a few ticks at a
// time, one finger after the other, as a vectorised environment does; a rollout takes each along its whole way first.

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

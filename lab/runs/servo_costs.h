// What else than contact costs a servo tick: guards and passivity, and a recording.
#pragma once

#include <cstddef>
#include <filesystem>

#include "palpate/base/progress.h"
#include "palpate/device/finger_path.h"
#include "palpate/scene/world.h"

namespace palpate::bench {

// What guards and passivity cost a servo tick: the product's tick beside one that sends the contact's force as it is.

/// Of one tick of one finger, us.
struct SafetyCost {
  double safety_us = 0.0;  ///< guards, start rule, toe, passivity, clamp, rate guard
  double tick_us = 0.0;    ///< the whole tick with them
  std::size_t blocks = 0;  ///< compared, each with the same block of the other
  double ratio() const { return tick_us > 0.0 ? safety_us / tick_us : 0.0; }
};

/// Runs blocks of the paths' ticks in turn with and without, each with its own fingers, for about `seconds`; the
/// medians. Devices take their forces, so that the controller has a loop to look after.
SafetyCost measureSafety(const scene::World& world, const device::FingerPaths& paths, double seconds);

// What a recording costs: in the servo thread, on the disk, in a replay, in a search.

struct RecordingRunSettings {
  double seconds = 20.0;    ///< recorded and felt again, of simulated time
  double long_hours = 0.5;  ///< length of the recording that is searched
  std::filesystem::path folder;
};

struct RecordingRun {
  std::size_t fingers = 0;
  double record_us_per_tick = 0.0;  ///< of all fingers: handing a tick to the recorder
  double tick_us = 0.0;             ///< the same ticks, of all fingers
  std::size_t blocks = 0;           ///< compared
  double bytes_per_tick = 0.0;      ///< of all fingers, in the finished file
  double write_mb_per_s = 0.0;      ///< bytes a second of simulated time
  double write_times_real_time = 0.0;
  double replay_times_real_time = 0.0;
  bool identical = false;
  double long_hours = 0.0;
  double long_mb = 0.0;
  double open_s = 0.0;  ///< of the long recording, the worst of several
  double seek_s = 0.0;  ///< opening it and reading the first tick at a random time, the worst
  std::uint64_t dropped = 0;
};

/// Records the world's fingers on their paths, again and again. Throws Error for a folder that cannot be written.
RecordingRun measureRecording(const scene::World& world, const device::FingerPaths& paths,
                              const RecordingRunSettings& settings, const Progress& progress = {});

}  // namespace palpate::bench

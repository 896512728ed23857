// Cost of a recording: in the servo thread, on the disk, in a replay, in a search.
#pragma once

#include <filesystem>

#include "palpate/base/json.h"
#include "palpate/base/progress.h"
#include "palpate/device/finger_path.h"
#include "palpate/scene/world.h"

namespace palpate::bench {

struct RecordingRunSettings {
  double seconds = 20.0;    ///< recorded and felt again, of simulated time
  double long_hours = 0.5;  ///< length of the recording that is searched
  std::filesystem::path folder;
};

/// Records the world's fingers on their paths, again and again: record_us_per_tick, for handing a tick of all fingers
/// to the recorder, beside tick_us; the finished file; replay and whether it is identical; open_s and seek_s, the worst
/// of several openings of the long recording, alone and with the first tick at a random time. Throws Error for a folder
/// that cannot be written.
Json measureRecording(const scene::World& world, const device::FingerPaths& paths, const RecordingRunSettings& settings,
                      const Progress& progress = {});

}  // namespace palpate::bench

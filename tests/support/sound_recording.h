// A recording that nothing is wrong with, for what is done to it.
#pragma once

#include <filesystem>

#include "palpate/trace/recording_writer.h"

namespace palpate::support {

/// 400 ticks of one finger.
inline void writeSoundRecording(const std::filesystem::path& file) {
  trace::RecordingWriter writer(
      file, {.started_utc = "2026-11-21T12:00:00Z", .software = "test", .machine = "bench", .notes = {}, .tags = {}},
      {{"index", "mouse"}});
  writer.add(trace::RecordingWorld{"[body]\n", "/", "torso", 1, 1, {{"", ""}}});
  for (std::uint64_t tick = 0; tick < 400; ++tick) {
    trace::Sample sample;
    sample.tick = tick;
    writer.add(sample);
  }
  writer.finish("done");
}

}  // namespace palpate::support

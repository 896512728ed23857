// Shared by the commands of recordings: contents of a recording, as text and as JSON, and --from, --to.
#pragma once

#include <filesystem>
#include <limits>
#include <string>

#include "cli/kit/options.h"
#include "palpate/base/json.h"
#include "palpate/trace/recording_reader.h"

namespace palpate::app {

/// Seconds of a recording.
struct TimeSpan {
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
};
void addTimeSpan(Command& command, TimeSpan& span);
/// Throws Error where it ends before it begins.
trace::TickSpan toTickSpan(const TimeSpan& span, double ticks_per_s);

/// By its name, or by its first bytes: an SQLite file.
bool isRecordingFile(const std::filesystem::path& file);

std::string recordingInfo(const std::filesystem::path& file);
Json recordingInfoJson(const std::filesystem::path& file);

/// "12.3 s, index, middle; ended: done"
std::string recordingLine(const trace::RecordingFacts& facts);
Json factsJson(const trace::RecordingFacts& facts);

}  // namespace palpate::app

// Recordings made of recordings: a part of one, several after one another. Nothing that was recorded changes but its
// place in time and the number of its world; what that does to a replay is said in the file.
//
//   RecordingReader ─ ticks, events, attachments, worlds that are needed ─► RecordingWriter, beside the target
//
// Two kinds of events mark where time is missing, for a replay (engine/recording_replay.h): "trim", where
// every finger was at rest, so that all forces are proven from there; "cut", where one was not (that finger, or all):
// nothing can be proven until it rests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/trace/recording_reader.h"

namespace palpate::trace {

/// Which part of a recording to copy, and where to.
struct CopySettings {
  TickSpan span;
  std::int64_t later_ticks = 0;   ///< that everything is moved by
  std::uint32_t forgets = 0;      ///< ForgetBits, in the first sample of each finger
  std::uint32_t first_world = 0;  ///< number of this recording's first world in the copy
  bool has_worlds = false;        ///< the writer has them already, all of them
  // Change what is copied; may be empty.
  std::function<void(RecordingWorld& world)> change_world;
  std::function<void(RecordingEvent& event)> change_event;
  bool keeps_files = true;  ///< attachments of the kind file
};

struct Copied {
  std::uint64_t samples = 0;
  std::uint64_t first_tick = 0;  ///< of the copy
  std::uint64_t last_tick = 0;
  std::uint32_t worlds = 0;
};

/// Adds ticks, events, attachments of the span and the worlds that they need. Files that scenes name are kept whatever
/// the span is. Throws Error.
Copied copyInto(RecordingWriter& writer, RecordingReader& recording, const CopySettings& settings,
                const Progress& progress = {});

/// Throws Error where writing the one would replace the other, whatever their names.
void refuseSame(const std::filesystem::path& target, const std::filesystem::path& source);

/// Leaves a recording made from others complete or not at all, even if the program is ended midway. Must outlive its
/// writer.
class WholeOrNothing {
 public:
  WholeOrNothing() = default;
  ~WholeOrNothing();
  WholeOrNothing(const WholeOrNothing&) = delete;
  WholeOrNothing& operator=(const WholeOrNothing&) = delete;
  void watch(const RecordingWriter& writer) { partial_ = writer.partial(); }
  void commit() { partial_.clear(); }

 private:
  std::filesystem::path partial_;
};

struct TrimSettings {
  TickSpan span;
  /// Begin exactly there, also in the middle of a contact. Otherwise where every finger was last at rest before.
  bool exact = false;
};

struct Trimmed {
  Copied copied;
  std::uint64_t earlier_ticks = 0;       ///< than was asked for
  std::vector<std::string> not_at_rest;  ///< fingers that nothing can be proven of until they rest
};

/// Copies a span of a recording; ticks keep their numbers. Throws Error if the span holds no tick.
Trimmed trim(RecordingReader& recording, const TrimSettings& settings, const std::filesystem::path& target,
             const Progress& progress = {});

struct Joined {
  std::uint64_t samples = 0;
  std::uint64_t last_tick = 0;
  std::vector<std::uint64_t> begins;  ///< first tick of each, in the joined recording
  std::vector<std::string> notes;
};

/// Recordings one after another, each beginning with the tick after the last one of the one before, with nothing
/// touched and nothing remembered. Throws Error for other fingers, another rate, and files of the same name that
/// differ.
Joined join(const std::vector<std::filesystem::path>& files, const std::filesystem::path& target,
            const Progress& progress = {});

}  // namespace palpate::trace

// A recording as it happens, into a file that stays readable whatever ends it: header, worlds, fingers, every tick,
// events.
//
//   samples, events ─► RecordingWriter ─ a part every 150 ms, one transaction ─► SQLite, WAL ─► RecordingReader
//
// Until it is finished it is NAME.partial, like every file that is written; what a killed program had handed over up to
// its last part is in there. One thread at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/output_file.h"
#include "palpate/trace/database.h"
#include "palpate/trace/sample.h"

namespace palpate::trace {

struct RecordingHeader {
  std::string started_utc;  ///< 2026-11-21T18:45:00Z
  std::string software;
  std::string machine;
  double ticks_per_s = 1000.0;
  std::string notes;
  std::string tags;  ///< words with blanks between
};

/// A finger, and the settings that it is felt with in a world.
struct RecordingFinger {
  std::string name;
  std::string device;
  std::string capabilities = {};  ///< of the device: "key = value", a line each
  std::string placed = {};        ///< how the device's space lies in the body, likewise
};
struct RecordingSettings {
  std::string contact;  ///< "key = value", a line each
  std::string limiter;
};

struct RecordingWorld {
  std::string scene;   ///< the scene file's text
  std::string folder;  ///< that files in it are relative to
  std::string body;
  std::uint64_t triangles = 0;
  std::uint64_t hash = 0;                  ///< of skin and stiffness
  std::vector<RecordingSettings> fingers;  ///< one a finger
};

struct RecordingEvent {
  std::uint64_t tick = 0;
  std::optional<std::uint32_t> finger;
  std::string kind;  ///< mark, world, device, button, safety, dropped, note, cut
  std::string text;
};

// Kinds of events that mark where time is missing, for a replay (engine/recording_replay.h).

inline constexpr std::string_view kTrimEvent = "trim";
inline constexpr std::string_view kCutEvent = "cut";
inline constexpr std::string_view kJoinEvent = "join";
inline constexpr std::string_view kDroppedEvent = "dropped";  ///< as a cut of all fingers

/// The kind of attachment that is a file of the scene; its name is the one that the scene names.
inline constexpr std::string_view kCarriedFile = "file";

struct RecordingAttachment {
  std::uint64_t tick = 0;
  std::string kind;   ///< picture, sound, file
  std::string name;   ///< of kind file: as the scene names it
  std::string media;  ///< image/png, audio/wav, ...
  std::string data;
};

class RecordingWriter {
 public:
  /// Begins the file beside its target. Throws Error where it cannot be made.
  RecordingWriter(const std::filesystem::path& file, const RecordingHeader& header,
                  const std::vector<RecordingFinger>& fingers);
  /// Leaves the file as it is, if `finish` did not: under its partial name, readable, without an end.
  ~RecordingWriter();

  // Each throws Error when the disk is full or gone; what was written before stays readable.

  /// World number 0, 1, ... in the order in which they are added; samples name it.
  void add(const RecordingWorld& world);
  /// In the order of their ticks. Written once a part is full.
  void add(const Sample& sample);
  void add(const RecordingEvent& event);
  /// At once.
  void add(const RecordingAttachment& attachment);
  /// Writes what has been collected.
  void flush();
  /// Whatever ended before the tick goes, but what later ticks need: a file that holds the last hour. An event says
  /// that it begins in the middle.
  void forgetBefore(std::uint64_t tick);
  /// Samples that found no room on their way here, so far: told in the header, and as an event.
  void setDropped(std::uint64_t dropped);
  /// The last call: what ended it ("done", a signal's name, a fault). Gives the file its name, in place of an earlier
  /// one; it stands alone. `ended_utc`: when, of a recording that is made of others; empty: now.
  void finish(std::string_view ended_by, std::string_view ended_utc = {});

  /// The last call: nothing is left of it.
  void discard();

  std::uint64_t samples() const { return samples_; }
  /// Where it is until then.
  const std::filesystem::path& partial() const { return file_.partial(); }

 private:
  struct Impl;
  struct WrittenPart {
    std::int64_t part;
    std::uint64_t first_tick;
    std::uint64_t last_tick;
    std::uint64_t samples;
    std::uint32_t world;  ///< the first that it needs
  };
  OutputFile file_;
  std::unique_ptr<Impl> impl_;
  std::vector<std::vector<Sample>> waiting_;  ///< one a finger
  std::vector<RecordingEvent> events_;
  std::deque<WrittenPart> written_;  ///< that may be forgotten, the oldest first
  std::int64_t part_ = 0;
  std::int64_t worlds_ = 0;
  std::uint64_t part_ticks_;
  std::uint64_t samples_ = 0;
  std::uint64_t dropped_ = 0;
};

/// A finished copy of a recording that is being written, or of any other, with what has been written of it by now;
/// ended by `ended_by` where it had no end. Its writer continues meanwhile. Throws Error.
void copyRecording(const std::filesystem::path& recording, const std::filesystem::path& copy,
                   std::string_view ended_by);

/// Now, as started_utc has it.
std::string utcNow();

}  // namespace palpate::trace

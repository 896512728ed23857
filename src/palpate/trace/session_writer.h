// A session as it happens, into a file that stays readable whatever ends it: header, worlds, fingers, every tick,
// events.
//
//   samples, events ─► SessionWriter ─ a part every 150 ms, one transaction ─► SQLite, WAL ─► SessionReader
//
// Until it is finished it is NAME.partial, like every file that is written; what a killed program had handed over up to
// its last part is in there. One thread at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/output_file.h"
#include "palpate/trace/database.h"
#include "palpate/trace/sample.h"

namespace palpate::trace {

struct SessionHeader {
  std::string started_utc;  ///< 2026-11-21T18:45:00Z
  std::string software;
  std::string machine;
  double ticks_per_s = 1000.0;
  std::string notes;
  std::string tags;  ///< words with blanks between
};

/// What a finger is, and in a world what it is felt with.
struct SessionFinger {
  std::string name;
  std::string device;
};
struct SessionSettings {
  std::string contact;  ///< "key = value", a line each
  std::string limiter;
};

struct SessionWorld {
  std::string scene;   ///< the scene file's text
  std::string folder;  ///< that files in it are relative to
  std::string body;
  std::uint64_t triangles = 0;
  std::uint64_t hash = 0;                ///< of skin and stiffness
  std::vector<SessionSettings> fingers;  ///< one a finger
};

struct SessionEvent {
  std::uint64_t tick = 0;
  std::optional<std::uint32_t> finger;
  std::string kind;  ///< mark, world, device, safety, dropped, note
  std::string text;
};

class SessionWriter {
 public:
  /// Begins the file beside its target. Throws Error where it cannot be made.
  SessionWriter(const std::filesystem::path& file, const SessionHeader& header,
                const std::vector<SessionFinger>& fingers);
  /// Leaves the file as it is, if `finish` did not: under its partial name, readable, without an end.
  ~SessionWriter();

  // Each throws Error when the disk is full or gone; what was written before stays readable.

  /// World number 0, 1, ...; samples name it.
  void add(const SessionWorld& world);
  /// In the order of their ticks. Written once a part is full.
  void add(const Sample& sample);
  void add(const SessionEvent& event);
  /// Writes what has been collected.
  void flush();
  /// Samples that found no room on their way here, so far: told in the header, and as an event.
  void setDropped(std::uint64_t dropped);
  /// The last call: what ended it ("done", a signal's name, a fault). Gives the file its name, in place of an earlier
  /// one; it stands alone.
  void finish(std::string_view ended_by);

  std::uint64_t samples() const { return samples_; }
  /// Where it is until then.
  const std::filesystem::path& partial() const { return file_.partial(); }

 private:
  struct Open;
  OutputFile file_;
  std::unique_ptr<Open> open_;
  std::vector<std::vector<Sample>> waiting_;  ///< one a finger
  std::vector<SessionEvent> events_;
  std::int64_t part_ = 0;
  std::int64_t worlds_ = 0;
  std::uint64_t part_ticks_;
  std::uint64_t samples_ = 0;
  std::uint64_t dropped_ = 0;
};

/// Now, as started_utc has it.
std::string utcNow();

}  // namespace palpate::trace

// Recovers what can still be read of a damaged recording file into a new one, and lists what was lost.
//
//   file, its log ─ SqlitePages ─► rows by their shape ─► blocks whose checksum holds ─► RecordingWriter
//                                                    └──► what is missing ─► RecordingRepair, events "cut"
//
// The file itself is only read. A sample comes out with every bit that it went in with, or not at all: blocks have
// checksums. Texts of header, worlds and events have none.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "palpate/base/progress.h"

namespace palpate::trace {

/// Ticks of a finger, both ends included, that are not in the new file.
struct MissingTicks {
  std::uint32_t finger = 0;
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  std::uint64_t count = 0;  ///< of samples
};

struct RecordingRepair {
  double ticks_per_s = 1000.0;
  std::vector<std::string> fingers;
  std::uint64_t samples = 0;  ///< salvaged
  std::uint64_t blocks = 0;   ///< salvaged
  std::uint64_t events = 0;
  std::uint64_t attachments = 0;
  std::uint64_t worlds = 0;
  // Losses.
  std::uint64_t blocks_lost = 0;
  std::vector<MissingTicks> lost;
  std::uint64_t bytes_missing = 0;  ///< at the file's end
  bool header_lost = false;         ///< when it began, rate, notes
  std::vector<std::string> other;   ///< worlds, names of fingers, attachments: a line each
  std::vector<std::string> notes;
  /// Ticks that were never recorded: the loop, or the way to the file, was too slow.
  std::vector<MissingTicks> gaps;

  std::uint64_t samplesLost() const;
  bool nothingLost() const;
};

/// Throws Error (file: cause) where there is nothing to salvage, and for the same file twice.
RecordingRepair repairRecording(const std::filesystem::path& file, const std::filesystem::path& target,
                                const Progress& progress = {});

}  // namespace palpate::trace

// Reads a recording file back, also while it is written and after its writer was killed: facts at once, ticks as a
// stream.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "palpate/trace/recording_writer.h"
#include "palpate/trace/sample_block.h"

namespace palpate::trace {

struct RecordingFacts {
  RecordingHeader header;
  std::string ended_utc;  ///< empty: it has no end
  std::string ended_by;
  std::uint64_t dropped = 0;
  std::vector<RecordingFinger> fingers;
  std::uint64_t first_world = 0;  ///< not 0 where the beginning was forgotten
  std::uint64_t worlds = 0;       ///< how many
  std::uint64_t samples = 0;
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  std::uint64_t events = 0;
  std::uint64_t attachments = 0;
  std::int64_t version = 0;  ///< of the file
  double seconds() const {
    return samples == 0 ? 0.0 : static_cast<double>(last_tick - first_tick + 1) / header.ticks_per_s;
  }
};

/// A span of ticks, both ends included.
struct TickSpan {
  std::uint64_t from = 0;
  std::uint64_t to = std::numeric_limits<std::uint64_t>::max();
};

/// By its name: a recording, "run.session", or one that was not finished, "run.session.2.partial".
bool isRecording(const std::filesystem::path& file);

class RecordingReader {
 public:
  /// Throws Error (file: cause) if the file is not a recording, is damaged or has a later version.
  explicit RecordingReader(const std::filesystem::path& file);

  const RecordingFacts& facts() const { return facts_; }
  /// Throws Error where there is none.
  RecordingWorld world(std::uint64_t number);
  std::vector<RecordingEvent> events(const TickSpan& span = {});
  /// Calls `visit` with each, in the order of their ticks.
  void forEachAttachment(const TickSpan& span, const std::function<void(const RecordingAttachment&)>& visit);

  /// Calls `visit` with the samples of a tick, those of its fingers in their order, tick by tick, until it returns
  /// false. Memory for one part only. Throws Error naming the block that is damaged.
  void forEachTick(const TickSpan& span, const std::function<bool(std::span<const Sample>)>& visit);

  /// Columns of every block, in the file's order.
  std::span<const SampleColumn> columns() const { return columns_; }
  /// The blocks that cannot be read, and why.
  std::vector<std::pair<std::int64_t, std::string>> damagedBlocks();

 private:
  using Part = std::map<std::uint64_t, std::vector<Sample>>;  ///< by tick
  void readFacts();
  void readColumns();
  Part readPart(std::int64_t part, const TickSpan& span);

  Database database_;
  RecordingFacts facts_;
  std::vector<SampleColumn> columns_;  ///< of the blocks, in the file's order
};

}  // namespace palpate::trace

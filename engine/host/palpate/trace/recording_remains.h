// Rows found in a damaged recording file: recognised by their shape, not yet put together.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/trace/sqlite_pages.h"

namespace palpate::trace {

/// A block by what its row or an index says of it.
struct BlockRemains {
  std::optional<std::int64_t> part;
  std::optional<std::uint32_t> finger;
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  std::uint64_t rows = 0;
  std::vector<CellPlace> places;  ///< of whole rows of this id; empty: its bytes are lost
  bool is_known = false;          ///< its ticks are
};

struct RecordingRemains {
  std::optional<RecordingFacts> facts;  ///< header and end
  std::map<std::int64_t, RecordingFinger> fingers;
  std::map<std::int64_t, RecordingWorld> worlds;                                ///< without the fingers' settings
  std::map<std::pair<std::int64_t, std::int64_t>, RecordingSettings> settings;  ///< world, finger
  std::map<std::int64_t, SampleColumn> columns;
  std::map<std::int64_t, RecordingEvent> events;
  std::map<std::int64_t, CellPlace> attachments;
  std::map<std::int64_t, std::string> lost_attachments;  ///< their names
  std::map<std::int64_t, BlockRemains> blocks;
};

RecordingRemains remainsIn(SqlitePages& pages, const Progress& progress);

// Both throw Error for a row that is not whole.
RecordingAttachment attachmentOf(const RawRow& row);
std::vector<Sample> samplesOf(const RawRow& row, std::span<const SampleColumn> columns);

}  // namespace palpate::trace

// What lies about in a damaged session file: rows that were told apart by their shape, not yet put together.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/trace/session_reader.h"
#include "palpate/trace/sqlite_pages.h"

namespace palpate::trace {

/// A block by what its row or an index says of it.
struct BlockRemains {
  std::int64_t id = 0;
  std::optional<std::int64_t> part;
  std::optional<std::uint32_t> finger;
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  std::uint64_t rows = 0;
  std::vector<CellPlace> places;  ///< of whole rows of this id; empty: its bytes are lost
  bool is_known = false;          ///< its ticks are
};

struct SessionRemains {
  std::optional<SessionFacts> facts;  ///< header and end
  std::map<std::int64_t, SessionFinger> fingers;
  std::map<std::int64_t, SessionWorld> worlds;                                ///< without the fingers' settings
  std::map<std::pair<std::int64_t, std::int64_t>, SessionSettings> settings;  ///< world, finger
  std::map<std::int64_t, SampleColumn> columns;
  std::map<std::int64_t, SessionEvent> events;
  std::map<std::int64_t, CellPlace> attachments;
  std::map<std::int64_t, std::string> lost_attachments;  ///< their names
  std::map<std::int64_t, BlockRemains> blocks;
};

SessionRemains remainsIn(SqlitePages& pages, const Progress& progress);

// Of such a row. Each throws Error for one that is not whole.
SessionAttachment attachmentOf(const RawRow& row);
std::vector<Sample> samplesOf(const RawRow& row, std::span<const SampleColumn> columns);

}  // namespace palpate::trace

// Reads a session file back, also while it is written and after its writer was killed: facts at once, ticks as a
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

#include "palpate/trace/session_writer.h"

namespace palpate::trace {

struct SessionFacts {
  SessionHeader header;
  std::string ended_utc;  ///< empty: it has no end
  std::string ended_by;
  std::uint64_t dropped = 0;
  std::vector<SessionFinger> fingers;
  std::uint64_t worlds = 0;
  std::uint64_t samples = 0;
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  std::uint64_t events = 0;
  double seconds() const {
    return samples == 0 ? 0.0 : static_cast<double>(last_tick - first_tick + 1) / header.ticks_per_s;
  }
};

/// A span of ticks, both ends included.
struct TickSpan {
  std::uint64_t from = 0;
  std::uint64_t to = std::numeric_limits<std::uint64_t>::max();
};

class SessionReader {
 public:
  /// Throws Error (file: cause) for what is no session, is damaged, or of a later version.
  explicit SessionReader(const std::filesystem::path& file);

  const SessionFacts& facts() const { return facts_; }
  /// Throws Error where there is none.
  SessionWorld world(std::uint64_t number);
  std::vector<SessionEvent> events(const TickSpan& span = {});

  /// Calls `visit` with the samples of a tick, those of its fingers in their order, tick by tick, until it returns
  /// false. Memory for one part only. Throws Error naming the block that is damaged.
  void forEachTick(const TickSpan& span, const std::function<bool(std::span<const Sample>)>& visit);

  /// The blocks that cannot be read, and why.
  std::vector<std::pair<std::int64_t, std::string>> damagedBlocks();

 private:
  using Part = std::map<std::uint64_t, std::vector<Sample>>;  ///< by tick
  void readFacts();
  Part readPart(std::int64_t part, const TickSpan& span);

  Database database_;
  SessionFacts facts_;
};

}  // namespace palpate::trace

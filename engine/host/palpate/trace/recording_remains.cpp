// The tables of a recording (recording_schema.cpp) have rows of different shapes: which values are texts, numbers,
// bytes. The first value of most is the row's id, which SQLite keeps elsewhere.
#include "palpate/trace/recording_remains.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/trace/recording_schema.h"
#include "palpate/trace/sample_block.h"

namespace palpate::trace {

namespace {

using Values = std::vector<RawValue>;

constexpr std::int64_t kMaxWorlds = 1'000'000;

/// The shape of a row, a letter a value: n nothing, i integer, r number, t text, b bytes, ? a text or nothing,
/// o an integer or nothing.
bool isLike(const Values& values, std::string_view shape, bool is_whole) {
  if (is_whole ? values.size() != shape.size() : values.size() >= shape.size()) return false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const RawValue::Kind kind = values[i].kind;
    const bool none = kind == RawValue::Kind::none;
    const bool integer = kind == RawValue::Kind::integer;
    const bool text = kind == RawValue::Kind::text;
    const bool fits = shape[i] == 'n'   ? none
                      : shape[i] == 'i' ? integer
                      : shape[i] == 'r' ? integer || kind == RawValue::Kind::real
                      : shape[i] == 't' ? text
                      : shape[i] == 'b' ? kind == RawValue::Kind::blob
                      : shape[i] == '?' ? text || none
                                        : integer || none;
    if (!fits) return false;
  }
  return true;
}

/// Text from unverified bytes: what is not text becomes '?'.
std::string textOf(const RawValue& value) {
  std::string text = value.bytes;
  const bool readable = wellFormed(text) == text;
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f || (byte >= 0x80 && !readable)) c = '?';
  }
  return text;
}

std::uint64_t toCount(const RawValue& value) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, value.integer));
}

/// A block: part, finger, first tick, last tick, rows, checksum from the second value on.
bool isPlausible(const Values& v) {
  return v[1].integer >= 0 && v[2].integer >= 0 && v[2].integer < kMaxFingers && v[3].integer >= 0 &&
         v[4].integer >= v[3].integer && v[5].integer > 0 && v[5].integer <= static_cast<std::int64_t>(kMaxBlockRows) &&
         v[6].integer >= 0 && v[6].integer <= std::int64_t{std::numeric_limits<std::uint32_t>::max()};
}

/// Goes through the rows and puts each where it belongs.
class Sorter {
 public:
  /// `version` of the file's tables; a file that lost it is taken for one of this version.
  Sorter(RecordingRemains& remains, std::int64_t version) : remains_(remains), version_(version) {}

  void addRow(const RawRow& row) {
    if (row.id < 0) return;
    const Values& v = row.values;
    if (!row.whole) {
      addTorn(row);
    } else if (isLike(v, "niiiiiib", true)) {
      addBlock(row);
    } else if (isLike(v, "nt??ttritt", true) || isLike(v, "nt??ttritti", true)) {  // the first version does not count
      addHeader(v);
    } else if (isLike(v, "ntttit", true)) {
      addWorld(row);
    } else if (isLike(v, "iitt", true)) {
      remains_.settings[{v[0].integer, v[1].integer}] = {textOf(v[2]), textOf(v[3])};
    } else if (isLike(v, "niott", true)) {
      addEvent(row);
    } else if (isLike(v, "nitttb", true)) {
      remains_.attachments[row.id] = row.place;
    } else if (isLike(v, "ntttt", true) || isLike(v, "ntt", true)) {
      addColumnOrFinger(row);
    }
  }

  void addEntry(const RawRow& row) {
    const Values& v = row.values;
    if (!row.whole) return;
    if (isLike(v, "iiii", true)) {  // blocks_by_tick: first_tick, part, rows, id
      BlockRemains& block = remains_.blocks[v[3].integer];
      if (block.is_known || toCount(v[2]) == 0 || toCount(v[2]) > kMaxBlockRows) return;
      block.part = v[1].integer;
      block.first_tick = toCount(v[0]);
      block.rows = toCount(v[2]);
      block.last_tick = block.first_tick + block.rows - 1;
      block.is_known = true;
    } else if (isLike(v, "iii", true) && v[1].integer >= 0 && v[1].integer < kMaxFingers) {
      fingers_[v[2].integer] = {v[0].integer, static_cast<std::uint32_t>(v[1].integer)};  // part, finger, id
    }
  }

  /// The index by part says whose blocks are of which only the index by tick is left.
  void finish() {
    for (auto& [id, block] : remains_.blocks) {
      const auto found = fingers_.find(id);
      if (!block.finger && found != fingers_.end() && found->second.first == block.part) {
        block.finger = found->second.second;
      }
    }
    std::erase_if(remains_.blocks, [](const auto& entry) { return entry.first <= 0 || !entry.second.is_known; });
    std::erase_if(remains_.lost_attachments,
                  [&](const auto& entry) { return remains_.attachments.contains(entry.first); });
  }

 private:
  void addBlock(const RawRow& row) {
    const Values& v = row.values;
    if (!isPlausible(v)) return;
    BlockRemains& block = remains_.blocks[row.id];
    if (row.whole) block.places.push_back(row.place);
    block.part = v[1].integer;
    block.finger = static_cast<std::uint32_t>(v[2].integer);
    block.first_tick = toCount(v[3]);
    block.last_tick = toCount(v[4]);
    block.rows = toCount(v[5]);
    block.is_known = true;
  }

  /// A row whose end is in pages that are not there.
  void addTorn(const RawRow& row) {
    const Values& v = row.values;
    if (v.size() == 7 && isLike(v, "niiiiiib", false)) addBlock(row);
    if (v.size() == 5 && isLike(v, "nitttb", false)) remains_.lost_attachments[row.id] = textOf(v[3]);
  }

  void addHeader(const Values& v) {
    RecordingFacts facts;
    facts.header.started_utc = textOf(v[1]);
    facts.ended_utc = textOf(v[2]);
    facts.ended_by = textOf(v[3]);
    facts.header.software = textOf(v[4]);
    facts.header.machine = textOf(v[5]);
    const double rate = v[6].number();
    if (std::isfinite(rate) && rate >= 1e-3 && rate <= 1e6) facts.header.ticks_per_s = rate;
    facts.dropped = toCount(v[7]);
    facts.header.notes = textOf(v[8]);
    facts.header.tags = textOf(v[9]);
    remains_.facts = facts;
  }

  void addWorld(const RawRow& row) {
    if (row.id >= kMaxWorlds) return;
    const Values& v = row.values;
    RecordingWorld world{sceneOfVersion(version_, textOf(v[1])), textOf(v[2]), textOf(v[3]), toCount(v[4]), 0, {}};
    const std::string& hash = v[5].bytes;
    std::from_chars(hash.data(), hash.data() + hash.size(), world.hash, 16);
    remains_.worlds[row.id] = world;
  }

  void addEvent(const RawRow& row) {
    const Values& v = row.values;
    RecordingEvent event{toCount(v[1]), std::nullopt, textOf(v[3]), textOf(v[4])};
    if (v[2].isInteger() && v[2].integer >= 0 && v[2].integer < kMaxFingers) {
      event.finger = static_cast<std::uint32_t>(v[2].integer);
    }
    remains_.events[row.id] = event;
  }

  void addColumnOrFinger(const RawRow& row) {
    const Values& v = row.values;
    const std::string name = textOf(v[1]);
    const std::string type = textOf(v[2]);
    if (v.size() == 5 && (type == "f64" || type == "u64" || type == "u32")) {
      try {
        remains_.columns.insert_or_assign(row.id, columnOf(name, type));
      } catch (const Error&) {  // not one of ours: its blocks will not unpack, and say so
      }
    } else if (row.id < kMaxFingers) {
      RecordingFinger finger{name, type};
      if (v.size() == 5) finger.capabilities = textOf(v[3]);
      if (v.size() == 5) finger.placed = textOf(v[4]);
      remains_.fingers[row.id] = finger;
    }
  }

  RecordingRemains& remains_;
  std::int64_t version_;
  std::map<std::int64_t, std::pair<std::int64_t, std::uint32_t>> fingers_;  ///< id -> part, finger
};

}  // namespace

RecordingRemains remainsIn(SqlitePages& pages, const Progress& progress) {
  RecordingRemains remains;
  Sorter sorter(remains, pages.version() != 0 ? pages.version() : kRecordingVersion);
  const auto report_progress = [&](const RawRow& row) {
    report(progress, "searching",
           static_cast<double>(row.place.page) / std::max(1.0, static_cast<double>(pages.pages())));
  };
  pages.forEachRow(
      [&](const RawRow& row) {
        report_progress(row);
        sorter.addRow(row);
      },
      [&](const RawRow& row) { sorter.addEntry(row); });
  sorter.finish();
  return remains;
}

RecordingAttachment attachmentOf(const RawRow& row) {
  if (!row.whole || !isLike(row.values, "nitttb", true)) throw Error("is incomplete");
  const Values& v = row.values;
  return {toCount(v[1]), textOf(v[2]), textOf(v[3]), textOf(v[4]), v[5].bytes};
}

std::vector<Sample> samplesOf(const RawRow& row, std::span<const SampleColumn> columns) {
  const Values& v = row.values;
  if (!row.whole || !isLike(v, "niiiiiib", true) || !isPlausible(v)) throw Error("is incomplete");
  return unpackSamples(v[7].bytes, static_cast<std::uint32_t>(v[6].integer), static_cast<std::size_t>(v[5].integer),
                       static_cast<std::uint32_t>(v[2].integer), columns);
}

}  // namespace palpate::trace

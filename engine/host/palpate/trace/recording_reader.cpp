#include "palpate/trace/recording_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/trace/recording_schema.h"
#include "palpate/trace/sample_block.h"

namespace palpate::trace {

namespace {

/// Several times those of this version.
constexpr std::size_t kMaxColumns = 200;

std::uint64_t hashOf(std::string_view hexadecimal) {
  std::uint64_t hash = 0;
  std::from_chars(hexadecimal.data(), hexadecimal.data() + hexadecimal.size(), hash, 16);
  return hash;
}

}  // namespace

bool isRecording(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  return name.ends_with(".session") ||
         (name.ends_with(kPartialExtension) && name.find(".session.") != std::string::npos);
}

RecordingReader::RecordingReader(const std::filesystem::path& file) : database_(file, Database::Mode::read) {
  facts_.version = checkRecording(database_);
  readColumns();
  readFacts();
}

void RecordingReader::readColumns() {
  Statement columns(database_, "SELECT name, type FROM columns ORDER BY position");
  while (columns.next()) {
    try {
      columns_.push_back(columnOf(columns.text(0), columns.text(1)));
    } catch (const Error& error) {
      throw Error::inFile(database_.name(), error.what());
    }
    if (columns_.size() > kMaxColumns) throw Error::inFile(database_.name(), "is a recording with too many columns");
  }
}

void RecordingReader::readFacts() {
  Statement recording(database_,
                      "SELECT started_utc, ended_utc, ended_by, software, machine, ticks_per_s, dropped, notes, tags "
                      "FROM session");
  if (!recording.next()) throw Error::inFile(database_.name(), "is a recording without a header");
  RecordingHeader& header = facts_.header;
  header.started_utc = recording.text(0);
  facts_.ended_utc = recording.text(1);
  facts_.ended_by = recording.text(2);
  header.software = recording.text(3);
  header.machine = recording.text(4);
  header.ticks_per_s = recording.real(5);
  facts_.dropped = static_cast<std::uint64_t>(recording.integer(6));
  header.notes = recording.text(7);
  header.tags = recording.text(8);
  if (!(header.ticks_per_s > 0.0) || !std::isfinite(header.ticks_per_s)) {
    throw Error::inFile(database_.name(), "is a recording with an invalid tick rate; expected a number above 0");
  }
  Statement fingers(database_, facts_.version < 2 ? "SELECT id, name, device, '', '' FROM fingers ORDER BY id"
                                                  : "SELECT id, name, device, capabilities, placed FROM fingers "
                                                    "ORDER BY id");
  while (fingers.next()) {
    if (fingers.integer(0) != static_cast<std::int64_t>(facts_.fingers.size()) || fingers.integer(0) >= kMaxFingers) {
      throw Error::inFile(database_.name(), "is a recording whose fingers are not numbered from 0");
    }
    facts_.fingers.push_back({std::string(fingers.text(1)), std::string(fingers.text(2)), std::string(fingers.text(3)),
                              std::string(fingers.text(4))});
  }
  facts_.worlds = static_cast<std::uint64_t>(database_.integer("SELECT count(*) FROM worlds"));
  facts_.first_world = static_cast<std::uint64_t>(database_.integer("SELECT coalesce(min(id), 0) FROM worlds"));
  if (facts_.version >= 2) {
    facts_.attachments = static_cast<std::uint64_t>(database_.integer("SELECT count(*) FROM attachments"));
  }
  facts_.events = static_cast<std::uint64_t>(database_.integer("SELECT count(*) FROM events"));
  // Adding up takes a second for ten hours; the first version must.
  facts_.samples = static_cast<std::uint64_t>(database_.integer(
      facts_.version < 2 ? "SELECT coalesce(sum(rows), 0) FROM blocks" : "SELECT samples FROM session"));
  facts_.first_tick = static_cast<std::uint64_t>(database_.integer("SELECT coalesce(min(first_tick), 0) FROM blocks"));
  facts_.last_tick = static_cast<std::uint64_t>(
      database_.integer("SELECT coalesce(max(last_tick), 0) FROM blocks WHERE part = (SELECT max(part) FROM blocks)"));
}

RecordingWorld RecordingReader::world(std::uint64_t number) {
  Statement find(database_, "SELECT scene, folder, body, triangles, hash FROM worlds WHERE id = ?1");
  if (!find.with(static_cast<std::int64_t>(number)).next()) {
    throw Error::inFile(database_.name(), fmt::format("has no world {}", number));
  }
  RecordingWorld world;
  world.scene = sceneOfVersion(facts_.version, std::string(find.text(0)));
  world.folder = find.text(1);
  world.body = find.text(2);
  world.triangles = static_cast<std::uint64_t>(find.integer(3));
  world.hash = hashOf(find.text(4));
  Statement settings(database_, "SELECT contact, limiter FROM settings WHERE world = ?1 ORDER BY finger");
  settings.with(static_cast<std::int64_t>(number));
  while (settings.next()) world.fingers.push_back({std::string(settings.text(0)), std::string(settings.text(1))});
  return world;
}

std::vector<RecordingEvent> RecordingReader::events(const TickSpan& span) {
  Statement find(database_, "SELECT tick, finger, kind, text FROM events ORDER BY tick, id");
  std::vector<RecordingEvent> events;
  while (find.next()) {
    const auto tick = static_cast<std::uint64_t>(find.integer(0));
    if (tick < span.from || tick > span.to) continue;
    RecordingEvent event{tick, std::nullopt, std::string(find.text(2)), std::string(find.text(3))};
    if (!find.isNull(1)) event.finger = static_cast<std::uint32_t>(find.integer(1));
    events.push_back(std::move(event));
  }
  return events;
}

void RecordingReader::forEachAttachment(const TickSpan& span,
                                        const std::function<void(const RecordingAttachment&)>& visit) {
  if (facts_.version < 2) return;
  Statement find(database_, "SELECT tick, kind, name, media, data FROM attachments ORDER BY tick, id");
  while (find.next()) {
    const auto tick = static_cast<std::uint64_t>(find.integer(0));
    if (tick < span.from || tick > span.to) continue;
    visit({tick, std::string(find.text(1)), std::string(find.text(2)), std::string(find.text(3)),
           std::string(find.blob(4))});
  }
}

RecordingReader::Part RecordingReader::readPart(std::int64_t part, const TickSpan& span) {
  Statement find(database_, "SELECT id, finger, rows, crc32, data FROM blocks WHERE part = ?1 ORDER BY finger");
  find.with(part);
  Part ticks;
  while (find.next()) {
    const std::int64_t finger = find.integer(1);
    try {
      if (finger < 0 || finger >= static_cast<std::int64_t>(facts_.fingers.size()))
        throw Error("belongs to no finger of the recording");
      const auto rows = static_cast<std::size_t>(std::max<std::int64_t>(0, find.integer(2)));
      for (const Sample& sample : unpackSamples(find.blob(4), static_cast<std::uint32_t>(find.integer(3)), rows,
                                                static_cast<std::uint32_t>(finger), columns_)) {
        if (sample.tick >= span.from && sample.tick <= span.to) ticks[sample.tick].push_back(sample);
      }
    } catch (const Error& error) {
      throw Error::inFile(database_.name(), fmt::format("block {}: {}", find.integer(0), error.what()));
    }
  }
  return ticks;
}

void RecordingReader::forEachTick(const TickSpan& span, const std::function<bool(std::span<const Sample>)>& visit) {
  constexpr auto kMax = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  // Parts follow each other in time, so the index finds the first one at once, however long the recording is.
  Statement begin(database_,
                  "SELECT part FROM blocks WHERE first_tick <= ?1 ORDER BY first_tick DESC, part DESC LIMIT 1");
  begin.with(static_cast<std::int64_t>(std::min(span.from, kMax)));
  const std::int64_t first_part = begin.next() ? begin.integer(0) : 0;
  Statement list(database_, "SELECT DISTINCT part FROM blocks WHERE part >= ?1 AND first_tick <= ?2 ORDER BY part");
  list.with(first_part).with(static_cast<std::int64_t>(std::min(span.to, kMax)));
  while (list.next()) {
    for (const auto& [tick, samples] : readPart(list.integer(0), span)) {
      if (!visit(samples)) return;
    }
  }
}

std::vector<std::pair<std::int64_t, std::string>> RecordingReader::damagedBlocks() {
  std::vector<std::pair<std::int64_t, std::string>> damaged;
  Statement find(database_, "SELECT id, finger, rows, crc32, data FROM blocks ORDER BY id");
  while (find.next()) {
    try {
      unpackSamples(find.blob(4), static_cast<std::uint32_t>(find.integer(3)),
                    static_cast<std::size_t>(std::max<std::int64_t>(0, find.integer(2))),
                    static_cast<std::uint32_t>(find.integer(1)), columns_);
    } catch (const Error& error) {
      damaged.emplace_back(find.integer(0), error.what());
    }
  }
  return damaged;
}

}  // namespace palpate::trace

#include "palpate/trace/recording_schema.h"

#include <fmt/format.h>

#include "palpate/base/error.h"
#include "palpate/trace/known_schema.h"
#include "palpate/trace/sample_block.h"

namespace palpate::trace {

namespace {

constexpr const char* kTables = R"(
CREATE TABLE session(
  id INTEGER PRIMARY KEY CHECK (id = 1),
  started_utc TEXT NOT NULL,          -- 2026-11-21T18:45:00Z
  ended_utc TEXT,                     -- NULL: it is being written, or the program that wrote it was killed
  ended_by TEXT,                      -- 'done', or the signal or fault that ended it
  software TEXT NOT NULL,             -- name and version of the program
  machine TEXT NOT NULL,              -- system and processor; no names of people or computers
  ticks_per_s REAL NOT NULL,
  dropped INTEGER NOT NULL DEFAULT 0, -- samples that found no room on their way here
  notes TEXT NOT NULL DEFAULT '',
  tags TEXT NOT NULL DEFAULT '',      -- words with blanks between
  samples INTEGER NOT NULL DEFAULT 0  -- rows of all blocks
) STRICT;
CREATE TABLE worlds(
  id INTEGER PRIMARY KEY,             -- counts from 0; samples name it
  scene TEXT NOT NULL,                -- the scene file that builds it
  folder TEXT NOT NULL,               -- that files in it are relative to
  body TEXT NOT NULL,
  triangles INTEGER NOT NULL,
  hash TEXT NOT NULL                  -- of skin and stiffness: 16 hexadecimal digits
) STRICT;
CREATE TABLE fingers(
  id INTEGER PRIMARY KEY,             -- counts from 0
  name TEXT NOT NULL,
  device TEXT NOT NULL,               -- that moved it, when it began
  capabilities TEXT NOT NULL DEFAULT '', -- of the device: "key = value", a line each
  placed TEXT NOT NULL DEFAULT ''     -- how the device's space lay in the body, likewise: its calibration
) STRICT;
CREATE TABLE settings(                -- what a finger was felt with in a world: numbers as JSON objects
  world INTEGER NOT NULL,
  finger INTEGER NOT NULL,
  contact TEXT NOT NULL,
  limiter TEXT NOT NULL,
  PRIMARY KEY (world, finger)
) STRICT;
CREATE TABLE columns(                 -- of the bytes of a block, in their order
  position INTEGER PRIMARY KEY,
  name TEXT NOT NULL,
  type TEXT NOT NULL,                 -- f64, u64, u32, little-endian
  unit TEXT NOT NULL,
  meaning TEXT NOT NULL
) STRICT;
CREATE TABLE blocks(
  id INTEGER PRIMARY KEY,
  part INTEGER NOT NULL,              -- blocks of one part hold the same span of time, one a finger
  finger INTEGER NOT NULL,
  first_tick INTEGER NOT NULL,
  last_tick INTEGER NOT NULL,
  rows INTEGER NOT NULL,
  crc32 INTEGER NOT NULL,             -- of data
  data BLOB NOT NULL                  -- deflated columns (docs/reference/recordings.md)
) STRICT;
CREATE INDEX blocks_by_part ON blocks(part, finger);
CREATE INDEX blocks_by_tick ON blocks(first_tick, part, rows);
CREATE TABLE events(
  id INTEGER PRIMARY KEY,
  tick INTEGER NOT NULL,
  finger INTEGER,                     -- NULL: of no finger
  kind TEXT NOT NULL,                 -- mark, world, device, button, safety, dropped, note, cut
  text TEXT NOT NULL
) STRICT;
CREATE INDEX events_by_tick ON events(tick);
CREATE TABLE attachments(             -- pictures, sound notes, files that the scene names
  id INTEGER PRIMARY KEY,
  tick INTEGER NOT NULL,
  kind TEXT NOT NULL,                 -- picture, sound, file
  name TEXT NOT NULL,                 -- of kind file: as the scene names it
  media TEXT NOT NULL,                -- image/png, audio/wav, ...
  data BLOB NOT NULL
) STRICT;
)";

/// Tables that differed in version 1; later versions have those above.
constexpr const char* kTablesOfVersion1 = R"(
CREATE TABLE session(
  id INTEGER PRIMARY KEY CHECK (id = 1),
  started_utc TEXT NOT NULL,
  ended_utc TEXT,
  ended_by TEXT,
  software TEXT NOT NULL,
  machine TEXT NOT NULL,
  ticks_per_s REAL NOT NULL,
  dropped INTEGER NOT NULL DEFAULT 0,
  notes TEXT NOT NULL DEFAULT '',
  tags TEXT NOT NULL DEFAULT ''
) STRICT;
CREATE TABLE fingers(
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL,
  device TEXT NOT NULL
) STRICT;
)";

/// Allows every version's tables: a file with another version's table fails at the first missing column.
const KnownSchema& schemaOfRecordings() {
  static const KnownSchema known = [] {
    KnownSchema all = schemaMadeBy(kTables);
    all.merge(schemaMadeBy(kTablesOfVersion1));
    return all;
  }();
  return known;
}

}  // namespace

void makeRecordingTables(Database& database) {
  database.run(
      fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", kRecordingApplication, kRecordingVersion));
  database.run("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL");
  Transaction transaction(database);
  database.run(kTables);
  Statement insert(database, "INSERT INTO columns VALUES (?1, ?2, ?3, ?4, ?5)");
  std::int64_t position = 0;
  for (const SampleColumn& column : sampleColumns()) {
    insert.with(position++).with(column.name).with(column.type).with(column.unit).with(column.meaning).run();
  }
  transaction.commit();
}

std::int64_t checkRecording(Database& database) {
  if (database.integer("PRAGMA application_id") != kRecordingApplication) {
    throw Error::inFile(database.name(), "is not a recording file of Palpate");
  }
  const std::int64_t version = database.integer("PRAGMA user_version");
  if (version < 1 || version > kRecordingVersion) {
    throw Error::inFile(
        database.name(),
        fmt::format("is a recording of version {}; this program reads versions up to {}", version, kRecordingVersion));
  }
  requireKnownSchema(database, schemaOfRecordings(), "a recording");
  return version;
}

namespace {

/// The scene with this key and value (as TOML) in this table, where it does not say one itself. Scenes are written by
/// this program (scene/scene_writer.h): a table's keys follow its title, one a line, without comments.
std::string withKey(std::string scene, const std::string& table, const std::string& key, const std::string& value) {
  const std::string title = "[" + table + "]\n";
  const std::string line = key + " = " + value + "\n";
  const std::size_t found = scene.find(title);
  if (found == std::string::npos) return scene + "\n" + title + line;
  const std::size_t keys = found + title.size();
  const std::string_view of_table = std::string_view(scene).substr(keys, scene.find("\n[", found + 1) - keys);
  if (!of_table.starts_with(key + " = ") && of_table.find("\n" + key + " = ") == std::string_view::npos) {
    scene.insert(keys, line);
  }
  return scene;
}

}  // namespace

std::string sceneOfVersion(std::int64_t version, std::string scene) {
  constexpr std::int64_t kTrunkIsMeant = 3;
  constexpr std::int64_t kLayersAreMeant = 4;
  constexpr std::int64_t kRadiusIsFelt = 5;
  constexpr std::int64_t kNarrowBoneIsFelt = 6;
  if (version < kTrunkIsMeant) scene = withKey(std::move(scene), "body", "kind", "\"torso\"");
  if (version < kLayersAreMeant) scene = withKey(std::move(scene), "deformation", "tissue", "\"gaussian\"");
  if (version < kRadiusIsFelt) scene = withKey(std::move(scene), "tissue", "by_finger_radius", "false");
  if (version < kNarrowBoneIsFelt) scene = withKey(std::move(scene), "tissue", "narrow_bone", "false");
  return scene;
}

}  // namespace palpate::trace

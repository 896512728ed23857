// Recordings whose tables were made to hang, mislead or run their reader: refused before anything in them is asked.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/trace/known_schema.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/trace/recording_schema.h"
#include "support/error_message.h"
#include "support/sound_recording.h"
#include "support/temporary_folder.h"

namespace palpate::trace {
namespace {

constexpr const char* kNeverEnds =
    "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i AS position, 'tick' AS name, 'u64' AS "
    "type FROM n WHERE i < 0";

class HostileRecording : public testing::Test {
 protected:
  HostileRecording() { support::writeSoundRecording(file_); }
  /// As somebody else's program would: with all that SQLite can.
  void change(const std::string& sql) const {
    sqlite3* database = nullptr;
    ASSERT_EQ(::sqlite3_open(file_.c_str(), &database), SQLITE_OK);
    char* words = nullptr;
    EXPECT_EQ(::sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &words), SQLITE_OK) << words;
    ::sqlite3_close(database);
  }
  std::string refusal() const {
    const std::string message = support::thrownMessage([&] { RecordingReader{file_}; });
    const std::string name = file_.string() + ": ";
    return message.starts_with(name) ? message.substr(name.size()) : message;
  }

  support::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "a.session";
};

constexpr const char* kRest = ", which is not part of a recording written by Palpate; nothing was read";

TEST_F(HostileRecording, AViewInPlaceOfATableIsNotAsked) {
  change(std::string("ALTER TABLE columns RENAME TO real_columns; CREATE VIEW columns AS ") + kNeverEnds);
  EXPECT_EQ(refusal(), std::string("contains the table 'real_columns'") + kRest);
  change("DROP TABLE real_columns");
  EXPECT_EQ(refusal(), std::string("contains the view 'columns'") + kRest);
}

TEST_F(HostileRecording, WhatTheSchemaSaysOfItselfDoesNotCount) {
  change(std::string("DROP TABLE columns; CREATE VIEW columns AS ") + kNeverEnds +
         "; PRAGMA writable_schema = ON; UPDATE sqlite_schema SET type = 'table' WHERE name = 'columns'");
  EXPECT_NE(refusal().find("is damaged"), std::string::npos) << "SQLite itself finds it: " << refusal();
}

TEST_F(HostileRecording, NothingButTheTablesOfARecordingIsTaken) {
  for (const char* sql :
       {"CREATE TRIGGER t AFTER INSERT ON events BEGIN DELETE FROM events; END", "CREATE INDEX i ON events(abs(tick))",
        "CREATE INDEX i ON events(tick) WHERE tick > 0", "CREATE TABLE more(a)", "CREATE VIEW v AS SELECT 1", "ANALYZE",
        "DROP TABLE events; CREATE TABLE events(id INTEGER PRIMARY KEY, tick INTEGER NOT NULL, finger "
        "INTEGER, kind TEXT NOT NULL, text TEXT AS (hex(zeroblob(100000000))) STORED) STRICT",
        "DROP TABLE events; CREATE VIRTUAL TABLE events USING rtree(id, tick, finger)"}) {
    const std::string sound = readFile(file_, 1 << 24);
    change(sql);
    EXPECT_NE(refusal().find(kRest), std::string::npos) << sql << ": " << refusal();
    writeFile(file_, sound);
    EXPECT_EQ(RecordingReader(file_).facts().samples, 400u);
  }
}

TEST_F(HostileRecording, OtherBlanksAndCommentsAreTheSameTable) {
  change(
      "DROP TABLE fingers; CREATE TABLE fingers(id INTEGER PRIMARY KEY, /* no, this is none */ name TEXT NOT NULL) "
      "STRICT");
  EXPECT_NE(refusal().find(kRest), std::string::npos);
  change(
      "DROP TABLE fingers; CREATE TABLE fingers( -- of \"mine\"\n  id INTEGER PRIMARY KEY,\n name TEXT NOT NULL, "
      "device TEXT NOT NULL, capabilities TEXT NOT NULL DEFAULT '', placed TEXT NOT NULL DEFAULT ''\n) STRICT");
  EXPECT_EQ(refusal().find("contains the"), std::string::npos) << refusal();
}

TEST_F(HostileRecording, AStatementThatNeverEndsIsEndedAndSoIsOneThatIsInterrupted) {
  Database database(file_, Database::Mode::read);
  EXPECT_EQ(support::thrownMessage([&] { Statement(database, kNeverEnds).next(); }),
            file_.string() + ": takes longer to read than a file of its size should; reading was stopped");
  struct Asked {};
  int calls = 0;
  const ReadingWatch watch([&] {
    if (++calls > 3) throw Asked();
  });
  EXPECT_THROW(Statement(database, kNeverEnds).next(), Asked);
  EXPECT_EQ(database.integer("SELECT count(*) FROM fingers"), 1) << "what follows goes on";
}

TEST_F(HostileRecording, AStatementMayTakeAsLongEachTimeItIsAsked) {
  Database database(file_, Database::Mode::read);
  Statement count(
      database,
      "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 400000) SELECT max(i) FROM n");
  for (int time = 0; time < 3; ++time) {  // some five million steps each; ten are free
    ASSERT_TRUE(count.next());
    EXPECT_EQ(count.integer(0), 400'000);
    EXPECT_FALSE(count.next());
  }
}

TEST_F(HostileRecording, ViewsAndTriggersAreOffInWhateverIsOpened) {
  change("CREATE VIEW v AS SELECT 1");
  Database database(file_, Database::Mode::read);
  EXPECT_THROW(database.integer("SELECT * FROM v"), Error);
  EXPECT_THROW(database.run("ATTACH ':memory:' AS other"), Error);
}

TEST_F(HostileRecording, APipeIsNoFile) {
  const std::filesystem::path pipe = folder_ / "pipe.session";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(support::thrownMessage([&] { RecordingReader{pipe}; }), pipe.string() + ": is not a file");
}

TEST_F(HostileRecording, ARecordingIsForItsOwnerAloneWhileItIsWritten) {
  const mode_t before = ::umask(0);
  const auto mode_of = [](const std::string& file) {
    struct stat facts = {};
    return ::stat(file.c_str(), &facts) == 0 ? facts.st_mode & 07777 : 0;
  };
  RecordingWriter writer(folder_ / "b.session",
                         {.started_utc = utcNow(), .software = {}, .machine = {}, .notes = {}, .tags = {}},
                         {{"index", "mouse"}});
  const std::string partial = writer.partial().string();
  for (const char* companion : {"", "-wal", "-shm"}) EXPECT_EQ(mode_of(partial + companion), 0600u) << companion;
  writer.add(Sample{});
  writer.flush();
  copyRecording(writer.partial(), folder_ / "copy.session", "cut off");
  EXPECT_EQ(mode_of((folder_ / "copy.session").string()), 0600u);
  writer.finish("done");
  EXPECT_EQ(mode_of((folder_ / "b.session").string()), 0600u);
  const Database other(folder_ / "made.db", Database::Mode::create);
  EXPECT_EQ(mode_of((folder_ / "made.db").string()), 0600u);
  ::umask(before);
}

}  // namespace
}  // namespace palpate::trace

// Records that somebody else made or changed: what is not a table of ours is refused before anything is asked of it.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/training/records/export.h"
#include "palpate/training/records/key_vault.h"
#include "palpate/training/records/recording_files.h"
#include "palpate/training/records/store.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"
#include "teach/tests/training/records_samples.h"

namespace palpate::training {
namespace {

namespace fs = std::filesystem;

/// With all that SQLite can, as another program would.
void changeRecords(const fs::path& file, const std::string& sql) {
  sqlite3* database = nullptr;
  ASSERT_EQ(::sqlite3_open(file.c_str(), &database), SQLITE_OK);
  char* words = nullptr;
  EXPECT_EQ(::sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &words), SQLITE_OK) << words;
  ::sqlite3_close(database);
}

TEST(HostileRecords, AreRefusedWhateverTheyBringAlong) {
  const support::TemporaryFolder folder;
  const fs::path file = folder / "a.results";
  { const Store made(file, Store::Open::create_too); }
  const std::string sound = readFile(file, 1u << 24);
  for (const char* sql :
       {"DROP TABLE setting; CREATE VIEW setting AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) "
        "SELECT 'outbox' AS name, 'on' AS value FROM n WHERE i < 0",
        "CREATE TRIGGER t AFTER INSERT ON trial BEGIN DELETE FROM trial; END", "CREATE INDEX i ON trial(abs(number))",
        "CREATE TABLE more(a)", "DROP TABLE setting; CREATE TABLE setting(name TEXT PRIMARY KEY, value TEXT AS ('on'))",
        "DROP TABLE schema_version; CREATE VIEW schema_version AS SELECT 99 AS number, 0 AS at_ms"}) {
    for (const auto how : {Store::Open::existing, Store::Open::read_only}) {
      writeFile(file, sound);
      changeRecords(file, sql);
      const std::string message = support::thrownMessage([&] { Store{file, how}; });
      EXPECT_NE(message.find("which is not part of training records written by Palpate"), std::string::npos)
          << sql << ": " << message;
    }
  }
  writeFile(file, sound);
  EXPECT_EQ(Store(file, Store::Open::read_only).trainees().size(), 0u);
}

TEST(HostileRecords, AVaultOfKeysLikewise) {
  const support::TemporaryFolder folder;
  KeyVault vault(folder / "a.results");
  const std::string ref = vault.make();
  changeRecords(vault.file(), "ALTER TABLE trainee_key RENAME TO t; CREATE VIEW trainee_key AS SELECT * FROM t");
  EXPECT_THROW(vault.find(ref), Error);
  EXPECT_THROW(vault.make(), Error);
}

TEST(HostileRecords, WhatAPersonDidIsTheirKeepersAloneFromTheFirstByte) {
  const mode_t before = ::umask(0);
  const support::TemporaryFolder folder;
  const auto mode_of = [&](const std::string& name) {
    struct stat facts = {};
    return ::stat((folder / name).c_str(), &facts) == 0 ? facts.st_mode & 07777 : 0;
  };
  fs::create_directories(folder / "sub/sessions");  // as an earlier version left it
  Store store(folder / "sub/a.results", Store::Open::create_too);
  store.storeAnyRows(samples::history(1, 1, 2).rows);
  for (const char* end : {"", "-wal", "-shm"}) EXPECT_EQ(mode_of(std::string("sub/a.results") + end), 0600u) << end;
  RecordingFiles(store).makeFolder();
  EXPECT_EQ(mode_of("sub/sessions"), 0700u);
  KeyVault vault(folder / "sub/a.results");
  vault.make();
  EXPECT_EQ(mode_of("sub/a.keys"), 0600u);
  writeFile(folder / "plain", "ticks");
  lockFile(folder / "plain", folder / "locked", newTraineeKey(), "k1");
  EXPECT_EQ(mode_of("locked"), 0600u);
  ::umask(before);
}

TEST(HostileRecords, NoFormulaGoesIntoATable) {
  const support::TemporaryFolder folder;
  Store store(folder / "a.results", Store::Open::create_too);
  store.save(ClassRow{.id = "osteo", .label = "=HYPERLINK(\"http://x\")", .retain_days = 1, .retain_samples_days = 1});
  const auto classes = [&](CsvText kind) { return csvFiles(store.rows(), kind).at(1).text; };
  EXPECT_NE(classes(CsvText::safe).find("osteo,\"'=HYPERLINK"), std::string::npos) << classes(CsvText::safe);
  EXPECT_NE(classes(CsvText::raw).find("osteo,\"=HYPERLINK"), std::string::npos);
}

}  // namespace
}  // namespace palpate::training

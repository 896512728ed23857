// The schema: what version 1 was is written down and does not change, a filled database of it comes forward whole, and
// one that came forward is no other than a fresh one.
#include "palpate/training/records/schema.h"

#include <gtest/gtest.h>

#include "palpate/trace/database.h"
#include "palpate/training/records/store.h"
#include "support/temporary_folder.h"
#include "teach/tests/training/records_old_rows.h"
#include "teach/tests/training/records_suite.h"

namespace palpate::training {
namespace {

std::filesystem::path versionOneFile(const support::TemporaryFolder& folder) {
  trace::Database file(folder / "old.results", trace::Database::Mode::create);
  file.run(old_rows::text("version-1-sqlite.sql"));
  file.run(old_rows::text("version-1-rows.sql"));
  return folder / "old.results";
}

/// Every column of every table as SQLite sees it, in the order of their names.
std::vector<std::string> shapeOf(Store& store) {
  std::vector<std::string> shape;
  for (const SqlValues& row : store.rows().sql().ask(
           "SELECT t.name || '.' || c.name || ' ' || c.type || ' ' || c.\"notnull\" || ' ' || coalesce(c.dflt_value, "
           "'') || ' ' || c.pk FROM sqlite_schema t, pragma_table_info(t.name) c WHERE t.type = 'table' ORDER BY 1")) {
    shape.push_back(std::get<std::string>(row[0]));
  }
  for (const SqlValues& row :
       store.rows().sql().ask("SELECT name FROM sqlite_schema WHERE type = 'index' ORDER BY 1")) {
    shape.push_back(std::get<std::string>(row[0]));
  }
  return shape;
}

TEST(RecordsSchema, VersionOneIsWhatItWas) {
  EXPECT_EQ(ddl(Dialect::sqlite, 1), old_rows::text("version-1-sqlite.sql"));
  EXPECT_EQ(ddl(Dialect::postgresql, 1), old_rows::text("version-1-postgresql.sql"));
  EXPECT_EQ(ddl(Dialect::sqlite, 1).find("palpate_force_n"), std::string::npos);
  EXPECT_NE(ddl(Dialect::sqlite).find("palpate_force_n"), std::string::npos);
}

TEST(RecordsSchema, AFilledFileOfVersionOneComesForwardWhole) {
  const support::TemporaryFolder folder;
  const auto file = versionOneFile(folder);
  EXPECT_THROW(Store(file, Store::Open::read_only), Error);  // not without being asked
  Store store(file, Store::Open::existing);
  EXPECT_EQ(readSchemaVersion(store.rows().sql()), kSchemaVersion);
  EXPECT_EQ(suite::sorted(samples::saidAll(store.rows().all())), suite::sorted(samples::saidAll(old_rows::expected())));
  EXPECT_EQ(store.rows().sql().number("SELECT count(*) FROM schema_version"), kSchemaVersion);
  EXPECT_TRUE(store.rows().sql().ask("PRAGMA foreign_key_check").empty());
}

TEST(RecordsSchema, WhatCameForwardIsNoOtherThanAFreshOne) {
  const support::TemporaryFolder folder;
  Store old(versionOneFile(folder), Store::Open::existing);
  Store fresh(folder / "fresh.results", Store::Open::create_too);
  EXPECT_EQ(shapeOf(old), shapeOf(fresh));
}

TEST(RecordsSchema, AMigrationThatFailsLeavesTheOldVersion) {
  const support::TemporaryFolder folder;
  const auto file = versionOneFile(folder);
  // The step to version 2 adds this column itself, after the other.
  trace::Database(file, trace::Database::Mode::write).run("ALTER TABLE trial ADD COLUMN palpate_force_n REAL");
  EXPECT_THROW(Store(file, Store::Open::existing), Error);
  trace::Database again(file, trace::Database::Mode::read);
  EXPECT_EQ(again.integer("SELECT max(number) FROM schema_version"), 1);
  EXPECT_EQ(again.integer("SELECT count(*) FROM pragma_table_info('trial') WHERE name = 'search_force_n'"), 0);
  EXPECT_EQ(again.integer("SELECT count(*) FROM trial"), 24);
}

TEST(RecordsSchema, LaterColumnsHaveADefault) {
  for (const TableInfo& table : tables()) {
    for (const ColumnInfo& column : table.columns) {
      EXPECT_LE(column.since, kSchemaVersion);
      if (column.since > table.since && !column.may_be_null) {
        EXPECT_NE(column.rules.find("DEFAULT"), std::string_view::npos) << table.name << '.' << column.name;
      }
    }
  }
}

TEST(RecordsSchema, ThePageShowsEveryTableAndColumn) {
  const std::string page = schemaPage();
  EXPECT_NE(page.find("### site_visit\n\nWhat was felt of one site in one trial.\n\n| column |"), std::string::npos);
  EXPECT_NE(page.find("| `class_id` | text or null | null: none | 1 |\n"), std::string::npos);
  for (const TableInfo& table : tables()) {
    const std::size_t at = page.find("### " + std::string(table.name) + "\n");
    ASSERT_NE(at, std::string::npos) << table.name;
    const std::string shown = page.substr(at, page.find("\n### ", at) - at);
    for (const ColumnInfo& column : table.columns) {
      EXPECT_NE(shown.find("\n| `" + std::string(column.name) + "` | "), std::string::npos) << column.name;
    }
  }
}

}  // namespace
}  // namespace palpate::training

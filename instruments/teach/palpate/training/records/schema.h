// The tables of the records, described once: the DDL of SQLite and of PostgreSQL, the steps from older versions, and
// the tables of docs/reference/results-schema.md all come from here.
//
//   tables() ─ ddl, migration ─► statements ─ migrateSchema ─► a file of a station, the database of a class
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/training/records/sql.h"

namespace palpate::training {

enum class ColumnType : std::uint8_t {
  uuid,
  text,
  whole,    ///< 64 bits
  real,     ///< double
  yes_no,   ///< SQLite keeps 0 and 1
  counter,  ///< numbers itself, never the same again
};

struct ColumnInfo {
  std::string_view name;
  ColumnType type = ColumnType::text;
  std::string_view means;       ///< with its unit
  std::string_view rules = {};  ///< SQL constraints, in both dialects; ours are NOT NULL unless `may_be_null`
  bool may_be_null = false;
  int since = 1;  ///< the first schema version with it; later ones need a DEFAULT among their rules
};

struct TableInfo {
  std::string_view name;
  std::string_view means;
  std::vector<ColumnInfo> columns;
  std::string_view rules = {};                 ///< table constraints: primary key, unique
  std::vector<std::string_view> indexed = {};  ///< column lists
  int since = 1;
};

/// In an order in which each refers to those before it only.
const std::vector<TableInfo>& tables();

/// Version 2: the forces of searching and of palpating. 3: who first sent a row to a class, and what a class refused.
/// 4: lumps.
inline constexpr int kSchemaVersion = 4;

/// A whole schema as of that version, empty.
std::string ddl(Dialect dialect, int version = kSchemaVersion);
/// From the version before `to`.
std::string migration(Dialect dialect, int to);

/// Creates missing tables and migrates older ones, all in one transaction. `what` is for messages. Throws Error for a
/// schema newer than ours.
void migrateSchema(Sql& sql, std::string_view what);
/// 0: the tables are missing.
int readSchemaVersion(Sql& sql);

/// The tables as Markdown: `palpate train results export --columns`.
std::string schemaPage();

}  // namespace palpate::training

// The common interface of both databases, so that one piece of code writes and reads rows in either: a station's SQLite
// file (sqlite_sql.h) and a class's PostgreSQL (classroom/class_store.h).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "palpate/base/error.h"

namespace palpate::training {

// The tables of the records, described once: the DDL of SQLite and of PostgreSQL, the steps from older versions, and
// the tables of docs/reference/results-schema.md all come from here.
//
//   tables() ─ ddl, migration ─► statements ─ migrateSchema ─► a file of a station, the database of a class

class Sql;

enum class Dialect : std::uint8_t { sqlite, postgresql };

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

/// Nothing, a whole number (also yes or no), a real one, a text.
using SqlValue = std::variant<std::monostate, std::int64_t, double, std::string>;
using SqlValues = std::vector<SqlValue>;

/// A server that does not answer, or has gone: the statement is not at fault; try again when it is back.
class DatabaseAway : public Error {
 public:
  using Error::Error;
};

/// A connection; one thread. Everything throws Error.
class Sql {
 public:
  virtual ~Sql() = default;
  virtual Dialect dialect() const = 0;
  /// Statements without values, separated by semicolons.
  virtual void run(const std::string& statements) = 0;
  /// One statement; $1, $2, ... first appear in that order. Its rows.
  virtual std::vector<SqlValues> ask(std::string_view sql, const SqlValues& values = {}) = 0;
  /// The same; how many rows it changed.
  virtual std::int64_t change(std::string_view sql, const SqlValues& values = {}) = 0;

  /// The first column of the first row.
  std::int64_t number(std::string_view sql, const SqlValues& values = {});

 protected:
  Sql() = default;
  Sql(const Sql&) = default;
  Sql& operator=(const Sql&) = default;
};

/// All or nothing: without `commit` its end undoes all writes since.
class SqlTransaction {
 public:
  explicit SqlTransaction(Sql& sql);
  ~SqlTransaction();
  SqlTransaction(const SqlTransaction&) = delete;
  SqlTransaction& operator=(const SqlTransaction&) = delete;
  /// Durable when it returns.
  void commit();

 private:
  Sql& sql_;
  bool open_ = true;
};

}  // namespace palpate::training

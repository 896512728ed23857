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

enum class Dialect : std::uint8_t { sqlite, postgresql };

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

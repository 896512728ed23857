// A station's file behind the seam of sql.h.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>

#include "palpate/trace/database.h"
#include "palpate/trace/known_schema.h"
#include "palpate/training/records/sql.h"

namespace palpate::training {

class SqliteSql : public Sql {
 public:
  /// `called`: in messages, instead of the file's name.
  SqliteSql(const std::filesystem::path& file, trace::Database::Mode mode, const std::filesystem::path& called = {})
      : database_(file, mode, called) {}

  Dialect dialect() const override { return Dialect::sqlite; }
  void run(const std::string& statements) override { database_.run(statements); }
  std::vector<SqlValues> ask(std::string_view sql, const SqlValues& values = {}) override;
  std::int64_t change(std::string_view sql, const SqlValues& values = {}) override;
  void setMaxWait(std::chrono::milliseconds wait) { database_.setMaxWait(wait); }
  /// See known_schema.h.
  void requireKnownSchema(const trace::KnownSchema& known, std::string_view what) {
    trace::requireKnownSchema(database_, known, what);
  }

 private:
  trace::Statement& prepared(std::string_view sql, const SqlValues& values);

  trace::Database database_;
  std::map<std::string, trace::Statement, std::less<>> statements_;
};

}  // namespace palpate::training

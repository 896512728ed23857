// sqlite_schema itself is the stranger's too: its columns "type" and "name" may say anything, and what counts to SQLite
// is the text of the statement. So texts are compared, as a whole.
#include "palpate/trace/known_schema.h"

#include <fmt/format.h>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"

namespace palpate::trace {

namespace {

constexpr std::size_t kLongestStatement = 20'000;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Without comments, blanks as one and none at the ends; what is between quotes stays.
std::string plainStatement(std::string_view sql) {
  std::string plain;
  bool blank = false;
  for (std::size_t at = 0; at < sql.size(); ++at) {
    if (isBlank(sql[at])) {
      blank = true;
      continue;
    }
    if (sql.substr(at).starts_with("--")) {
      at = std::min(sql.find('\n', at), sql.size());
      blank = true;
      continue;
    }
    const std::size_t end =
        sql[at] == '\'' || sql[at] == '"' ? std::min(sql.find(sql[at], at + 1), sql.size() - 1) : at;
    if (blank && !plain.empty()) plain += ' ';
    blank = false;
    plain += sql.substr(at, end - at + 1);
    at = end;
  }
  return plain;
}

}  // namespace

KnownSchema schemaMadeBy(const std::string& statements) {
  Database made(":memory:", Database::Mode::create);
  made.run(statements);
  KnownSchema known;
  Statement all(made, "SELECT sql FROM sqlite_schema WHERE sql IS NOT NULL");
  while (all.next()) known.insert(plainStatement(all.text(0)));
  return known;
}

bool isKnown(const KnownSchema& known, std::string_view statement) {
  return statement.size() <= kLongestStatement && known.contains(plainStatement(statement));
}

void requireKnownSchema(Database& database, const KnownSchema& known, std::string_view what) {
  Statement all(database, "SELECT type, name, sql FROM sqlite_schema");
  while (all.next()) {
    // The index of a PRIMARY KEY or UNIQUE has no text.
    if (all.isNull(2) && all.text(1).starts_with("sqlite_autoindex_")) continue;
    if (isKnown(known, all.text(2))) continue;
    throw Error::inFile(
        database.name(),
        fmt::format("contains the {} '{}', which is not part of {} written by Palpate; nothing was read",
                    oneLine(all.text(0)), oneLine(all.text(1)), what));
  }
}

}  // namespace palpate::trace

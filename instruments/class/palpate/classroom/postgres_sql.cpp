// Over libpq. Values travel as text: PostgreSQL writes a double in the fewest digits that read back as the same bits,
// and so do we.
#include "palpate/classroom/postgres_sql.h"

#include <fmt/format.h>
#include <libpq-fe.h>

#include <charconv>
#include <optional>
#include <utility>

#include "palpate/base/nearest_name.h"

namespace palpate::classroom {

namespace {

using training::SqlValue;
using training::SqlValues;

/// Time after which a server that does not answer counts as unreachable.
constexpr const char* kConnectTimeoutS = "5";

// Types of columns (PostgreSQL's catalogue pg_type; fixed for ever).
constexpr Oid kBoolOid = 16;
constexpr Oid kInt8Oid = 20;
constexpr Oid kInt2Oid = 21;
constexpr Oid kInt4Oid = 23;
constexpr Oid kFloat4Oid = 700;
constexpr Oid kFloat8Oid = 701;

constexpr std::size_t kMaxQuoted = 60;

/// The server's words in one line, without its "ERROR:  ".
std::string formatServerMessage(const char* message) {
  std::string words = message == nullptr ? "" : message;
  words = words.substr(0, words.find('\n'));
  for (const std::string_view prefix : {"ERROR:  ", "FATAL:  ", "WARNING:  "}) {
    if (words.starts_with(prefix)) words.erase(0, prefix.size());
  }
  return words.empty() ? "no answer" : words;
}

std::optional<std::string> parameterText(const SqlValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* real = std::get_if<double>(&value)) return fmt::format("{}", *real);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return std::nullopt;
}

template <class Number>
SqlValue numberOf(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw Error(fmt::format("the database returned '{}', expected a number", oneLine(text.substr(0, kMaxQuoted))));
  }
  return number;
}

SqlValue readCell(const PGresult* result, int row, int column) {
  if (::PQgetisnull(result, row, column) != 0) return std::monostate{};
  return postgresValue(::PQftype(result, column), {::PQgetvalue(result, row, column),
                                                   static_cast<std::size_t>(::PQgetlength(result, row, column))});
}

void noteWarning(void* warnings, const char* message) {
  constexpr std::size_t kMaxWarnings = 100;
  auto& list = *static_cast<std::vector<std::string>*>(warnings);
  if (list.size() >= kMaxWarnings) list.erase(list.begin());
  list.push_back(formatServerMessage(message));
}

}  // namespace

SqlValue postgresValue(unsigned type, std::string_view text) {
  switch (type) {
    case kBoolOid:
      if (text != "t" && text != "f") throw Error("the database must return 't' or 'f' for yes or no");
      return std::int64_t{text == "t" ? 1 : 0};
    case kInt8Oid:
    case kInt2Oid:
    case kInt4Oid:
      return numberOf<std::int64_t>(text);
    case kFloat4Oid:
    case kFloat8Oid:
      return numberOf<double>(text);
    default:
      return std::string(text);
  }
}

void refusePassword(const std::string& connection) {
  char* fault = nullptr;
  PQconninfoOption* const options = ::PQconninfoParse(connection.c_str(), &fault);
  ::PQfreemem(fault);
  bool has_password = false;
  for (const PQconninfoOption* option = options; option != nullptr && option->keyword != nullptr; ++option) {
    const std::string_view keyword = option->keyword;
    has_password = has_password || ((keyword == "password" || keyword == "sslpassword") && option->val != nullptr);
  }
  ::PQconninfoFree(options);
  if (has_password) {
    throw Error(
        "the database's address must not contain a password, which other users could read (ps); put it into ~/.pgpass, "
        "a service file or PGPASSWORD");
  }
}

void PostgresSql::Finish::operator()(pg_conn* connection) const { ::PQfinish(connection); }
void PostgresSql::Clear::operator()(pg_result* result) const { ::PQclear(result); }

PostgresSql::PostgresSql(std::string connection) : settings_(std::move(connection)) { refusePassword(settings_); }

std::vector<std::string> PostgresSql::drainWarnings() { return std::exchange(warnings_, {}); }

bool PostgresSql::connected() const { return connection_ != nullptr && ::PQstatus(connection_.get()) == CONNECTION_OK; }

void PostgresSql::connect() {
  names_.clear();
  connection_.reset();
  // Later ones of the same name win; the text of the caller is taken apart in the place of "dbname".
  const char* const names[] = {"connect_timeout", "application_name", "dbname", "client_encoding", nullptr};
  const char* const values[] = {kConnectTimeoutS, "palpate", settings_.c_str(), "UTF8", nullptr};
  connection_.reset(::PQconnectdbParams(names, values, 1));
  if (!connected()) {
    const std::string words = formatServerMessage(connection_ ? ::PQerrorMessage(connection_.get()) : nullptr);
    connection_.reset();
    throw DatabaseAway(fmt::format("the class's database: {}", words));
  }
  ::PQsetNoticeProcessor(connection_.get(), &noteWarning, &warnings_);  // a library prints nothing
  run("SET client_min_messages = warning; SET synchronous_commit = on");
}

PostgresSql::Result PostgresSql::checked(pg_result* raw) {
  Result result(raw);
  const ExecStatusType status = ::PQresultStatus(raw);
  if (status == PGRES_COMMAND_OK || status == PGRES_TUPLES_OK) return result;
  const std::string words = formatServerMessage(::PQerrorMessage(connection_.get()));
  const char* const code = raw == nullptr ? nullptr : ::PQresultErrorField(raw, PG_DIAG_SQLSTATE);
  // Class 57: shut down by its operator; 53: out of disk, memory, connections; 40: lost against another transaction.
  const std::string_view kind = code == nullptr ? std::string_view() : std::string_view(code).substr(0, 2);
  const bool away = !connected() || kind.empty() || kind == "57" || kind == "53" || kind == "40" || kind == "08";
  if (!away) throw Error(words);
  // Shut down or crashed, it has reported so with its last message: the connection is of no use, though libpq has not
  // seen it.
  if (kind == "57" || kind == "08") connection_.reset();
  throw DatabaseAway(fmt::format("the class's database: {}", words));
}

void PostgresSql::run(const std::string& statements) {
  if (connection_ == nullptr) throw DatabaseAway("the class's database: not connected");
  checked(::PQexec(connection_.get(), statements.c_str()));
}

const std::string& PostgresSql::prepared(std::string_view sql) {
  const auto found = names_.find(sql);
  if (found != names_.end()) return found->second;
  const std::string name = fmt::format("s{}", names_.size() + 1);
  checked(::PQprepare(connection_.get(), name.c_str(), std::string(sql).c_str(), 0, nullptr));
  return names_.emplace(std::string(sql), name).first->second;
}

PostgresSql::Result PostgresSql::executed(std::string_view sql, const SqlValues& values) {
  if (connection_ == nullptr) throw DatabaseAway("the class's database: not connected");
  std::vector<std::optional<std::string>> texts;
  for (const SqlValue& value : values) texts.push_back(parameterText(value));
  std::vector<const char*> pointers;
  for (const auto& text : texts) pointers.push_back(text ? text->c_str() : nullptr);
  return checked(::PQexecPrepared(connection_.get(), prepared(sql).c_str(), static_cast<int>(pointers.size()),
                                  pointers.data(), nullptr, nullptr, 0));
}

std::vector<SqlValues> PostgresSql::ask(std::string_view sql, const SqlValues& values) {
  const Result result = executed(sql, values);
  std::vector<SqlValues> rows;
  for (int row = 0; row < ::PQntuples(result.get()); ++row) {
    SqlValues& cells = rows.emplace_back();
    for (int column = 0; column < ::PQnfields(result.get()); ++column) {
      cells.push_back(readCell(result.get(), row, column));
    }
  }
  return rows;
}

std::int64_t PostgresSql::change(std::string_view sql, const SqlValues& values) {
  const Result result = executed(sql, values);
  const std::string_view count = ::PQcmdTuples(result.get());
  return count.empty() ? 0 : std::get<std::int64_t>(numberOf<std::int64_t>(count));
}

}  // namespace palpate::classroom

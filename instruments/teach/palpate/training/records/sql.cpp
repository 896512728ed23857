#include "palpate/training/records/sql.h"

#include <fmt/format.h>

#include "palpate/base/error.h"

namespace palpate::training {

std::int64_t Sql::number(std::string_view sql, const SqlValues& values) {
  const std::vector<SqlValues> rows = ask(sql, values);
  if (rows.empty() || rows.front().empty()) throw Error(fmt::format("the database did not answer: {}", sql));
  const auto* value = std::get_if<std::int64_t>(&rows.front().front());
  if (value == nullptr) throw Error(fmt::format("the database returned no number for: {}", sql));
  return *value;
}

SqlTransaction::SqlTransaction(Sql& sql) : sql_(sql) {
  // IMMEDIATE: two programs that both read first and then write would else fail instead of wait.
  sql_.run(sql_.dialect() == Dialect::sqlite ? "BEGIN IMMEDIATE" : "BEGIN");
}

SqlTransaction::~SqlTransaction() {
  if (!open_) return;
  try {
    sql_.run("ROLLBACK");
  } catch (const Error&) {  // it has been undone already: a full disk, a server that is gone
  }
}

void SqlTransaction::commit() {
  sql_.run("COMMIT");
  open_ = false;
}

}  // namespace palpate::training

#include "palpate/training/records/sqlite_sql.h"

namespace palpate::training {

namespace {

SqlValue valueOfColumn(const trace::Statement& statement, int column) {
  switch (statement.kind(column)) {
    case trace::Statement::Kind::integer:
      return statement.integer(column);
    case trace::Statement::Kind::real:
      return statement.real(column);
    case trace::Statement::Kind::text:
      return std::string(statement.text(column));
    case trace::Statement::Kind::blob:
      return std::string(statement.blob(column));
    case trace::Statement::Kind::nothing:
      break;
  }
  return std::monostate{};
}

}  // namespace

trace::Statement& SqliteSql::prepared(std::string_view sql, const SqlValues& values) {
  auto found = statements_.find(sql);
  if (found == statements_.end()) {
    found = statements_.emplace(std::string(sql), trace::Statement(database_, sql)).first;
  }
  trace::Statement& statement = found->second;
  for (const SqlValue& value : values) {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) {
      statement.with(*whole);
    } else if (const auto* real = std::get_if<double>(&value)) {
      statement.with(*real);
    } else if (const auto* text = std::get_if<std::string>(&value)) {
      statement.with(std::string_view(*text));
    } else {
      statement.withNull();
    }
  }
  return statement;
}

std::vector<SqlValues> SqliteSql::ask(std::string_view sql, const SqlValues& values) {
  trace::Statement& statement = prepared(sql, values);
  std::vector<SqlValues> rows;
  while (statement.next()) {
    SqlValues& row = rows.emplace_back();
    for (int column = 0; column < statement.columns(); ++column) row.push_back(valueOfColumn(statement, column));
  }
  return rows;
}

std::int64_t SqliteSql::change(std::string_view sql, const SqlValues& values) {
  prepared(sql, values).run();
  return database_.changes();
}

}  // namespace palpate::training

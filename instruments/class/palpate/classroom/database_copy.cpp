#include "palpate/classroom/database_copy.h"

#include <fmt/format.h>

#include "palpate/base/error.h"
#include "palpate/classroom/postgres_sql.h"
#include "palpate/training/records/schema.h"

namespace palpate::classroom {

namespace {

void checkVersion(PostgresSql& sql, const std::string& called) {
  const int version = training::readSchemaVersion(sql);
  if (version == training::kSchemaVersion) return;
  throw Error::inFile(called, version == 0 ? "holds no training records"
                              : version > training::kSchemaVersion
                                  ? "was written by a newer palpate"
                                  : "was written by an older palpate; `palpate class serve` upgrades it");
}

}  // namespace

training::Store copyOfDatabase(const std::string& address) {
  PostgresSql sql(address);
  sql.connect();
  const auto name = sql.ask("SELECT current_database()::text");
  const std::string called = fmt::format("database {}", std::get<std::string>(name.at(0).at(0)));
  checkVersion(sql, called);
  training::Store copy = training::Store::inMemory(called);
  sql.run("BEGIN ISOLATION LEVEL REPEATABLE READ, READ ONLY");
  copy.storeAnyRows(training::RowTables(sql).all());
  sql.run("COMMIT");
  return copy;
}

}  // namespace palpate::classroom

#include "palpate/classroom/class_store.h"

#include <fmt/format.h>

#include "palpate/training/records/schema.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::classroom {

using training::AnyRow;
using training::SessionRow;

ClassStore::ClassStore(std::string connection, KeeperRules rules)
    : sql_(std::move(connection)), tables_(sql_), keeper_(tables_, std::move(rules)) {
  reconnect();
}

void ClassStore::reconnect() {
  sql_.connect();
  training::migrateSchema(sql_, "the class's database");
}

/// Deleted rows stay in the server's files until a table is written again. Seconds, for a class. A role that does not
/// own the tables is only warned, and nothing is done.
void ClassStore::sweep() {
  sql_.drainWarnings();
  for (const char* table : {"trainee", "session", "block", "trial", "site_visit", "event"}) {
    sql_.run(std::string("VACUUM (FULL) ") + table);
  }
  const std::vector<std::string> warnings = sql_.drainWarnings();
  not_erased_.clear();
  if (warnings.empty()) return;
  not_erased_ = fmt::format(
      "the rows are gone from the tables but still in the server's files: {}; as their owner, run VACUUM (FULL)",
      warnings.front());
}

ClassStore::Kept ClassStore::save(std::span<const SentRow> rows) {
  Kept kept = keeper_.save(rows);
  if (keeper_.consumeErased()) sweep();
  return kept;
}

ClassStore::Kept ClassStore::save(std::span<const AnyRow> rows) {
  std::vector<SentRow> sent;
  sent.reserve(rows.size());
  for (const AnyRow& row : rows) sent.push_back({row});
  return save(sent);
}

bool ClassStore::erase(const training::Uuid& trainee, std::string_view actor) {
  training::SqlTransaction transaction(sql_);
  const bool there = keeper_.erase(trainee, actor);
  transaction.commit();
  if (keeper_.consumeErased()) sweep();
  return there;
}

training::Purged ClassStore::purge(std::int64_t now_ms) {
  training::Purged purged;
  training::SqlTransaction transaction(sql_);
  for (const training::KeptLongEnough& of : training::findExpired(tables_, now_ms)) {
    for (const SessionRow& session : of.sessions) sql_.change("DELETE FROM session WHERE id = $1", {session.id});
    purged.sessions += static_cast<int>(of.sessions.size());
    if (of.nothing_left) purged.trainees += tables_.erase(of.trainee.id) ? 1 : 0;
  }
  const bool gone = purged.sessions + purged.trainees > 0;
  if (gone) tables_.note(training::utcMs(), "purge", "purged", std::to_string(purged.sessions) + " sessions");
  training::forgetSentBytes(sql_);
  transaction.commit();
  if (gone) sweep();
  return purged;
}

}  // namespace palpate::classroom

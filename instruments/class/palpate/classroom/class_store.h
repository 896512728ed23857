// The records of a class in PostgreSQL 15: what its collector keeps and its reports read. Rows come from many stations,
// more than once, in any order; each is there once.
//
//   rows of stations ─ save, one transaction ─► tables ─► keys that may be acknowledged        reports ◄─ rows()
//
//   ClassStore store("host=/run/postgresql dbname=osteo");
//   const auto kept = store.save(batch);     // durable: acknowledge kept.keys
//
// The server may die at any moment: every call then throws DatabaseAway, and the caller connects again when it likes.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/classroom/postgres_sql.h"
#include "palpate/classroom/row_keeper.h"
#include "palpate/training/records/deletion.h"
#include "palpate/training/records/row_tables.h"

namespace palpate::classroom {

class ClassStore {
 public:
  /// Connects, creates missing tables and migrates older ones. Throws DatabaseAway, or Error for a schema newer than
  /// ours and for an address with a password in it (refusePassword).
  explicit ClassStore(std::string connection, KeeperRules rules = {});

  bool connected() const { return sql_.connected(); }
  /// Connects again. Throws DatabaseAway.
  void reconnect();

  using Kept = KeptRows;
  /// One transaction. Throws DatabaseAway; nothing was kept then, as far as is known.
  Kept save(std::span<const SentRow> rows);
  /// As the teacher, who may write all rows.
  Kept save(std::span<const training::AnyRow> rows);

  /// Deletes the trainee, everything of theirs, and whatever of theirs still arrives. Returns false if unknown.
  bool erase(const training::Uuid& trainee, std::string_view actor);

  /// Deletes what the class has kept for long enough (training::findExpired), in one transaction. Trainees are not
  /// marked as deleted: they may come back.
  training::Purged purge(std::int64_t now_ms);

  /// Deleted rows that still lie in the server's files, because this role may not rewrite them: why, and what to do;
  /// empty: all were swept away.
  const std::string& notErased() const { return not_erased_; }

  training::RowTables& rows() { return tables_; }

 private:
  void sweep();

  PostgresSql sql_;
  training::RowTables tables_;
  RowKeeper keeper_;
  std::string not_erased_;
};

}  // namespace palpate::classroom

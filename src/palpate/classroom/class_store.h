// The records of a class in PostgreSQL 15: what its collector keeps and its reports read. Rows come from many stations,
// more than once, in any order; each is there once.
//
//   rows of stations ─ keep, one transaction ─► tables ─► keys that may be acknowledged        reports ◄─ rows()
//
//   ClassStore store("host=/run/postgresql dbname=osteo");
//   const auto kept = store.keep(batch);     // durable: acknowledge kept.keys
//
// The server may die at any moment: every call then throws DatabaseAway, and the caller connects again when it likes.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/classroom/postgres_sql.h"
#include "palpate/training/records/deletion.h"
#include "palpate/training/records/row_tables.h"

namespace palpate::classroom {

class ClassStore {
 public:
  /// Connects, makes the tables where there are none and brings older ones forward. Throws DatabaseAway, or Error for
  /// a schema that is newer than ours.
  explicit ClassStore(std::string connection);

  bool connected() const { return sql_.connected(); }
  /// Anew. Throws DatabaseAway.
  void reconnect();

  struct Refused {
    training::Uuid key;
    std::string why;
  };
  struct Kept {
    /// Outbox keys (training::outboxKey), in the order of `rows`: in the database now, or belonging to somebody who was
    /// deleted; to be acknowledged.
    std::vector<training::Uuid> keys;
    /// Not kept: a row that it belongs to has not come yet, or it contradicts another. Sent again, it may be.
    std::vector<Refused> refused;
  };
  /// One transaction. Throws DatabaseAway; nothing was kept then, as far as anybody can know.
  Kept keep(std::span<const training::AnyRow> rows);

  /// The trainee, everything of theirs, and whatever of theirs still comes. True: there was somebody.
  bool erase(const training::Uuid& trainee, std::string_view actor);

  /// What the class has kept for long enough (training::keptLongEnough). Nobody is marked as deleted: whoever comes
  /// back is welcome. One transaction.
  training::Purged purge(std::int64_t now_ms);

  training::RowTables& rows() { return tables_; }

 private:
  void keepOne(const training::AnyRow& row);
  bool belongsToDeleted(const training::AnyRow& row) const;
  /// What anybody has deleted since the last time: asked once for a batch instead of for each row.
  void learnDeletions();
  void forgetDeletions();
  void obey(const training::DeletionRow& deletion);
  void eraseRows(const training::Uuid& trainee, std::int64_t at_ms, std::string_view actor);
  void sweep();
  std::vector<std::size_t> refusedOneByOne(std::span<const training::AnyRow> rows, std::span<const std::size_t> order,
                                           Kept& kept);

  PostgresSql sql_;
  training::RowTables tables_;
  std::map<std::string, std::int64_t> deleted_;  // marks, and when
  std::int64_t last_note_ = 0;                   // of the audit, that was read
  bool sweeps_ = false;                          // rows were deleted that still lie in the server's files
};

}  // namespace palpate::classroom

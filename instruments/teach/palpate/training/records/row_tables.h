// Rows in and out of a database, whichever it is. Transactions are the caller's (Store, ClassStore).
//
//   AnyRow ─ save ─► tables ─ trainees, sessions, blocks, trials ─► reports, exports
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/training/records/row_json.h"
#include "palpate/training/records/sql.h"

namespace palpate::training {

struct InterruptedBlock {
  SessionRow session;
  BlockRow block;
};

class RowTables {
 public:
  /// `sql` outlives it.
  explicit RowTables(Sql& sql) : sql_(sql) {}

  enum class Update : std::uint8_t {
    always,      ///< a station's own rows come in the order of their making
    when_newer,  ///< over a network an older state may come after a newer one; a trial that is there stays as it is
  };
  /// Checks it first (row_check.h). True: the tables changed. Throws Error, also where the row that it belongs to is
  /// missing. Deletions are not kept.
  bool save(const AnyRow& row, Update update = Update::always);

  // In the order of their times.
  std::vector<StationRow> stations();
  std::vector<ClassRow> classes();
  std::vector<TraineeRow> trainees();
  std::optional<TraineeRow> trainee(const Uuid& id);
  std::vector<ProtocolRow> protocols();
  std::vector<SessionRow> sessions(const Uuid& trainee = {});  ///< empty: of all
  std::optional<SessionRow> session(const Uuid& id);
  std::vector<BlockRow> blocks(const Uuid& session);
  std::optional<BlockRow> block(const Uuid& id);
  std::vector<TrialRow> trials(const Uuid& block);  ///< with their visits
  std::optional<TrialRow> trial(const Uuid& id);
  std::vector<EventRow> events(const Uuid& session);
  /// The newest of this kind that was not finished, unless a finished one is newer.
  std::optional<InterruptedBlock> interrupted(const Uuid& trainee, SessionKind kind);
  /// The newest finished block of a test that measured a threshold.
  std::optional<BlockRow> lastMeasured(const Uuid& trainee);
  std::int64_t trialCount();

  /// Every row that is older than all that refer to it: as they must be kept again elsewhere.
  std::vector<AnyRow> all();

  /// Deletes the trainee and whatever belongs to them. Returns false if unknown.
  bool erase(const Uuid& trainee);
  void note(std::int64_t at_ms, std::string_view actor, std::string_view action, std::string_view subject);
  /// There is a note of this action about this subject; when the newest was made.
  std::optional<std::int64_t> noted(std::string_view action, std::string_view subject);

  Sql& sql() { return sql_; }

 private:
  template <class R>
  std::vector<R> read(const std::string& condition, const SqlValues& values);
  template <class R>
  std::optional<R> one(const Uuid& id);
  void fillVisits(std::vector<TrialRow>& trials, const std::string& condition, const SqlValues& values);

  Sql& sql_;
};

}  // namespace palpate::training

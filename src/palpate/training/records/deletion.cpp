#include "palpate/training/records/deletion.h"

#include <map>

#include "palpate/base/error.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::training {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kDayMs = 86'400'000;

int removeFilesOf(const SessionFiles& files, const Uuid& sitting) {
  int removed = 0;
  for (const fs::path& file : files.filesOf(sitting)) removed += fs::remove(file) ? 1 : 0;
  return removed;
}

/// What waits for the class of this sitting, and of what belongs to it.
void forgetWaiting(Store& store, const Uuid& sitting) {
  Sql& sql = store.rows().sql();
  const auto forget = [&sql](const Uuid& id) { sql.change("DELETE FROM outbox WHERE subject = $1", {id}); };
  forget(sitting);
  sql.change("DELETE FROM outbox WHERE subject IN (SELECT id FROM trial WHERE session_id = $1)", {sitting});
  for (const EventRow& event : store.events(sitting)) forget(event.id);
  for (const BlockRow& block : store.blocks(sitting)) {
    forget(block.id);
    for (const TrialRow& trial : store.trials(block.id)) forget(trial.id);
  }
}

/// Deleted rows are overwritten where they stood (secure_delete); copies of their pages are in the log, and in free
/// pages of before it was switched on.
void sweepFile(Store& store) { store.rows().sql().run("VACUUM; PRAGMA wal_checkpoint(TRUNCATE)"); }

std::int64_t endOf(const SittingRow& sitting) { return std::max(sitting.start_ms, sitting.end_ms); }

}  // namespace

Deleted deleteTrainee(Store& store, const Uuid& trainee, std::string_view actor) {
  SessionFiles files(store);
  const std::optional<TraineeRow> row = store.trainee(trainee);
  Deleted deleted{.found = row.has_value()};
  if (!row) return deleted;
  if (!row->key_ref.empty()) deleted.key = files.vault().destroy(row->key_ref);
  const std::vector<SittingRow> sittings = store.sittings(trainee);
  for (const SittingRow& sitting : sittings) deleted.files += removeFilesOf(files, sitting.id);

  RowTables& rows = store.rows();
  const std::int64_t trials_before = rows.trialCount();
  SqlTransaction transaction(rows.sql());
  for (const SittingRow& sitting : sittings) forgetWaiting(store, sitting.id);
  rows.sql().change("DELETE FROM outbox WHERE subject = $1", {trainee});
  rows.erase(trainee);
  const std::int64_t now = utcMs();
  rows.note(now, actor, "deleted", deletedMark(trainee));
  if (store.fillsOutbox()) store.queueDeletion({deletedMark(trainee), now});
  transaction.commit();
  deleted.sittings = static_cast<int>(sittings.size());
  deleted.trials = static_cast<int>(trials_before - rows.trialCount());
  sweepFile(store);
  return deleted;
}

Purged purge(Store& store, std::int64_t now_ms, bool really) {
  SessionFiles files(store);
  std::map<std::string, ClassRow> classes;
  for (const ClassRow& row : store.classes()) classes[row.id] = row;
  Purged purged;
  for (const TraineeRow& trainee : store.trainees()) {
    const auto found = classes.find(trainee.class_id);
    if (found == classes.end()) continue;
    const std::int64_t oldest_rows = now_ms - kDayMs * found->second.retain_days;
    const std::int64_t oldest_files = now_ms - kDayMs * found->second.retain_samples_days;
    bool left = trainee.created_ms >= oldest_rows;
    for (SittingRow& sitting : store.sittings(trainee.id)) {
      const bool old = endOf(sitting) < oldest_rows;
      left = left || !old;
      const bool old_file = endOf(sitting) < std::max(oldest_files, oldest_rows) && !files.filesOf(sitting.id).empty();
      purged.sittings += old ? 1 : 0;
      purged.files += old_file ? 1 : 0;
      if (!really) continue;
      if (old_file) removeFilesOf(files, sitting.id);
      SqlTransaction transaction(store.rows().sql());
      if (old) {
        forgetWaiting(store, sitting.id);
        store.rows().sql().change("DELETE FROM session WHERE id = $1", {sitting.id});
      } else if (old_file) {
        store.rows().sql().change("UPDATE session SET file = '' WHERE id = $1", {sitting.id});
      }
      transaction.commit();
    }
    purged.trainees += left ? 0 : 1;
    if (really && !left) deleteTrainee(store, trainee.id, "purge");
  }
  if (really && purged.sittings + purged.files > 0) {
    store.rows().note(utcMs(), "purge", "purged", std::to_string(purged.sittings) + " sittings");
    sweepFile(store);
  }
  return purged;
}

}  // namespace palpate::training

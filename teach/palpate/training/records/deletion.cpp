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

/// In a class's records: what stations still send of this sitting is known by it (classroom/row_keeper.h).
void noteParts(Store& store, const SittingRow& sitting) {
  const auto note = [&store](const Uuid& id) { store.rows().note(utcMs(), "collector", "deleted", deletedMark(id)); };
  for (const BlockRow& block : store.blocks(sitting.id)) note(block.id);
  note(sitting.id);
}

/// Deleted rows are overwritten where they stood (secure_delete); copies of their pages are in the log, and in free
/// pages of before it was switched on.
void sweepFile(Store& store) { store.rows().sql().run("VACUUM; PRAGMA wal_checkpoint(TRUNCATE)"); }

std::int64_t endOf(const SittingRow& sitting) { return std::max(sitting.start_ms, sitting.end_ms); }

enum class Tell : std::uint8_t { nobody, the_class };

/// Files and rows of somebody who is in the records.
Deleted forget(Store& store, const TraineeRow& trainee, std::string_view actor, Tell tell) {
  SessionFiles files(store);
  Deleted deleted{.found = true};
  if (!trainee.key_ref.empty()) deleted.key = files.vault().destroy(trainee.key_ref);
  const std::vector<SittingRow> sittings = store.sittings(trainee.id);
  for (const SittingRow& sitting : sittings) deleted.files += removeFilesOf(files, sitting.id);

  RowTables& rows = store.rows();
  const std::int64_t trials_before = rows.trialCount();
  SqlTransaction transaction(rows.sql());
  for (const SittingRow& sitting : sittings) {
    if (tell == Tell::the_class && store.holdsCopies()) noteParts(store, sitting);
    forgetWaiting(store, sitting.id);
  }
  rows.sql().change("DELETE FROM outbox WHERE subject = $1", {trainee.id});
  rows.erase(trainee.id);
  if (tell == Tell::the_class) {
    const std::int64_t now = utcMs();
    rows.note(now, actor, "deleted", deletedMark(trainee.id));
    if (store.fillsOutbox()) store.queueDeletion({deletedMark(trainee.id), now});
  }
  transaction.commit();
  deleted.sittings = static_cast<int>(sittings.size());
  deleted.trials = static_cast<int>(trials_before - rows.trialCount());
  return deleted;
}

void purgeRows(Store& store, const SittingRow& sitting) {
  SqlTransaction transaction(store.rows().sql());
  forgetWaiting(store, sitting.id);
  store.rows().sql().change("DELETE FROM session WHERE id = $1", {sitting.id});
  transaction.commit();
}

}  // namespace

Deleted deleteTrainee(Store& store, const Uuid& trainee, std::string_view actor) {
  const std::optional<TraineeRow> row = store.trainee(trainee);
  if (!row) return {};
  const Deleted deleted = forget(store, *row, actor, Tell::the_class);
  sweepFile(store);
  return deleted;
}

std::vector<KeptLongEnough> keptLongEnough(RowTables& rows, std::int64_t now_ms) {
  std::map<std::string, ClassRow> classes;
  for (const ClassRow& row : rows.classes()) classes[row.id] = row;
  std::vector<KeptLongEnough> all;
  for (const TraineeRow& trainee : rows.trainees()) {
    const auto found = classes.find(trainee.class_id);
    if (found == classes.end()) continue;
    const std::int64_t oldest_rows = now_ms - kDayMs * found->second.retain_days;
    const std::int64_t oldest_files = now_ms - kDayMs * found->second.retain_samples_days;
    KeptLongEnough of;
    of.trainee = trainee;
    of.nothing_left = trainee.created_ms < oldest_rows;
    for (const SittingRow& sitting : rows.sittings(trainee.id)) {
      const bool old = endOf(sitting) < oldest_rows;
      of.nothing_left = of.nothing_left && old;
      if (old) of.sittings.push_back(sitting);
      if (endOf(sitting) < std::max(oldest_files, oldest_rows)) of.files.push_back(sitting);
    }
    all.push_back(std::move(of));
  }
  return all;
}

Purged purge(Store& store, std::int64_t now_ms, bool really) {
  SessionFiles files(store);
  Purged purged;
  for (const KeptLongEnough& of : keptLongEnough(store.rows(), now_ms)) {
    for (const SittingRow& sitting : of.files) {
      if (files.filesOf(sitting.id).empty()) continue;
      ++purged.files;
      if (!really) continue;
      removeFilesOf(files, sitting.id);
      store.rows().sql().change("UPDATE session SET file = '' WHERE id = $1", {sitting.id});
    }
    purged.sittings += static_cast<int>(of.sittings.size());
    purged.trainees += of.nothing_left ? 1 : 0;
    if (!really) continue;
    for (const SittingRow& sitting : of.sittings) purgeRows(store, sitting);
    if (of.nothing_left) forget(store, of.trainee, "purge", Tell::nobody);
  }
  if (really) forgetSentBytes(store.rows().sql());
  if (really && purged.sittings + purged.files + purged.trainees > 0) {
    store.rows().note(utcMs(), "purge", "purged", std::to_string(purged.sittings) + " sittings");
    sweepFile(store);
  }
  return purged;
}

void forgetSentBytes(Sql& sql) {
  sql.change("DELETE FROM setting WHERE name LIKE $1", {std::string(kSentBytesSetting) + "%"});
}

}  // namespace palpate::training

#include "palpate/training/records/deletion.h"

#include <map>

#include "palpate/base/error.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::training {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kDayMs = 86'400'000;

int removeSessionFiles(const RecordingFiles& files, const Uuid& session) {
  int removed = 0;
  for (const fs::path& file : files.sessionFiles(session)) removed += fs::remove(file) ? 1 : 0;
  return removed;
}

/// Drops the outbox rows of this session and its parts.
void forgetWaiting(Store& store, const Uuid& session) {
  Sql& sql = store.rows().sql();
  const auto forget = [&sql](const Uuid& id) { sql.change("DELETE FROM outbox WHERE subject = $1", {id}); };
  forget(session);
  sql.change("DELETE FROM outbox WHERE subject IN (SELECT id FROM trial WHERE session_id = $1)", {session});
  for (const EventRow& event : store.events(session)) forget(event.id);
  for (const BlockRow& block : store.blocks(session)) {
    forget(block.id);
    for (const TrialRow& trial : store.trials(block.id)) forget(trial.id);
  }
}

/// In a class's records: what stations still send of this session is known by it (its collector).
void noteParts(Store& store, const SessionRow& session) {
  const auto note = [&store](const Uuid& id) { store.rows().note(utcMs(), "collector", "deleted", deletedMark(id)); };
  for (const BlockRow& block : store.blocks(session.id)) note(block.id);
  note(session.id);
}

/// Deleted rows are overwritten where they stood (secure_delete); copies of their pages are in the log, and in free
/// pages of before it was switched on.
void sweepFile(Store& store) { store.rows().sql().run("VACUUM; PRAGMA wal_checkpoint(TRUNCATE)"); }

std::int64_t sessionEndMs(const SessionRow& session) { return std::max(session.start_ms, session.end_ms); }

enum class Notify : std::uint8_t { no_one, the_class };

/// Deletes files and rows of a known trainee.
Deleted deleteRecords(Store& store, const TraineeRow& trainee, std::string_view actor, Notify notify) {
  RecordingFiles files(store);
  Deleted deleted{.found = true};
  if (!trainee.key_ref.empty()) deleted.key = files.vault().destroy(trainee.key_ref);
  const std::vector<SessionRow> sessions = store.sessions(trainee.id);
  for (const SessionRow& session : sessions) deleted.files += removeSessionFiles(files, session.id);

  RowTables& rows = store.rows();
  const std::int64_t trials_before = rows.trialCount();
  SqlTransaction transaction(rows.sql());
  for (const SessionRow& session : sessions) {
    if (notify == Notify::the_class && store.holdsCopies()) noteParts(store, session);
    forgetWaiting(store, session.id);
  }
  rows.sql().change("DELETE FROM outbox WHERE subject = $1", {trainee.id});
  rows.erase(trainee.id);
  if (notify == Notify::the_class) {
    const std::int64_t now = utcMs();
    rows.note(now, actor, "deleted", deletedMark(trainee.id));
    if (store.fillsOutbox()) store.queueDeletion({deletedMark(trainee.id), now});
  }
  transaction.commit();
  deleted.sessions = static_cast<int>(sessions.size());
  deleted.trials = static_cast<int>(trials_before - rows.trialCount());
  return deleted;
}

void purgeRows(Store& store, const SessionRow& session) {
  SqlTransaction transaction(store.rows().sql());
  forgetWaiting(store, session.id);
  store.rows().sql().change("DELETE FROM session WHERE id = $1", {session.id});
  transaction.commit();
}

}  // namespace

Deleted deleteTrainee(Store& store, const Uuid& trainee, std::string_view actor) {
  const std::optional<TraineeRow> row = store.trainee(trainee);
  if (!row) return {};
  const Deleted deleted = deleteRecords(store, *row, actor, Notify::the_class);
  sweepFile(store);
  return deleted;
}

std::vector<KeptLongEnough> findExpired(RowTables& rows, std::int64_t now_ms) {
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
    for (const SessionRow& session : rows.sessions(trainee.id)) {
      const bool old = sessionEndMs(session) < oldest_rows;
      of.nothing_left = of.nothing_left && old;
      if (old) of.sessions.push_back(session);
      if (sessionEndMs(session) < std::max(oldest_files, oldest_rows)) of.files.push_back(session);
    }
    all.push_back(std::move(of));
  }
  return all;
}

Purged purge(Store& store, std::int64_t now_ms, bool really) {
  RecordingFiles files(store);
  Purged purged;
  for (const KeptLongEnough& of : findExpired(store.rows(), now_ms)) {
    for (const SessionRow& session : of.files) {
      if (files.sessionFiles(session.id).empty()) continue;
      ++purged.files;
      if (!really) continue;
      removeSessionFiles(files, session.id);
      store.rows().sql().change("UPDATE session SET file = '' WHERE id = $1", {session.id});
    }
    purged.sessions += static_cast<int>(of.sessions.size());
    purged.trainees += of.nothing_left ? 1 : 0;
    if (!really) continue;
    for (const SessionRow& session : of.sessions) purgeRows(store, session);
    if (of.nothing_left) deleteRecords(store, of.trainee, "purge", Notify::no_one);
  }
  if (really) forgetSentBytes(store.rows().sql());
  if (really && purged.sessions + purged.files + purged.trainees > 0) {
    store.rows().note(utcMs(), "purge", "purged", std::to_string(purged.sessions) + " sessions");
    sweepFile(store);
  }
  return purged;
}

void forgetSentBytes(Sql& sql) {
  sql.change("DELETE FROM setting WHERE name LIKE $1", {std::string(kSentBytesSetting) + "%"});
}

}  // namespace palpate::training

#include "palpate/classroom/class_store.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "palpate/training/records/trainee_code.h"

namespace palpate::classroom {

namespace {

using training::AnyRow;
using training::BlockRow;
using training::DeletionRow;
using training::EventRow;
using training::SittingRow;
using training::TraineeRow;
using training::TrialRow;
using training::Uuid;

constexpr std::string_view kDeletedAction = "deleted";
/// Numbers of notes that another program may have drawn and not committed yet when later ones were read.
constexpr std::int64_t kNotesUnderWay = 1000;

/// Rows after those that they refer to, however they arrived; deletions first, so that they hold for what follows.
std::vector<std::size_t> orderOfKeeping(std::span<const AnyRow> rows) {
  // By AnyRow's alternatives: station, class, trainee, protocol, session, block, trial, event, delete.
  constexpr std::array<int, std::variant_size_v<AnyRow>> kTurn = {1, 1, 2, 1, 3, 4, 5, 5, 0};
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return kTurn[rows[i].index()]; });
  return order;
}

}  // namespace

ClassStore::ClassStore(std::string connection) : sql_(std::move(connection)), tables_(sql_) { reconnect(); }

void ClassStore::reconnect() {
  sql_.connect();
  training::bringForward(sql_, "the class's database");
}

void ClassStore::learnDeletions() {
  for (const auto& row : sql_.ask("SELECT number, subject, at_ms FROM audit WHERE number > $1 AND action = $2",
                                  {last_note_ - kNotesUnderWay, std::string(kDeletedAction)})) {
    last_note_ = std::max(last_note_, std::get<std::int64_t>(row[0]));
    std::int64_t& at = deleted_[std::get<std::string>(row[1])];
    at = std::max(at, std::get<std::int64_t>(row[2]));
  }
}

void ClassStore::forgetDeletions() {
  deleted_.clear();
  last_note_ = 0;
}

bool ClassStore::belongsToDeleted(const AnyRow& row) const {
  if (deleted_.empty()) return false;
  const auto gone = [this](const Uuid& id) {
    const auto found = deleted_.find(training::deletedMark(id));
    return found == deleted_.end() ? std::nullopt : std::optional(found->second);
  };
  if (const auto* trainee = std::get_if<TraineeRow>(&row)) {
    const auto at = gone(trainee->id);
    return at && trainee->created_ms <= *at;  // later: the same code has signed in anew
  }
  if (const auto* sitting = std::get_if<SittingRow>(&row)) {
    const auto at = gone(sitting->trainee);
    return at && sitting->start_ms <= *at;
  }
  if (const auto* block = std::get_if<BlockRow>(&row)) return gone(block->sitting).has_value();
  if (const auto* trial = std::get_if<TrialRow>(&row)) return gone(trial->block) || gone(trial->sitting);
  if (const auto* event = std::get_if<EventRow>(&row)) return gone(event->sitting).has_value();
  return false;
}

void ClassStore::keepOne(const AnyRow& row) {
  if (const auto* deletion = std::get_if<DeletionRow>(&row)) {
    obey(*deletion);
    return;
  }
  if (!belongsToDeleted(row)) {
    tables_.keep(row, training::RowTables::Update::when_newer);
    return;
  }
  // What belongs to it will come as well, and is to be known by it.
  const bool has_parts = std::holds_alternative<SittingRow>(row) || std::holds_alternative<BlockRow>(row);
  const std::string mark = training::deletedMark(training::idOf(row));
  if (has_parts && !deleted_.contains(mark)) {
    tables_.note(training::utcMs(), "collector", kDeletedAction, mark);
    learnDeletions();
  }
}

void ClassStore::obey(const DeletionRow& deletion) {
  const auto at = tables_.noted(kDeletedAction, deletion.trainee_sha256);
  if (at && *at >= deletion.at_ms) return;  // sent again
  for (const TraineeRow& trainee : tables_.trainees()) {
    const bool meant = training::deletedMark(trainee.id) == deletion.trainee_sha256;
    if (meant && trainee.created_ms <= deletion.at_ms) eraseRows(trainee.id, deletion.at_ms, "station");
  }
  if (!tables_.noted(kDeletedAction, deletion.trainee_sha256)) {
    tables_.note(deletion.at_ms, "station", kDeletedAction, deletion.trainee_sha256);
  }
  learnDeletions();
}

void ClassStore::eraseRows(const Uuid& trainee, std::int64_t at_ms, std::string_view actor) {
  for (const SittingRow& sitting : tables_.sittings(trainee)) {
    for (const BlockRow& block : tables_.blocks(sitting.id)) {
      tables_.note(at_ms, actor, kDeletedAction, training::deletedMark(block.id));
    }
    tables_.note(at_ms, actor, kDeletedAction, training::deletedMark(sitting.id));
  }
  tables_.note(at_ms, actor, kDeletedAction, training::deletedMark(trainee));
  sweeps_ = tables_.erase(trainee) || sweeps_;
}

void ClassStore::sweep() {
  if (!sweeps_) return;
  // Deleted rows stay in the server's files until a table is written anew. Seconds, for a class.
  for (const char* table : {"trainee", "session", "block", "trial", "site_visit", "event"}) {
    sql_.run(std::string("VACUUM (FULL) ") + table);
  }
  sweeps_ = false;
}

std::vector<std::size_t> ClassStore::refusedOneByOne(std::span<const AnyRow> rows, std::span<const std::size_t> order,
                                                     Kept& kept) {
  std::vector<std::size_t> refused;
  for (const std::size_t i : order) {
    sql_.run("SAVEPOINT one");
    try {
      keepOne(rows[i]);
      sql_.run("RELEASE SAVEPOINT one");
    } catch (const DatabaseAway&) {
      throw;
    } catch (const Error& error) {
      sql_.run("ROLLBACK TO SAVEPOINT one");
      forgetDeletions();
      learnDeletions();
      kept.refused.push_back({training::outboxKey(rows[i]), error.what()});
      refused.push_back(i);
    }
  }
  return refused;
}

ClassStore::Kept ClassStore::keep(std::span<const AnyRow> rows) {
  Kept kept;
  const std::vector<std::size_t> order = orderOfKeeping(rows);
  std::vector<std::size_t> refused;
  try {
    training::SqlTransaction transaction(sql_);
    learnDeletions();
    for (const std::size_t i : order) keepOne(rows[i]);
    transaction.commit();
  } catch (const DatabaseAway&) {
    forgetDeletions();  // what was learned may have been undone
    throw;
  } catch (const Error&) {  // one of them spoils the batch: which one is found row by row
    forgetDeletions();
    training::SqlTransaction transaction(sql_);
    learnDeletions();
    refused = refusedOneByOne(rows, order, kept);
    transaction.commit();
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (std::ranges::find(refused, i) == refused.end()) kept.keys.push_back(training::outboxKey(rows[i]));
  }
  sweep();
  return kept;
}

bool ClassStore::erase(const Uuid& trainee, std::string_view actor) {
  training::SqlTransaction transaction(sql_);
  const bool there = tables_.trainee(trainee).has_value();
  eraseRows(trainee, training::utcMs(), actor);
  transaction.commit();
  sweep();
  return there;
}

training::Purged ClassStore::purge(std::int64_t now_ms) {
  training::Purged purged;
  training::SqlTransaction transaction(sql_);
  for (const training::KeptLongEnough& of : training::keptLongEnough(tables_, now_ms)) {
    for (const SittingRow& sitting : of.sittings) sql_.change("DELETE FROM session WHERE id = $1", {sitting.id});
    purged.sittings += static_cast<int>(of.sittings.size());
    if (of.nothing_left) purged.trainees += tables_.erase(of.trainee.id) ? 1 : 0;
  }
  sweeps_ = sweeps_ || purged.sittings + purged.trainees > 0;
  if (sweeps_) tables_.note(training::utcMs(), "purge", "purged", std::to_string(purged.sittings) + " sittings");
  transaction.commit();
  sweep();
  return purged;
}

}  // namespace palpate::classroom

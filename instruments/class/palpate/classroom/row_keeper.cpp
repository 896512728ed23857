#include "palpate/classroom/row_keeper.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/training/records/deletion.h"
#include "palpate/training/records/row_fields.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::classroom {

namespace {

using training::AnyRow;
using training::BlockRow;
using training::ClassRow;
using training::DeletionRow;
using training::EventRow;
using training::SessionRow;
using training::StationRow;
using training::TraineeRow;
using training::TrialRow;
using training::Uuid;

constexpr std::string_view kDeletedAction = "deleted";
/// In the audit, before a station's id: its own notice, which does not concern other stations' rows.
constexpr std::string_view kStationActor = "station";
/// In the audit: a session or a block that was dropped, so that what belongs to it is known by it.
constexpr std::string_view kPartsActor = "collector";
/// Numbers of notes that another program may have drawn and not committed yet when later ones were read.
constexpr std::int64_t kNotesUnderWay = 1000;
constexpr std::size_t kMaxRowsRemembered = 20000;
/// Bytes of keys, indices and visits in addition to the row itself.
constexpr std::int64_t kRowOverheadBytes = 200;

/// Rows after those that they refer to, however they arrived, but never across a deletion: that is where order counts.
std::vector<std::size_t> insertionOrder(std::span<const SentRow> rows) {
  // Order of AnyRow's alternatives: station, class, trainee, protocol, session, block, trial, event, delete.
  constexpr std::array<int, std::variant_size_v<AnyRow>> kRank = {1, 1, 2, 1, 3, 4, 5, 5, 0};
  std::vector<std::pair<int, int>> ranks;
  int part = 0;
  for (const SentRow& sent : rows) {
    const bool deletes = std::holds_alternative<DeletionRow>(sent.row);
    part += deletes ? 1 : 0;
    ranks.emplace_back(part, kRank[sent.row.index()]);
  }
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return ranks[i]; });
  return order;
}

/// The latest of its times.
std::int64_t latestMs(const AnyRow& row) {
  if (std::holds_alternative<DeletionRow>(row)) return 0;  // goes by the order of arrival
  std::int64_t latest = 0;
  std::visit(
      [&](const auto& held) {
        training::eachField(
            [&]<class Value>(std::string_view name, const Value& value, const training::FieldRule& /*rule*/) {
              if constexpr (std::same_as<Value, std::int64_t>) {
                if (name.ends_with("_ms")) latest = std::max(latest, value);
              }
            },
            held);
      },
      row);
  return latest;
}

/// Made from the station's name by any computer, so it is unique. Others were made at random before a station joined.
bool isNamedStation(const Uuid& id) { return id.size() == 36 && id[14] == '8'; }

template <class Map>
void boundMap(Map& map) {
  if (map.size() > kMaxRowsRemembered) map.clear();
}

std::string called(const SentRow& sent) { return sent.name.empty() ? std::string("the teacher") : sent.name; }

}  // namespace

// --- deletions

void RowKeeper::loadTombstones() {
  for (const auto& row :
       tables_.sql().ask("SELECT number, actor, subject FROM audit WHERE number > $1 AND action = $2 ORDER BY number",
                         {last_note_ - kNotesUnderWay, std::string(kDeletedAction)})) {
    const std::int64_t number = std::get<std::int64_t>(row[0]);
    const auto& actor = std::get<std::string>(row[1]);
    const auto& mark = std::get<std::string>(row[2]);
    last_note_ = std::max(last_note_, number);
    marks_[mark] = number;
    if (actor.starts_with(kStationActor)) {
      // A station's own notice, of older versions without its id.
      if (actor.size() > kStationActor.size() + 1) notified_[{mark, actor.substr(kStationActor.size() + 1)}] = number;
      continue;
    }
    if (actor != kPartsActor) for_all_[mark] = number;
  }
}

void RowKeeper::forget() {
  marks_.clear();
  for_all_.clear();
  notified_.clear();
  last_note_ = 0;
  station_owner_.clear();
  session_owner_.clear();
  block_session_.clear();
  bytes_.clear();
}

bool RowKeeper::isDeletedFor(const std::string& mark, const Uuid& station) const {
  const auto deleted = for_all_.find(mark);
  if (deleted == for_all_.end()) return false;
  const auto notified = notified_.find({mark, station});
  return notified == notified_.end() || notified->second < deleted->second;
}

bool RowKeeper::belongsToDeleted(const AnyRow& row, const Uuid& station) const {
  if (marks_.empty()) return false;
  const auto gone = [this](const Uuid& id) { return marks_.contains(training::deletedMark(id)); };
  if (const auto* trainee = std::get_if<TraineeRow>(&row)) {
    return isDeletedFor(training::deletedMark(trainee->id), station);
  }
  if (const auto* session = std::get_if<SessionRow>(&row)) {
    return isDeletedFor(training::deletedMark(session->trainee_id), station) || gone(session->id);
  }
  if (const auto* block = std::get_if<BlockRow>(&row)) return gone(block->session_id) || gone(block->id);
  if (const auto* trial = std::get_if<TrialRow>(&row)) return gone(trial->block_id) || gone(trial->session_id);
  if (const auto* event = std::get_if<EventRow>(&row)) return gone(event->session_id);
  return false;
}

void RowKeeper::note(std::string_view actor, const std::string& mark) {
  tables_.note(training::utcMs(), actor, kDeletedAction, mark);
}

/// Notes ids of rows whose parts will come as well.
void RowKeeper::noteParts(const AnyRow& row) {
  if (!std::holds_alternative<SessionRow>(row) && !std::holds_alternative<BlockRow>(row)) return;
  const std::string mark = training::deletedMark(training::rowId(row));
  if (marks_.contains(mark)) return;
  note(kPartsActor, mark);
  marks_[mark] = last_note_;
}

int RowKeeper::eraseSessions(const std::vector<SessionRow>& sessions) {
  for (const SessionRow& session : sessions) {
    for (const BlockRow& block : tables_.blocks(session.id)) noteParts(block);
    noteParts(session);
    tables_.sql().change("DELETE FROM session WHERE id = $1", {session.id});
  }
  erased_ = erased_ || !sessions.empty();
  session_owner_.clear();
  block_session_.clear();
  return static_cast<int>(sessions.size());
}

bool RowKeeper::erase(const Uuid& trainee, std::string_view actor) {
  loadTombstones();
  eraseSessions(tables_.sessions(trainee));
  note(actor, training::deletedMark(trainee));
  const bool there = tables_.erase(trainee);
  erased_ = erased_ || there;
  return there;
}

void RowKeeper::applyDeletion(const DeletionRow& deletion, const SentRow& sent) {
  const std::string& mark = deletion.trainee_sha256;
  const bool of_all = sent.station.empty();
  const bool only_heard = deletion.at_ms == 0 && !of_all;
  for (const TraineeRow& trainee : tables_.trainees()) {
    if (only_heard || training::deletedMark(trainee.id) != mark) continue;
    std::vector<SessionRow> theirs = tables_.sessions(trainee.id);
    std::map<Uuid, int> others;
    if (!of_all) {
      std::erase_if(theirs, [&](const SessionRow& session) {
        const Uuid owner = ownerOfStation(session.station_id);
        if (owner != sent.station) ++others[session.station_id];
        return owner != sent.station;
      });
    }
    const bool owns = of_all || ownerOfTrainee(trainee.id) == sent.station;
    const int gone = eraseSessions(theirs);
    if (others.empty() && owns) {
      erased_ = tables_.erase(trainee.id) || erased_;
      continue;
    }
    // The station with the remaining sessions owns the trainee from now on.
    if (owns) tables_.sql().change("DELETE FROM origin WHERE subject = $1", {trainee.id});
    std::string left;
    for (const StationRow& station : tables_.stations()) {
      const auto found = others.find(station.id);
      if (found == others.end()) continue;
      left += fmt::format("{}{} of {}", left.empty() ? "" : ", ", found->second, oneLine(station.name));
    }
    if (left.empty()) left = "the trainee, whom another station brought";
    reports_.push_back(
        fmt::format("{} deleted a trainee: {} of its sessions are gone; not deleted: {} (delete there too, or for all "
                    "stations with `palpate train results delete`)",
                    called(sent), gone, left));
  }
  if (of_all) {
    note("teacher", mark);
    loadTombstones();
  } else if (isDeletedFor(mark, sent.station)) {
    note(fmt::format("{} {}", kStationActor, sent.station), mark);
    loadTombstones();
  }
}

// --- whose it is

std::string RowKeeper::textOf(std::string_view sql, const Uuid& id) {
  const auto rows = tables_.sql().ask(sql, {id});
  const auto* text = rows.empty() ? nullptr : std::get_if<std::string>(&rows.front().front());
  return text == nullptr ? std::string() : *text;
}

Uuid RowKeeper::ownerOfStation(const Uuid& station) {
  if (isNamedStation(station)) return station;
  const auto found = station_owner_.find(station);
  if (found != station_owner_.end()) return found->second;
  const std::string owner = textOf("SELECT station_id FROM origin WHERE subject = $1", station);
  if (!owner.empty()) station_owner_[station] = owner;
  boundMap(station_owner_);
  return owner;
}

Uuid RowKeeper::ownerOfTrainee(const Uuid& trainee) {
  std::string owner = textOf("SELECT station_id FROM origin WHERE subject = $1", trainee);
  if (!owner.empty()) return owner;
  // For rows from before version 3, or forgotten by their own station: the owner of their first session.
  const std::string station =
      textOf("SELECT station_id FROM session WHERE trainee_id = $1 ORDER BY start_ms, id LIMIT 1", trainee);
  return station.empty() ? station : ownerOfStation(station);
}

Uuid RowKeeper::ownerOfSession(const Uuid& session) {
  const auto found = session_owner_.find(session);
  if (found != session_owner_.end()) return found->second;
  const std::string station = textOf("SELECT station_id FROM session WHERE id = $1", session);
  if (station.empty()) return {};
  const Uuid owner = ownerOfStation(station);
  boundMap(session_owner_);
  // Without a known owner no sender may change it.
  return session_owner_[session] = owner.empty() ? station : owner;
}

Uuid RowKeeper::sessionOfBlock(const Uuid& block) {
  const auto found = block_session_.find(block);
  if (found != block_session_.end()) return found->second;
  const std::string session = textOf("SELECT session_id FROM block WHERE id = $1", block);
  boundMap(block_session_);
  if (!session.empty()) block_session_[block] = session;
  return session;
}

void RowKeeper::claim(const Uuid& subject, const Uuid& station) {
  tables_.sql().change("INSERT INTO origin (subject, station_id) VALUES ($1, $2) ON CONFLICT (subject) DO NOTHING",
                       {subject, station});
}

/// Returns nothing if the row is its sender's own or unowned.
std::optional<std::string> RowKeeper::ownershipObjection(const SentRow& sent) {
  const auto other = [&](const Uuid& owner) { return !owner.empty() && owner != sent.station; };
  const auto of_other = [&](std::string_view what, const Uuid& session) -> std::optional<std::string> {
    if (!other(ownerOfSession(session))) return std::nullopt;
    return fmt::format("{} of another station", what);
  };
  if (const auto* station = std::get_if<StationRow>(&sent.row)) {
    const Uuid owner = ownerOfStation(station->id);
    if (other(owner)) return "another station's row";
    if (owner.empty() && !textOf("SELECT id FROM station WHERE id = $1", station->id).empty()) {
      return "a station of before it joined, which was in the class already";
    }
  } else if (const auto* trainee = std::get_if<TraineeRow>(&sent.row)) {
    const auto known = tables_.trainee(trainee->id);
    if (known && known->class_id != trainee->class_id && other(ownerOfTrainee(trainee->id))) {
      return "another class for a trainee of another station";
    }
  } else if (const auto* session = std::get_if<SessionRow>(&sent.row)) {
    if (ownerOfStation(session->station_id) != sent.station) return "a session at another station";
    return of_other("a session", session->id);
  } else if (const auto* block = std::get_if<BlockRow>(&sent.row)) {
    const Uuid before = sessionOfBlock(block->id);
    if (const auto why = of_other("a block", block->session_id)) return why;
    return before.empty() ? std::nullopt : of_other("a block", before);
  } else if (const auto* trial = std::get_if<TrialRow>(&sent.row)) {
    const Uuid of_block = sessionOfBlock(trial->block_id);
    if (const auto why = of_other("a trial", trial->session_id)) return why;
    return of_block.empty() ? std::nullopt : of_other("a trial", of_block);
  } else if (const auto* event = std::get_if<EventRow>(&sent.row)) {
    return of_other("an event", event->session_id);
  }
  return std::nullopt;
}

/// So that what belongs to it is answered alike, instead of waiting for it for ever.
void RowKeeper::rememberRefused(const SentRow& sent, const std::string& why) {
  const auto* trainee = std::get_if<TraineeRow>(&sent.row);
  const bool has_parts =
      trainee != nullptr ? !tables_.trainee(trainee->id)
                         : std::holds_alternative<SessionRow>(sent.row) || std::holds_alternative<BlockRow>(sent.row);
  if (!has_parts) return;
  boundMap(refused_);
  refused_[{sent.station, training::rowId(sent.row)}] = why;
}

std::optional<std::string> RowKeeper::refusedWithWhole(const SentRow& sent) const {
  if (refused_.empty()) return std::nullopt;
  const auto of = [&](const Uuid& id) -> std::optional<std::string> {
    const auto found = refused_.find({sent.station, id});
    return found == refused_.end() ? std::nullopt : std::optional(found->second);
  };
  if (const auto* session = std::get_if<SessionRow>(&sent.row)) return of(session->trainee_id);
  if (const auto* block = std::get_if<BlockRow>(&sent.row)) return of(block->session_id);
  if (const auto* event = std::get_if<EventRow>(&sent.row)) return of(event->session_id);
  const auto* trial = std::get_if<TrialRow>(&sent.row);
  if (trial == nullptr) return std::nullopt;
  const auto why = of(trial->block_id);
  return why ? why : of(trial->session_id);
}

/// Why the row is not to be kept.
std::optional<std::string> RowKeeper::objection(const SentRow& sent, std::int64_t now_ms) {
  if (sent.station.empty()) return std::nullopt;
  if (const std::int64_t ahead_ms = latestMs(sent.row) - now_ms; ahead_ms > kClockSkewMs) {
    return fmt::format("dated {} min after now: the station's clock is ahead, or the class's is slow",
                       ahead_ms / 60'000);
  }
  if (auto why = refusedWithWhole(sent)) return why;
  if (auto why = ownershipObjection(sent)) return why;
  const bool deletes = std::holds_alternative<DeletionRow>(sent.row);
  if (!deletes && bytesOf(sent.station) + static_cast<std::int64_t>(sent.bytes) > rules_.station_bytes) {
    return fmt::format(
        "the station has sent {} MB since the last purge, its share of the disk (`palpate train results purge`, or "
        "station_megabytes in class.toml)",
        rules_.station_bytes >> 20);
  }
  return std::nullopt;
}

// --- how much

std::int64_t& RowKeeper::bytesOf(const Uuid& station) {
  const auto found = bytes_.find(station);
  if (found != bytes_.end()) return found->second;
  const auto rows = tables_.sql().ask("SELECT value FROM setting WHERE name = $1",
                                      {std::string(training::kSentBytesSetting) + station});
  std::int64_t bytes = 0;
  if (!rows.empty()) {
    const auto& text = std::get<std::string>(rows.front().front());
    std::from_chars(text.data(), text.data() + text.size(), bytes);
  }
  return bytes_[station] = bytes;
}

void RowKeeper::saveBytes() {
  for (const auto& [station, bytes] : bytes_) {
    tables_.sql().change(
        "INSERT INTO setting (name, value) VALUES ($1, $2) ON CONFLICT (name) DO UPDATE SET value = excluded.value",
        {std::string(training::kSentBytesSetting) + station, std::to_string(bytes)});
  }
}

// --- keeping

void RowKeeper::write(const SentRow& sent) {
  const auto save = [&](const AnyRow& row) {
    const bool changed = tables_.save(row, training::RowTables::Update::when_newer);
    if (changed && !sent.station.empty()) {
      bytesOf(sent.station) += static_cast<std::int64_t>(sent.bytes) + kRowOverheadBytes;
    }
  };
  if (const auto* of = std::get_if<ClassRow>(&sent.row); of != nullptr && !rules_.class_id.empty()) {
    // The class's folder sets its retention; for other classes nothing here does.
    if (of->id != rules_.class_id) save(ClassRow{.id = of->id, .label = of->id});
    return;
  }
  if (sent.station.empty()) return save(sent.row);
  if (const auto* trainee = std::get_if<TraineeRow>(&sent.row)) {
    const Uuid owner = ownerOfTrainee(trainee->id);
    if (!owner.empty() && owner != sent.station) return;  // sits here too; the row stays as its own station has it
    save(sent.row);
    return claim(trainee->id, sent.station);
  }
  if (const auto* station = std::get_if<StationRow>(&sent.row)) {
    save(sent.row);
    if (!isNamedStation(station->id)) claim(station->id, sent.station);
    return;
  }
  save(sent.row);
}

RowKeeper::Verdict RowKeeper::storeOne(const SentRow& sent, std::int64_t now_ms) {
  if (auto why = objection(sent, now_ms)) {
    rememberRefused(sent, *why);
    return {RowFate::refused, std::move(*why)};
  }
  if (!refused_.empty()) refused_.erase({sent.station, training::rowId(sent.row)});
  if (const auto* deletion = std::get_if<DeletionRow>(&sent.row)) {
    applyDeletion(*deletion, sent);
  } else if (belongsToDeleted(sent.row, sent.station)) {
    noteParts(sent.row);
  } else {
    write(sent);
  }
  return {};
}

KeptRows RowKeeper::storeEach(std::span<const SentRow> rows, std::span<const std::size_t> order, bool savepoints) {
  const std::int64_t now_ms = training::utcMs();
  std::vector<Verdict> verdicts(rows.size());
  bytes_.clear();
  reports_.clear();
  for (const std::size_t i : order) {
    if (!savepoints) {
      verdicts[i] = storeOne(rows[i], now_ms);
      continue;
    }
    tables_.sql().run("SAVEPOINT one");
    try {
      verdicts[i] = storeOne(rows[i], now_ms);
      tables_.sql().run("RELEASE SAVEPOINT one");
    } catch (const training::DatabaseAway&) {
      throw;
    } catch (const Error& error) {
      tables_.sql().run("ROLLBACK TO SAVEPOINT one");
      saveBytes();
      forget();
      loadTombstones();
      verdicts[i] = {RowFate::waits, error.what()};
    }
  }
  KeptRows kept;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Verdict& verdict = verdicts[i];
    kept.fates.push_back(verdict.fate);
    Uuid key = training::outboxKey(rows[i].row);
    if (verdict.fate == RowFate::kept) kept.keys.push_back(std::move(key));
    if (verdict.fate == RowFate::waits) kept.waits.push_back({std::move(key), verdict.why});
    if (verdict.fate == RowFate::refused) kept.refused.push_back({std::move(key), verdict.why});
  }
  for (const SentRow& sent : rows) {
    if (sent.station.empty() || kept.notices.contains(sent.station)) continue;
    auto& marks = kept.notices[sent.station];
    for (const auto& [mark, number] : for_all_) {
      if (isDeletedFor(mark, sent.station)) marks.push_back(mark);
    }
  }
  std::erase_if(kept.notices, [](const auto& one) { return one.second.empty(); });
  saveBytes();
  kept.reports = std::exchange(reports_, {});
  return kept;
}

KeptRows RowKeeper::save(std::span<const SentRow> rows) {
  const std::vector<std::size_t> order = insertionOrder(rows);
  // One of them may spoil the batch; which one is then found row by row.
  for (const bool savepoints : {false, true}) {
    try {
      training::SqlTransaction transaction(tables_.sql());
      loadTombstones();
      KeptRows kept = storeEach(rows, order, savepoints);
      transaction.commit();
      return kept;
    } catch (const training::DatabaseAway&) {
      forget();
      throw;
    } catch (const Error&) {
      forget();
      if (savepoints) throw;
    }
  }
  return {};
}

}  // namespace palpate::classroom

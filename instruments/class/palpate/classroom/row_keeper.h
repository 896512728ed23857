// Decides which rows a class keeps, the same in both of its databases: a station's own, none of a deleted trainee, none
// that are dated after now, and no more than a station's share of the disk.
//
//   rows, each with who sent it ─ save, one transaction ─► RowTables, and what became of each row
//
// A row belongs to the station that first sent it; what belongs to a session belongs to the session's station. A
// deletion goes by identity and by order of arrival, never by a clock:
//   - a station's notice takes away what that station has sent so far; whatever it sends later is of a later sign-in;
//   - a deletion in the class's own records (or by the teacher's certificate) holds for every station until that
// station reports that it has received it (a notice with at_ms = 0). Rows sent after that are of a later sign-in.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/training/records/row_tables.h"

namespace palpate::classroom {

/// A row and who sent it.
struct SentRow {
  training::AnyRow row;
  training::Uuid station = {};  ///< by its certificate (deriveStationId); empty: the teacher, who may write all rows
  std::string name = {};        ///< station's name in messages
  std::size_t bytes = 0;        ///< as it came
};

enum class RowFate : std::uint8_t {
  kept,     ///< in the database, or of a deleted trainee: to be acknowledged
  waits,    ///< its parent has not come yet, or it contradicts another row: sent again, it may be kept
  refused,  ///< not its sender's, dated after now, or beyond its sender's share: to be answered
};
struct NotKept {
  training::Uuid key;  ///< training::outboxKey
  std::string why;
};
struct KeptRows {
  std::vector<RowFate> fates;        ///< one per row, in order
  std::vector<training::Uuid> keys;  ///< outbox keys of those that were kept, in order
  std::vector<NotKept> waits;
  std::vector<NotKept> refused;
  std::vector<std::string> reports;  ///< remains of a deletion, for people to read
  /// Deletions to report to a station, by the station's id: training::deletedMark.
  std::map<training::Uuid, std::vector<std::string>> notices;
};

/// Largest difference between the clocks of a class.
inline constexpr std::int64_t kClockSkewMs = 120'000;
/// A station's share of the class's disk: some 170,000 trials.
inline constexpr std::int64_t kStationBytes = std::int64_t{256} << 20;

struct KeeperRules {
  std::string class_id = {};  ///< other classes' rows are kept with the standard retention; empty: of any class
  std::int64_t station_bytes = kStationBytes;  ///< limit of rows since the last purge
};

/// One thread, as the tables.
class RowKeeper {
 public:
  explicit RowKeeper(training::RowTables& tables, KeeperRules rules = {}) : tables_(tables), rules_(std::move(rules)) {}

  /// One transaction. Throws DatabaseAway; nothing was kept then, as far as is known.
  KeptRows save(std::span<const SentRow> rows);

  /// Deletes everything of the trainee, for every station, in the caller's transaction. Returns false if unknown.
  bool erase(const training::Uuid& trainee, std::string_view actor);

  /// Rows were deleted since the last time this was asked.
  bool consumeErased() { return std::exchange(erased_, false); }

 private:
  struct Verdict {
    RowFate fate = RowFate::kept;
    std::string why = {};
  };
  Verdict storeOne(const SentRow& sent, std::int64_t now_ms);
  std::optional<std::string> objection(const SentRow& sent, std::int64_t now_ms);
  std::optional<std::string> ownershipObjection(const SentRow& sent);
  void rememberRefused(const SentRow& sent, const std::string& why);
  std::optional<std::string> refusedWithWhole(const SentRow& sent) const;
  bool belongsToDeleted(const training::AnyRow& row, const training::Uuid& station) const;
  bool isDeletedFor(const std::string& mark, const training::Uuid& station) const;
  void noteParts(const training::AnyRow& row);
  void write(const SentRow& sent);
  void claim(const training::Uuid& subject, const training::Uuid& station);

  void applyDeletion(const training::DeletionRow& deletion, const SentRow& sent);
  int eraseSessions(const std::vector<training::SessionRow>& sessions);
  void note(std::string_view actor, const std::string& mark);

  training::Uuid ownerOfStation(const training::Uuid& station);
  training::Uuid ownerOfTrainee(const training::Uuid& trainee);
  training::Uuid ownerOfSession(const training::Uuid& session);
  training::Uuid sessionOfBlock(const training::Uuid& block);
  /// The first column of the first row; empty: none.
  std::string textOf(std::string_view sql, const training::Uuid& id);

  std::int64_t& bytesOf(const training::Uuid& station);
  void saveBytes();

  /// Reads the deletions made since the last time: once per batch instead of once per row.
  void loadTombstones();
  /// Discards what was learned, since it may have been rolled back.
  void forget();
  KeptRows storeEach(std::span<const SentRow> rows, std::span<const std::size_t> order, bool savepoints);

  training::RowTables& tables_;
  KeeperRules rules_;

  // Notes of the audit by number, which is the order of arrival.
  std::int64_t last_note_ = 0;
  std::map<std::string, std::int64_t, std::less<>> marks_;                ///< marks of deletions
  std::map<std::string, std::int64_t, std::less<>> for_all_;              ///< trainees deleted for every station
  std::map<std::pair<std::string, std::string>, std::int64_t> notified_;  ///< mark, station

  // Found before; forgotten when they are many, and whenever something is deleted.
  std::map<training::Uuid, training::Uuid> station_owner_;
  std::map<training::Uuid, training::Uuid> session_owner_;
  std::map<training::Uuid, training::Uuid> block_session_;
  std::map<training::Uuid, std::int64_t> bytes_;
  /// Trainees, sessions and blocks that a station was refused: so is what belongs to them.
  std::map<std::pair<training::Uuid, training::Uuid>, std::string> refused_;
  std::vector<std::string> reports_;
  bool erased_ = false;
};

}  // namespace palpate::classroom

// Rows as JSON: what waits in the outbox, travels to a class, and is exported. Names are those of the database's
// columns (docs/reference/results-schema.md).
//
//   AnyRow ─ rowJson ─► outbox, MQTT, exports        text from a network ─ rowFromJson (checks all) ─► AnyRow
//
// An acknowledgement names the `outboxKey`, never the row's id alone: a block changes after every trial, and the
// acknowledgement of what it was must not take away the newer one that still waits.
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <variant>

#include "palpate/training/records/rows.h"

namespace palpate::training {

/// "Delete whatever you have of this trainee." Names the trainee by a hash, so that a station that has deleted them
/// does not keep their id, not even in this notice.
struct DeletionRow {
  std::string trainee_sha256;  ///< deletedMark(id)
  std::int64_t at_ms = 0;      ///< for people; 0: a station has heard of a deletion in the class, and requests none
};

using AnyRow =
    std::variant<StationRow, ClassRow, TraineeRow, ProtocolRow, SessionRow, BlockRow, TrialRow, EventRow, DeletionRow>;

AnyRow anyRow(const Row& row);

/// The table's name: "station", "class", "trainee", "protocol", "session", "block", "trial", "event"; "delete".
std::string_view kindOf(const AnyRow& row);
/// The primary key; of a protocol "vhb@1", of a deletion the hash.
std::string rowId(const AnyRow& row);

/// In one line.
std::string rowJson(const AnyRow& row);
std::string rowJson(const Row& row);
template <class R>
requires(!std::same_as<R, AnyRow> && !std::same_as<R, Row> && std::constructible_from<AnyRow, const R&>) std::string
    rowJson(const R& row) {
  return rowJson(AnyRow(row));
}

/// Text is longer than no honest row.
inline constexpr std::size_t kLongestRowJson = 65536;

/// Trusts nothing: unknown or missing keys, wrong types, numbers out of range, invalid ids, paths that lead elsewhere
/// are refused. Throws Error ("trial: 'change' is 7, not within 0 to 1").
AnyRow rowFromJson(std::string_view kind, std::string_view text);

/// The key in OutboxEntry::row and in an acknowledgement: the id of a trial or event, which never changes; else a UUID
/// made of kind and content. Equal for a sent row and the row that arrives.
Uuid outboxKey(const AnyRow& row);

/// The hash by which a deleted trainee, session or block is remembered: it finds only those who are known already.
std::string deletedMark(std::string_view id);

}  // namespace palpate::training

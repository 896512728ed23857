// Forgetting: one trainee altogether, or rows that a class has kept for long enough.
//
//   deleteTrainee: key ─ recordings ─ rows ─ what waits for the class ─ a notice to the class ─ the file rewritten
//
//   purge: what findExpired says, of each trainee; without notice to others
//
// In this order, a power cut in between leaves nothing readable that the records do not know: doing it again finishes
// it. Exports and copies elsewhere remain; a class learns by the notice.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "palpate/training/records/recording_files.h"
#include "palpate/training/records/store.h"

namespace palpate::training {

struct Deleted {
  bool found = false;
  int sessions = 0;
  int trials = 0;
  int files = 0;
  bool key = false;
};

/// Afterwards no byte of the store's folder reveals who it was; the audit holds a hash. The rows of others stay as they
/// are. Throws Error.
Deleted deleteTrainee(Store& store, const Uuid& trainee, std::string_view actor);

/// Data of one trainee kept for as long as their class said.
struct KeptLongEnough {
  TraineeRow trainee;
  std::vector<SessionRow> sessions;  ///< rows to delete
  std::vector<SessionRow> files;     ///< recordings to delete: of these, and of younger ones
  bool nothing_left = false;         ///< the trainee goes too
};
/// By the days of each trainee's class; of trainees without one nothing. `now_ms`: since 1970.
std::vector<KeptLongEnough> findExpired(RowTables& rows, std::int64_t now_ms);

struct Purged {
  int sessions = 0;  ///< with their rows, older than the class keeps them
  int files = 0;     ///< recordings, older than the class keeps those
  int trainees = 0;  ///< trainees of whom nothing was left
};

/// Forgets what `findExpired` says, without notice to a class: it keeps what it has by its own days, and the trainee
/// may have trained elsewhere since. `really`: else it is only counted.
Purged purge(Store& store, std::int64_t now_ms, bool really);

/// Setting of a class's records: bytes that a station has sent since the last purge, this name with the station's id.
inline constexpr std::string_view kSentBytesSetting = "sent_bytes/";
/// In the caller's transaction: every station's share of the disk begins again.
void forgetSentBytes(Sql& sql);

}  // namespace palpate::training

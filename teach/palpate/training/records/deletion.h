// Forgetting: one trainee altogether, or what a class has kept for long enough.
//
//   deleteTrainee: key ─ recordings ─ rows ─ what waits for the class ─ a notice to the class ─ the file rewritten
//
//   purge: what keptLongEnough says, of each trainee; nobody else is told
//
// In this order, so that after a power cut in between nothing readable is left that nobody knows of: doing it again
// finishes it. What was exported or sent elsewhere is elsewhere; a class learns by the notice.
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

/// Afterwards no byte of the store's folder says who it was; the audit holds a hash. The rows of others stay as they
/// are. Throws Error.
Deleted deleteTrainee(Store& store, const Uuid& trainee, std::string_view actor);

/// What has been kept of one trainee for as long as their class said.
struct KeptLongEnough {
  TraineeRow trainee;
  std::vector<SessionRow> sessions;  ///< whose rows are to go
  std::vector<SessionRow> files;     ///< whose recordings are to go: these, and younger ones
  bool nothing_left = false;         ///< the trainee goes too
};
/// By the days of each trainee's class; of trainees without one nothing. `now_ms`: since 1970.
std::vector<KeptLongEnough> keptLongEnough(RowTables& rows, std::int64_t now_ms);

struct Purged {
  int sessions = 0;  ///< with their rows, older than the class keeps them
  int files = 0;     ///< recordings, older than the class keeps those
  int trainees = 0;  ///< of whom nothing was left
};

/// Forgets what `keptLongEnough` says. A class is told nothing: it keeps what it has by its own days, and who is gone
/// here may have sat elsewhere since. `really`: else it is only counted.
Purged purge(Store& store, std::int64_t now_ms, bool really);

/// Of a class's records: how many bytes a station has sent since the last purge, under this name with the station's id.
inline constexpr std::string_view kSentBytesSetting = "sent_bytes/";
/// In the caller's transaction: every station's share of the disk begins again.
void forgetSentBytes(Sql& sql);

}  // namespace palpate::training

// The stored rows of training: plain data, the columns of docs/reference/results-schema.md. The same rows go into
// SQLite on the station, over the wire, and into PostgreSQL of a class.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "palpate/training/block.h"
#include "palpate/training/exploration.h"
#include "palpate/training/protocol.h"

namespace palpate::training {

/// "018f3c1e-...": version 7 (time and chance) for rows of a station, version 8 for trainees (trainee_code.h).
using Uuid = std::string;

struct StationRow {
  Uuid id = {};
  std::string name = {};
  std::string certificate_sha256 = {};  ///< empty: none
  std::string device = {};
  std::int64_t calibrated_ms = 0;  ///< 0: never
};

struct ClassRow {
  std::string id = {};  ///< a word: "osteo-1"
  std::string label = {};
  int retain_days = 365;
  int retain_samples_days = 90;
};

/// No name, mail or birth date: a code, kept by the trainee and on the teacher's own list.
struct TraineeRow {
  Uuid id = {};
  std::string class_id = {};  ///< empty: none
  std::int64_t created_ms = 0;
  std::string dominant_hand = {};  ///< "left", "right", empty: unknown
  bool consent = false;
  std::string key_ref = {};  ///< name of the key of their recordings; empty: none
};

struct ProtocolRow {
  std::string id = {};  ///< "vhb"
  int version = 1;
  std::string text = {};  ///< protocolText
  std::string sha256 = {};
};

struct SessionRow {
  Uuid id = {};
  Uuid trainee_id = {};
  Uuid station_id = {};
  SessionKind kind = SessionKind::practice;
  std::int64_t start_ms = 0;
  std::int64_t end_ms = 0;  ///< 0: still running, or cut off
  std::string app_version = {};
  std::uint64_t rng_seed = 0;
  std::string device = {};       ///< with its thimble: thresholds belong to it
  std::string file = {};         ///< recording, relative to the records' folder; empty: none
  std::string file_sha256 = {};  ///< empty until it is finished
};

struct BlockRow {
  Uuid id = {};
  Uuid session_id = {};
  int number = 1;
  Method method = Method::marginal_psi;
  ChangeMeaning change_meaning = ChangeMeaning::compliance;
  std::string protocol_id = {};
  int protocol_version = 1;
  std::string state_json = {};  ///< Block::state: continues from here
  bool finished = false;
  // From Block::result, so far.
  double threshold = 0.0, threshold_low = 0.0, threshold_high = 0.0;
  int trials = 0;
  std::optional<double> mastered_change = {};
  Verdict verdict = Verdict::none;

  /// Copies the block's current state and result.
  void copyStateFrom(const Block& block) {
    const BlockResult so_far = block.result();
    state_json = block.state();
    finished = block.finished();
    threshold = so_far.threshold.median;
    threshold_low = so_far.threshold.low;
    threshold_high = so_far.threshold.high;
    trials = so_far.trials;
    mastered_change = so_far.level;
    verdict = so_far.verdict;
  }
};

struct TrialRow {
  Uuid id = {};
  Uuid block_id = {};
  Uuid session_id = {};  ///< in whose recording it lies: a block may be taken up again in a later session
  int number = 0;        ///< in the block, from 1
  std::int64_t start_ms = 0, end_ms = 0;
  double seconds = 0.0;  ///< without pauses
  TrialKind kind = TrialKind::measured;
  double change = 0.0;
  int site_true = 0;
  int site_answer = 0;  ///< 0: none
  bool correct = false;
  bool timed_out = false;
  std::string excluded = {};                              ///< why it does not count; empty: it counts
  int sites_felt = 0;                                     ///< sites that were felt
  std::uint64_t file_tick_first = 0, file_tick_last = 0;  ///< in the session's recording
  // Over all samples of the trial, for reports without the recording.
  double mean_force_n = 0.0, peak_force_n = 0.0, mean_speed_mm_per_s = 0.0;
  double search_force_n = 0.0, palpate_force_n = 0.0;  ///< mean while moving (over 20 mm/s) and while staying
  /// In a session with lumps, what this body hid and what was answered (lumps::lumpTrialText); else empty.
  std::string lumps = {};
  std::vector<SiteVisit> visits = {};
};

struct EventRow {
  Uuid id = {};
  Uuid session_id = {};
  std::int64_t at_ms = 0;
  std::string kind = {};  ///< pause, resume, safety, screen, message, warning
  std::string text = {};
};

/// A block row comes before its first trial and, with its new state, after each; a session row first and at its end.
using Row = std::variant<SessionRow, BlockRow, TrialRow, EventRow>;

}  // namespace palpate::training

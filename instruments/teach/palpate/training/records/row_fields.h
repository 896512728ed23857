// Every row, field by field: its name in the database, in JSON and in CSV, its member, its constraints and what it
// means. The one list that tables (schema.cpp), statements (row_tables.cpp), messages (row_json.cpp), exports and the
// page of the schema go by.
//
//   eachField(visitor, row) ─► visitor("name", row.member, rule) for each, in the order of the columns
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "palpate/training/records/row_json.h"

namespace palpate::training {

/// Constraints of a value, which may come over a network from an unknown sender.
struct FieldRule {
  enum class Form : std::uint8_t {
    number,  ///< within [low, high]; also yes or no, and words of an enumeration
    text,    ///< at most `longest` bytes of UTF-8, no control characters but line ends and tabs
    word,    ///< letters, digits, ".", "_", "-": an id that people made
    uuid,    ///< lower case, with dashes
    hash,    ///< 64 hex digits
    file,    ///< relative, inside the folder of the records
    seed,    ///< 64 bits; in JSON as text, since many readers of JSON round them
  };
  Form form = Form::number;
  double low = 0.0;
  double high = 0.0;
  std::size_t longest = 0;
  bool may_be_empty = false;  ///< "none"
  // The column in SQL and in the dictionary.
  std::string_view means = {};  ///< with its unit
  std::string_view sql = {};    ///< more constraints, in both dialects
  int since = 1;                ///< version of the schema; who sends an earlier one does not know it

  bool isOptional() const { return since > 1; }
};

namespace field_rule {

inline constexpr double kLatestMs = 253402300799999.0;  // the year 9999
inline constexpr double kMaxCount = 1e9;
inline constexpr double kMaxTick = 9.0e15;  // exact as a double: 285,000 years at 1 kHz
inline constexpr std::size_t kLongestText = 65536;

constexpr FieldRule number(double low, double high) { return {FieldRule::Form::number, low, high, 0, false}; }
constexpr FieldRule text(std::size_t longest) { return {FieldRule::Form::text, 0, 0, longest, true}; }
constexpr FieldRule word() { return {FieldRule::Form::word, 0, 0, 64, false}; }
constexpr FieldRule wordOrNone() { return {FieldRule::Form::word, 0, 0, 64, true}; }
constexpr FieldRule file() { return {FieldRule::Form::file, 0, 0, 400, true}; }
inline constexpr FieldRule kUuid = {FieldRule::Form::uuid, 0, 0, 36, false};
inline constexpr FieldRule kHash = {FieldRule::Form::hash, 0, 0, 64, false};
inline constexpr FieldRule kHashOrNone = {FieldRule::Form::hash, 0, 0, 64, true};
inline constexpr FieldRule kSeed = {FieldRule::Form::seed, 0, 0, 20, false};
inline constexpr FieldRule kTime = number(0, kLatestMs);
inline constexpr FieldRule kCount = number(0, kMaxCount);
inline constexpr FieldRule kTick = number(0, kMaxTick);
inline constexpr FieldRule kShare = number(0, 1);
inline constexpr FieldRule kSite = number(0, 1000);
inline constexpr FieldRule kForce = number(0, 1000);  // N: no device of ours gives a tenth of it
inline constexpr FieldRule kAnyWord = {};             // value of an enumeration, or yes and no

constexpr FieldRule column(FieldRule rule, std::string_view means, std::string_view sql = {}, int since = 1) {
  rule.means = means;
  rule.sql = sql;
  rule.since = since;
  return rule;
}

}  // namespace field_rule

/// A row, to be read or to be filled.
template <class R, class Kind>
concept FieldsOf = std::is_same_v<std::remove_const_t<R>, Kind>;

template <class Visitor, FieldsOf<StationRow> R>
void eachField(Visitor&& visit, R& row) {
  using namespace field_rule;
  visit("id", row.id, column(kUuid, "made at the station", "PRIMARY KEY"));
  visit("name", row.name, column(text(200), "as people call it"));
  visit("certificate_sha256", row.certificate_sha256,
        column(kHashOrNone, "of the certificate that it shows to a class; empty: none"));
  visit("device", row.device, column(text(400), "the haptic device"));
  visit("calibrated_ms", row.calibrated_ms, column(kTime, "when last, ms since 1970; 0: never"));
}

template <class Visitor, FieldsOf<ClassRow> R>
void eachField(Visitor&& visit, R& row) {
  using namespace field_rule;
  visit("id", row.id, column(word(), "a word", "PRIMARY KEY"));
  visit("label", row.label, column(text(200), "as people call it"));
  visit("retain_days", row.retain_days, column(number(0, 36500), "rows are kept so many days after a session"));
  visit("retain_samples_days", row.retain_samples_days, column(number(0, 36500), "recordings are kept so many days"));
}

template <class Visitor, FieldsOf<TraineeRow> R>
void eachField(Visitor&& visit, R& row) {
  using namespace field_rule;
  visit("id", row.id, column(kUuid, "pseudonym, made of class and code", "PRIMARY KEY"));
  visit("class_id", row.class_id, column(wordOrNone(), "null: none", "REFERENCES class (id)"));
  visit("created_ms", row.created_ms, column(kTime, "first sign-in, ms since 1970"));
  visit("dominant_hand", row.dominant_hand, column(wordOrNone(), "left, right; empty: not said"));
  visit("consent", row.consent, column(kAnyWord, "agreed to being recorded"));
  visit("key_ref", row.key_ref, column(wordOrNone(), "which key locks their recordings; empty: none"));
}

template <class Visitor, FieldsOf<ProtocolRow> R>
void eachField(Visitor&& visit, R& row) {
  using namespace field_rule;
  visit("id", row.id, column(text(200), "its name"));
  visit("version", row.version, column(number(0, kMaxCount), "of the protocol"));
  visit("text", row.text, column(text(kLongestText), "the protocol file (TOML)"));
  visit("sha256", row.sha256, column(kHash, "of its settings"));
}

template <class Visitor, FieldsOf<SessionRow> R>
void eachField(Visitor&& visit, R& row) {
  using namespace field_rule;
  visit("id", row.id, column(kUuid, "UUID of version 7: begins with its time", "PRIMARY KEY"));
  visit("trainee_id", row.trainee_id, column(kUuid, "whose", "REFERENCES trainee (id) ON DELETE CASCADE"));
  visit("station_id", row.station_id, column(kUuid, "where", "REFERENCES station (id)"));
  visit("kind", row.kind,
        column(kAnyWord, "practice, mastery, pre_test, post_test, exam, retention, free, lump, lump_exam"));
  visit("start_ms", row.start_ms, column(kTime, "ms since 1970"));
  visit("end_ms", row.end_ms, column(kTime, "ms since 1970; 0: still running, or cut off"));
  visit("app_version", row.app_version, column(text(64), "of palpate"));
  visit("rng_seed", row.rng_seed, column(kSeed, "of all that was drawn: 64 bits, read as a signed number"));
  visit("device", row.device, column(text(400), "with its thimble: thresholds belong to it"));
  visit("file", row.file, column(file(), "recording beside the records; empty: none, or no longer kept"));
  visit("file_sha256", row.file_sha256,
        column(kHashOrNone, "of the file as it lies there (locked); empty until it is finished"));
}

template <class Visitor, FieldsOf<BlockRow> R>
void eachField(Visitor&& visit, R& row) {
  using namespace field_rule;
  visit("id", row.id, column(kUuid, "UUID of version 7", "PRIMARY KEY"));
  visit("session_id", row.session_id, column(kUuid, "of which session", "REFERENCES session (id) ON DELETE CASCADE"));
  visit("number", row.number, column(kCount, "in the session, from 1"));
  visit("method", row.method, column(kAnyWord, "marginal_psi, two_down_one_up, mastery, constant_levels"));
  visit("change_meaning", row.change_meaning,
        column(kAnyWord, "compliance: k'/k = 1/(1 - change); stiffness: k'/k = 1 + change; cue: C of a lump"));
  visit("protocol_id", row.protocol_id, column(text(200), "see protocol"));
  visit("protocol_version", row.protocol_version, column(number(0, kMaxCount), "see protocol"));
  visit("state_json", row.state_json, column(text(kLongestText), "seed and outcomes so far, from which it continues"));
  visit("finished", row.finished, column(kAnyWord, "else it was interrupted, or is still running"));
  visit(
      "threshold", row.threshold,
      column(number(0, 1e6), "T: the change at which corrected answers are right half of the time (median); 0: none"));
  visit("threshold_low", row.threshold_low, column(number(0, 1e6), "2.5 % of T"));
  visit("threshold_high", row.threshold_high, column(number(0, 1e6), "97.5 % of T"));
  visit("trials", row.trials, column(kCount, "that count"));
  visit("mastered_change", row.mastered_change,
        column(kShare, "mastery: the smallest change that was mastered; null: none"));
  visit("verdict", row.verdict, column(kAnyWord, "of an examination: none, pass, not_yet, repeat"));
}

/// Without its visits, which are rows of a table of their own.
template <class Visitor, FieldsOf<TrialRow> R>
void eachField(Visitor&& visit, R& row) {
  using namespace field_rule;
  visit("id", row.id, column(kUuid, "UUID of version 7", "PRIMARY KEY"));
  visit("block_id", row.block_id, column(kUuid, "of which block", "REFERENCES block (id) ON DELETE CASCADE"));
  visit("session_id", row.session_id,
        column(kUuid, "in which session's file it lies: a block may be taken up again later",
               "REFERENCES session (id) ON DELETE CASCADE"));
  visit("number", row.number, column(kCount, "in the block, from 1"));
  visit("start_ms", row.start_ms, column(kTime, "ms since 1970"));
  visit("end_ms", row.end_ms, column(kTime, "ms since 1970"));
  visit("seconds", row.seconds, column(number(0, 1e6), "it took, s, pauses left out"));
  visit("kind", row.kind, column(kAnyWord, "warm_up (not counted), measured, easy"));
  visit("change", row.change, column(number(0, 1e6), "of the hidden place, as the block's change_meaning says"));
  visit("site_true", row.site_true, column(kSite, "where it was hidden"));
  visit("site_answer", row.site_answer, column(kSite, "what was answered; 0: nothing"));
  visit("correct", row.correct, column(kAnyWord, "the answer was right"));
  visit("timed_out", row.timed_out, column(kAnyWord, "no answer came in time"));
  visit("excluded", row.excluded, column(text(200), "why it does not count; empty: it counts"));
  visit("sites_felt", row.sites_felt, column(kSite, "so many sites were pressed hard and long enough"));
  visit("file_tick_first", row.file_tick_first, column(kTick, "where it begins in the recording, ticks"));
  visit("file_tick_last", row.file_tick_last, column(kTick, "where it ends"));
  visit("mean_force_n", row.mean_force_n, column(kForce, "of all samples in contact, N"));
  visit("peak_force_n", row.peak_force_n, column(kForce, "N"));
  visit("mean_speed_mm_per_s", row.mean_speed_mm_per_s, column(number(0, 1e6), "mm/s"));
  visit("search_force_n", row.search_force_n,
        column(kForce, "mean while moving, N; 0: none, or recorded by version 1", "DEFAULT 0", 2));
  visit("palpate_force_n", row.palpate_force_n,
        column(kForce, "mean while staying, N; 0: none, or recorded by version 1", "DEFAULT 0", 2));
  visit("lumps", row.lumps,
        column(text(8000), "of a lump session: those hidden and those named (JSON); else empty", "DEFAULT ''", 4));
}

/// Without the trial that it belongs to.
template <class Visitor, FieldsOf<SiteVisit> R>
void eachField(Visitor&& visit, R& row) {
  using namespace field_rule;
  visit("site", row.site, column(kSite, "its number"));
  visit("presses", row.presses, column(kCount, "times the force rose over the limit"));
  visit("dwell_ms", row.dwell_ms, column(number(0, 1e9), "over the limit, ms"));
  visit("peak_force_n", row.peak_force_n, column(kForce, "N"));
  visit("mean_force_n", row.mean_force_n, column(kForce, "over the limit, N"));
  visit("deepest_mm", row.deepest_mm, column(number(-1000, 1000), "mm"));
}

template <class Visitor, FieldsOf<EventRow> R>
void eachField(Visitor&& visit, R& row) {
  using namespace field_rule;
  visit("id", row.id, column(kUuid, "UUID of version 7", "PRIMARY KEY"));
  visit("session_id", row.session_id, column(kUuid, "in which session", "REFERENCES session (id) ON DELETE CASCADE"));
  visit("at_ms", row.at_ms, column(kTime, "ms since 1970"));
  visit("kind", row.kind, column(text(64), "pause, resume, safety, screen, message, warning"));
  visit("text", row.text, column(text(4000), "in words"));
}

template <class Visitor, FieldsOf<DeletionRow> R>
void eachField(Visitor&& visit, R& row) {
  using namespace field_rule;
  visit("trainee_sha256", row.trainee_sha256, kHash);
  visit("at_ms", row.at_ms, kTime);
}

}  // namespace palpate::training

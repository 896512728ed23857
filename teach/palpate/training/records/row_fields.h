// Every row, field by field: its name in the database, in JSON and in CSV, its member, and what it must be like. The
// one list that statements (row_tables.cpp), messages (row_json.cpp) and exports go by; what the columns mean is said
// beside their types, in schema.cpp.
//
//   eachField(visitor, row) ─► visitor("name", row.member, rule) for each, in the order of the columns
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

#include "palpate/training/records/row_json.h"

namespace palpate::training {

/// What a value must be like, also when it comes over a network from who knows whom.
struct FieldRule {
  enum class Form : std::uint8_t {
    number,  ///< within [low, high]; also yes or no, and words of an enumeration
    text,    ///< at most `longest` bytes of UTF-8, no control characters but line ends and tabs
    word,    ///< letters, digits, ".", "_", "-": an id that people made
    uuid,    ///< lower case, with dashes
    hash,    ///< 64 hex digits
    file,    ///< relative, inside the folder of the records
    seed,    ///< 64 bits; in JSON as text, since not every reader of JSON keeps so many
  };
  Form form = Form::number;
  double low = 0.0;
  double high = 0.0;
  std::size_t longest = 0;
  bool may_be_empty = false;  ///< "none"
  bool may_miss = false;      ///< of a later version: who sends an older one does not know it
};

namespace field_rule {

inline constexpr double kLatestMs = 253402300799999.0;  // the year 9999
inline constexpr double kMostCount = 1e9;
inline constexpr double kMostTick = 9.0e15;  // exact as a double: 285,000 years at 1 kHz
inline constexpr std::size_t kLongestText = 65536;

constexpr FieldRule number(double low, double high) { return {FieldRule::Form::number, low, high, 0, false, false}; }
constexpr FieldRule text(std::size_t longest) { return {FieldRule::Form::text, 0, 0, longest, true, false}; }
constexpr FieldRule word() { return {FieldRule::Form::word, 0, 0, 64, false, false}; }
constexpr FieldRule wordOrNone() { return {FieldRule::Form::word, 0, 0, 64, true, false}; }
constexpr FieldRule file() { return {FieldRule::Form::file, 0, 0, 400, true, false}; }
constexpr FieldRule later(FieldRule rule) {
  rule.may_miss = true;
  return rule;
}
inline constexpr FieldRule kUuid = {FieldRule::Form::uuid, 0, 0, 36, false, false};
inline constexpr FieldRule kHash = {FieldRule::Form::hash, 0, 0, 64, false, false};
inline constexpr FieldRule kHashOrNone = {FieldRule::Form::hash, 0, 0, 64, true, false};
inline constexpr FieldRule kSeed = {FieldRule::Form::seed, 0, 0, 20, false, false};
inline constexpr FieldRule kTime = number(0, kLatestMs);
inline constexpr FieldRule kCount = number(0, kMostCount);
inline constexpr FieldRule kTick = number(0, kMostTick);
inline constexpr FieldRule kShare = number(0, 1);
inline constexpr FieldRule kSite = number(0, 1000);
inline constexpr FieldRule kForce = number(0, 1000);  // N: no device of ours gives a tenth of it
inline constexpr FieldRule kAnyWord = {};             // of an enumeration, or yes and no

}  // namespace field_rule

/// A row, to be read or to be filled.
template <class R, class Kind>
concept FieldsOf = std::is_same_v<std::remove_const_t<R>, Kind>;

template <class Visitor, FieldsOf<StationRow> R>
void eachField(Visitor&& visit, R& row) {
  visit("id", row.id, field_rule::kUuid);
  visit("name", row.name, field_rule::text(200));
  visit("certificate_sha256", row.certificate_sha256, field_rule::kHashOrNone);
  visit("device", row.device, field_rule::text(400));
  visit("calibrated_ms", row.calibrated_ms, field_rule::kTime);
}

template <class Visitor, FieldsOf<ClassRow> R>
void eachField(Visitor&& visit, R& row) {
  visit("id", row.id, field_rule::word());
  visit("label", row.label, field_rule::text(200));
  visit("retain_days", row.retain_days, field_rule::number(0, 36500));
  visit("retain_samples_days", row.retain_samples_days, field_rule::number(0, 36500));
}

template <class Visitor, FieldsOf<TraineeRow> R>
void eachField(Visitor&& visit, R& row) {
  visit("id", row.id, field_rule::kUuid);
  visit("class_id", row.class_id, field_rule::wordOrNone());
  visit("created_ms", row.created_ms, field_rule::kTime);
  visit("dominant_hand", row.dominant_hand, field_rule::wordOrNone());
  visit("consent", row.consent, field_rule::kAnyWord);
  visit("key_ref", row.key_ref, field_rule::wordOrNone());
}

template <class Visitor, FieldsOf<ProtocolRow> R>
void eachField(Visitor&& visit, R& row) {
  visit("id", row.id, field_rule::text(200));
  visit("version", row.version, field_rule::number(0, field_rule::kMostCount));
  visit("text", row.text, field_rule::text(field_rule::kLongestText));
  visit("sha256", row.sha256, field_rule::kHash);
}

template <class Visitor, FieldsOf<SittingRow> R>
void eachField(Visitor&& visit, R& row) {
  visit("id", row.id, field_rule::kUuid);
  visit("trainee_id", row.trainee, field_rule::kUuid);
  visit("station_id", row.station, field_rule::kUuid);
  visit("kind", row.kind, field_rule::kAnyWord);
  visit("start_ms", row.start_ms, field_rule::kTime);
  visit("end_ms", row.end_ms, field_rule::kTime);
  visit("app_version", row.app_version, field_rule::text(64));
  visit("rng_seed", row.rng_seed, field_rule::kSeed);
  visit("device", row.device, field_rule::text(400));
  visit("file", row.file, field_rule::file());
  visit("file_sha256", row.file_sha256, field_rule::kHashOrNone);
}

template <class Visitor, FieldsOf<BlockRow> R>
void eachField(Visitor&& visit, R& row) {
  visit("id", row.id, field_rule::kUuid);
  visit("session_id", row.sitting, field_rule::kUuid);
  visit("number", row.number, field_rule::kCount);
  visit("method", row.method, field_rule::kAnyWord);
  visit("change_meaning", row.meaning, field_rule::kAnyWord);
  visit("protocol_id", row.protocol_id, field_rule::text(200));
  visit("protocol_version", row.protocol_version, field_rule::number(0, field_rule::kMostCount));
  visit("state_json", row.state_json, field_rule::text(field_rule::kLongestText));
  visit("finished", row.finished, field_rule::kAnyWord);
  visit("threshold", row.threshold, field_rule::number(0, 1e6));
  visit("threshold_low", row.low, field_rule::number(0, 1e6));
  visit("threshold_high", row.high, field_rule::number(0, 1e6));
  visit("trials", row.trials, field_rule::kCount);
  visit("mastered_change", row.level, field_rule::kShare);
  visit("verdict", row.verdict, field_rule::kAnyWord);
}

/// Without its visits, which are rows of a table of their own.
template <class Visitor, FieldsOf<TrialRow> R>
void eachField(Visitor&& visit, R& row) {
  visit("id", row.id, field_rule::kUuid);
  visit("block_id", row.block, field_rule::kUuid);
  visit("session_id", row.sitting, field_rule::kUuid);
  visit("number", row.number, field_rule::kCount);
  visit("start_ms", row.start_ms, field_rule::kTime);
  visit("end_ms", row.end_ms, field_rule::kTime);
  visit("seconds", row.seconds, field_rule::number(0, 1e6));
  visit("kind", row.kind, field_rule::kAnyWord);
  visit("change", row.change, field_rule::kShare);
  visit("site_true", row.site_true, field_rule::kSite);
  visit("site_answer", row.site_answer, field_rule::kSite);
  visit("correct", row.correct, field_rule::kAnyWord);
  visit("timed_out", row.timeout, field_rule::kAnyWord);
  visit("excluded", row.excluded, field_rule::text(200));
  visit("sites_felt", row.visited, field_rule::kSite);
  visit("file_tick_first", row.file_tick0, field_rule::kTick);
  visit("file_tick_last", row.file_tick1, field_rule::kTick);
  visit("mean_force_n", row.mean_force_n, field_rule::kForce);
  visit("peak_force_n", row.peak_force_n, field_rule::kForce);
  visit("mean_speed_mm_per_s", row.mean_speed_mm_per_s, field_rule::number(0, 1e6));
  visit("search_force_n", row.search_force_n, field_rule::later(field_rule::kForce));
  visit("palpate_force_n", row.palpate_force_n, field_rule::later(field_rule::kForce));
}

/// Without the trial that it belongs to.
template <class Visitor, FieldsOf<SiteVisit> R>
void eachField(Visitor&& visit, R& row) {
  visit("site", row.site, field_rule::kSite);
  visit("presses", row.presses, field_rule::kCount);
  visit("dwell_ms", row.dwell_ms, field_rule::number(0, 1e9));
  visit("peak_force_n", row.peak_force_n, field_rule::kForce);
  visit("mean_force_n", row.mean_force_n, field_rule::kForce);
  visit("deepest_mm", row.deepest_mm, field_rule::number(-1000, 1000));
}

template <class Visitor, FieldsOf<EventRow> R>
void eachField(Visitor&& visit, R& row) {
  visit("id", row.id, field_rule::kUuid);
  visit("session_id", row.sitting, field_rule::kUuid);
  visit("at_ms", row.at_ms, field_rule::kTime);
  visit("kind", row.kind, field_rule::text(64));
  visit("text", row.text, field_rule::text(4000));
}

template <class Visitor, FieldsOf<DeletionRow> R>
void eachField(Visitor&& visit, R& row) {
  visit("trainee_sha256", row.trainee_sha256, field_rule::kHash);
  visit("at_ms", row.at_ms, field_rule::kTime);
}

}  // namespace palpate::training

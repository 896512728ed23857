// Rows for tests of the records: a class of trainees with sessions, blocks, trials, visits, all drawn from a seed, and
// how two rows are compared.
#pragma once

#include <string>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/training/records/row_json.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/training/sha256.h"

namespace palpate::training::samples {

inline constexpr std::int64_t kMonday = 1'700'000'000'000;

/// The same ids for the same numbers.
inline Uuid id(std::uint64_t what, std::uint64_t number) {
  return makeUuidV7(kMonday + static_cast<std::int64_t>(number), {what * 7919 + 1, number * 104729 + what});
}

inline StationRow station(int number = 1) {
  return {id(1, static_cast<std::uint64_t>(number)), "Room 3, \"left\"", "", "Touch", kMonday};
}
inline ClassRow aClass() { return {"osteo-1", "Osteopathy, first year", 365, 90}; }
inline TraineeRow trainee(std::string_view code = "A") {
  return {derivePseudonym("osteo-1", code), "osteo-1", kMonday + 5, "right", true, ""};
}
inline ProtocolRow protocol() { return {"vhb", 1, "# text\n[practice]\nlevels = []\n", sha256Hex("vhb")}; }

inline SessionRow session(const TraineeRow& of, std::uint64_t number, SessionKind kind = SessionKind::pre_test) {
  SessionRow row;
  row.id = id(2, number);
  row.trainee_id = of.id;
  row.station_id = station().id;
  row.kind = kind;
  row.start_ms = kMonday + static_cast<std::int64_t>(number) * 86'400'000;
  row.end_ms = row.start_ms + 900'000;
  row.app_version = "0.2.0";
  row.rng_seed = 0xfedcba9876543210ull + number;  // more than a signed number holds
  row.device = "simulated hand, no thimble";
  return row;
}

inline BlockRow block(const SessionRow& of, std::uint64_t number, int in_session = 1) {
  BlockRow row;
  row.id = id(3, number);
  row.session_id = of.id;
  row.number = in_session;
  row.protocol_id = "vhb";
  row.state_json = R"({"seed":"7","outcomes":[]})";
  row.finished = true;
  row.threshold = 0.1 + 0.01 / 3.0;
  row.threshold_low = 0.07;
  row.threshold_high = 1.0 / 7.0;
  row.trials = 20;
  return row;
}

inline TrialRow trial(const BlockRow& of, std::uint64_t number, int in_block, Random& random) {
  TrialRow row;
  row.id = id(4, number);
  row.block_id = of.id;
  row.session_id = of.session_id;
  row.number = in_block;
  row.start_ms = kMonday + static_cast<std::int64_t>(number) * 20'000;
  row.end_ms = row.start_ms + 17'000;
  row.seconds = random.uniform(3.0, 45.0);
  row.kind = in_block < 3 ? TrialKind::warm_up : TrialKind::measured;
  row.change = random.uniform(0.04, 0.9);
  if (in_block % 5 == 0) row.lumps = R"({"hidden":[],"findings":[],"over":true,"timed_out":false})";
  row.site_true = 1 + static_cast<int>(random.below(12));
  row.site_answer = static_cast<int>(random.below(13));
  row.correct = row.site_answer == row.site_true;
  row.timed_out = row.site_answer == 0;
  row.excluded = in_block % 7 == 0 ? "the site was not pressed" : "";
  row.sites_felt = 12;
  row.file_tick_first = number * 20'000;
  row.file_tick_last = row.file_tick_first + 17'000;
  row.mean_force_n = random.uniform(0.0, 3.0);
  row.peak_force_n = random.uniform(3.0, 7.0);
  row.mean_speed_mm_per_s = random.uniform(0.0, 80.0);
  row.search_force_n = random.uniform(0.0, 2.0);
  row.palpate_force_n = random.uniform(0.0, 4.0);
  for (int site = 1; site <= 12; site += 1 + static_cast<int>(random.below(3))) {
    row.visits.push_back({site, 1 + static_cast<int>(random.below(4)), random.uniform(100.0, 900.0),
                          random.uniform(1.0, 4.0), random.uniform(0.5, 1.0), random.uniform(-0.5, 9.0)});
  }
  return row;
}

inline EventRow event(const SessionRow& of, std::uint64_t number) {
  return {id(5, number), of.id, of.start_ms + static_cast<std::int64_t>(number), "safety",
          "force limit, 3 × in \"1 s\"\nthen good"};
}

/// Everybody's rows, each after those that it refers to.
struct History {
  std::vector<TraineeRow> trainees;
  std::vector<AnyRow> rows;
  std::size_t trials = 0;
};

inline History history(int trainees, int sessions, int trials) {
  History all;
  Random random(20261118);
  all.rows = {station(), aClass(), protocol()};
  std::uint64_t number = 0;
  for (int person = 0; person < trainees; ++person) {
    const TraineeRow& who = all.trainees.emplace_back(trainee("T" + std::to_string(person)));
    all.rows.emplace_back(who);
    for (int day = 0; day < sessions; ++day) {
      const SessionRow when = session(who, ++number, day == 0 ? SessionKind::pre_test : SessionKind::practice);
      all.rows.emplace_back(when);
      const BlockRow what = block(when, number);
      all.rows.emplace_back(what);
      for (int i = 1; i <= trials; ++i) all.rows.emplace_back(trial(what, number * 1000 + std::uint64_t(i), i, random));
      all.rows.emplace_back(event(when, number));
      all.trials += std::size_t(trials);
    }
  }
  return all;
}

/// By what they say, every bit of a number included.
inline std::string said(const AnyRow& row) { return std::string(kindOf(row)) + rowJson(row); }
template <class R>
std::vector<std::string> saidAll(const std::vector<R>& rows) {
  std::vector<std::string> texts;
  for (const R& row : rows) texts.push_back(said(AnyRow(row)));
  return texts;
}

}  // namespace palpate::training::samples

// Trainees out of the air, for reports: rows as a station would have kept them, of people whose thresholds are known
// and who answer by the psychometric function itself. Not a finger: `palpate train --trainee` has one.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/training/block.h"
#include "palpate/training/protocol.h"
#include "palpate/training/psychometric.h"
#include "palpate/training/records/store.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/training/session/session.h"

namespace palpate::support {

struct MadeCourse {
  std::vector<training::SessionKind> kinds = {training::SessionKind::pre_test, training::SessionKind::practice,
                                              training::SessionKind::practice, training::SessionKind::practice,
                                              training::SessionKind::post_test};
  double first_threshold = 0.28;  ///< at the first session
  double last_threshold = 0.14;   ///< at the last
  double skipping = 0.03;         ///< a trial in which three places are not felt
  std::string device = "simulated hand, soft thimble";
};

/// One station's rows, made and kept one after the other.
class MadeTrainees {
 public:
  explicit MadeTrainees(training::Store& store, const std::string& class_id = "osteo-1") : store_(store) {
    station_ = id();
    store_.save(training::StationRow{.id = station_, .name = "Room 2", .device = "simulated hand"});
    store_.save(training::ClassRow{.id = class_id, .label = "First year"});
    store_.save(training::makeProtocolRow(protocol_));
    class_id_ = class_id;
  }

  training::Uuid add(std::uint64_t seed, const MadeCourse& course = {}) {
    random_ = Random(seed);
    const training::Uuid trainee = training::derivePseudonym(class_id_, training::makeTraineeCode(seed));
    store_.save(training::TraineeRow{.id = trainee, .class_id = class_id_, .created_ms = kBegin, .consent = true});
    for (std::size_t i = 0; i < course.kinds.size(); ++i) {
      const double share =
          course.kinds.size() > 1 ? static_cast<double>(i) / static_cast<double>(course.kinds.size() - 1) : 0.0;
      threshold_ = course.first_threshold * std::pow(course.last_threshold / course.first_threshold, share);
      sit(trainee, course, course.kinds[i], kBegin + static_cast<std::int64_t>(i) * kWeek);
    }
    return trainee;
  }

 private:
  static constexpr std::int64_t kBegin = 1'790'000'000'000;
  static constexpr std::int64_t kWeek = 7ll * 24 * 3600 * 1000;

  training::Uuid id() {
    const std::uint64_t first = random_.bits();
    return training::makeUuidV7(kBegin, {first, random_.bits()});
  }
  double between(double low, double high) { return low + (high - low) * random_.uniform(); }

  void sit(const training::Uuid& trainee, const MadeCourse& course, training::SessionKind kind, std::int64_t start_ms) {
    const training::BlockSettings& settings = training::settingsOf(protocol_, kind).block;
    training::Block block(settings, random_.bits());
    training::SessionRow session{.id = id(), .trainee_id = trainee, .station_id = station_, .kind = kind};
    session.start_ms = start_ms;
    session.app_version = "1.0.0";
    session.device = course.device;
    training::BlockRow row{
        .id = id(), .session_id = session.id, .method = settings.method, .change_meaning = settings.meaning};
    row.protocol_id = protocol_.id;
    row.protocol_version = protocol_.version;
    row.state_json = block.state();
    std::vector<training::Row> rows = {session, row};
    std::int64_t now_ms = start_ms;
    while (!block.finished()) rows.emplace_back(trial(block, row, now_ms, between(0.0, 1.0) < course.skipping));
    row.copyStateFrom(block);
    rows.emplace_back(row);
    rows.emplace_back(training::EventRow{
        .id = id(), .session_id = session.id, .at_ms = now_ms, .kind = "pause", .text = "asked Anna Muster to wait"});
    session.end_ms = now_ms;
    rows.emplace_back(session);
    store_.save(rows);
  }

  training::TrialRow trial(training::Block& block, const training::BlockRow& row, std::int64_t& now_ms, bool skips) {
    const training::PlannedTrial planned = block.next();
    training::TrialRow trial{.id = id(), .block_id = row.id, .session_id = row.session_id, .number = planned.number};
    trial.kind = planned.kind;
    trial.change = planned.change;
    trial.site_true = planned.site;
    const int skipped = skips ? 1 + static_cast<int>(random_.below(10)) : 0;  // and the two after it
    for (int site = 1; site <= 12; ++site) {
      if (skipped > 0 && site >= skipped && site < skipped + 3) continue;
      trial.visits.push_back(visit(site, site == planned.site));
    }
    trial.sites_felt = static_cast<int>(trial.visits.size());
    const bool felt = skipped == 0 || planned.site < skipped || planned.site >= skipped + 3;
    const training::Psychometric function{.threshold = threshold_, .guess = 1.0 / trial.sites_felt};
    trial.correct = felt && between(0.0, 1.0) < training::probabilityCorrect(function, planned.change);
    trial.site_answer = trial.correct ? planned.site : wrongSite(planned.site);
    trial.timed_out = !trial.correct && between(0.0, 1.0) < 0.05;
    if (trial.timed_out) trial.site_answer = 0;
    if (!felt) trial.excluded = "target not felt";
    trial.seconds = std::exp(between(2.2, 3.6)) * (trial.correct ? 1.0 : 1.3);
    trial.start_ms = now_ms;
    now_ms += static_cast<std::int64_t>(1000.0 * trial.seconds);
    trial.end_ms = now_ms;
    trial.peak_force_n = between(1.5, 3.5);
    trial.mean_force_n = between(0.6, 1.4);
    trial.search_force_n = between(0.4, 1.2);
    trial.palpate_force_n = between(0.9, 2.1);
    trial.mean_speed_mm_per_s = between(20.0, 80.0);
    block.answer(
        {.answer = trial.site_answer, .correct = trial.correct, .visited = trial.sites_felt, .target_visited = felt});
    return trial;
  }

  training::SiteVisit visit(int site, bool longer) {
    const double dwell = between(350.0, 900.0) * (longer ? 1.6 : 1.0);
    return {.site = site,
            .presses = 1 + static_cast<int>(random_.below(3)),
            .dwell_ms = std::round(dwell),
            .peak_force_n = between(0.9, 2.6),
            .mean_force_n = between(0.6, 1.2),
            .deepest_mm = between(3.0, 9.0)};
  }

  /// Mostly next to the true one.
  int wrongSite(int truth) {
    if (between(0.0, 1.0) < 0.5) return truth % 6 == 0 ? truth - 1 : truth + 1;
    return 1 + (truth + static_cast<int>(random_.below(11))) % 12;
  }

  training::Store& store_;
  training::Protocol protocol_ = training::builtInProtocol();
  Random random_{1};
  training::Uuid station_;
  std::string class_id_;
  double threshold_ = 0.2;
};

}  // namespace palpate::support

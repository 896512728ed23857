#include "palpate/training/trainee/trainee_course.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/private_folder.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/training/records/recording_files.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/training/session/trial_scene.h"
#include "palpate/training/sha256.h"
#include "palpate/training/trainee/body_touch.h"
#include "palpate/training/trainee/imagined_touch.h"
#include "palpate/training/trainee/lump_trainee.h"

namespace palpate::training {

namespace {

/// Seed of the station's id: any number, always the same.
constexpr std::uint64_t kStationSeed = 1;

/// Between two sessions: half of a week, as two practices a week are.
constexpr std::int64_t kBetweenMs = std::int64_t{84} * 3600 * 1000;

Uuid seededId(std::int64_t start_ms, std::uint64_t seed) {
  Random random(seed);
  const std::uint64_t first = random.bits();
  return makeUuidV7(start_ms, {first, random.bits()});
}

SessionPlan makeSessionPlan(Store& store, const TraineeBench& bench, const TraineeSession& requested) {
  SessionPlan plan;
  plan.protocol = bench.protocol;
  if (bench.body) {
    plan.protocol.base_n_per_mm =
        renderableBase(bench.protocol, bench.body->scene, device::profileOf(bench.hand.device));
  }
  plan.kind = requested.kind;
  plan.sites = bench.sites;
  plan.seed = requested.seed;
  plan.tick_s = bench.body ? 1.0 / bench.body->scene.ticks_per_s : kImaginedTickS;
  plan.row.id = seededId(requested.start_ms, mixedSeed(requested.seed, requested.trainee));
  plan.row.trainee_id = requested.trainee;
  plan.row.station_id = bench.station;
  plan.row.start_ms = requested.start_ms;
  plan.row.app_version = engine::recordingHeader(1.0 / plan.tick_s).software;
  plan.row.device = bench.body ? describeDevice(bench.hand) : std::string(kNoBody);
  if (bench.body && bench.recording_files) plan.row.file = RecordingFiles::nameFor(plan.row.id);
  if (const auto interrupted = store.interrupted(requested.trainee, requested.kind)) plan.resumed = interrupted->block;
  if (const auto last = store.lastMeasured(requested.trainee)) {
    plan.before = ShownThreshold{.median = last->threshold, .low = last->threshold_low, .high = last->threshold_high};
  }
  return plan;
}

std::unique_ptr<BodyTouch> makeBodyTouch(const Store& store, const TraineeBench& bench, const SessionPlan& plan,
                                         const TraineeSession& requested) {
  BodyTouchSettings settings;
  settings.hand = bench.hand;
  settings.start_ms = requested.start_ms;
  settings.notes = "a simulated trainee: " + (hidesLumps(plan.kind) ? formatLumpTrainee(requested.lump_observer)
                                                                    : formatObserver(requested.observer));
  if (!plan.row.file.empty()) {
    settings.recording = store.folder() / plan.row.file;
    makePrivateFolder(settings.recording.parent_path(), ExistingFolder::closed);
  }
  return std::make_unique<BodyTouch>(TrialWorlds(*bench.body, plan.protocol, plan.kind, plan.sites), plan.sites,
                                     settings);
}

std::unique_ptr<Touching> makeTouching(const Store& store, const TraineeBench& bench, const SessionPlan& plan,
                                       const TraineeSession& requested) {
  if (!bench.body) return std::make_unique<ImaginedTouch>(plan.protocol, plan.kind);
  return makeBodyTouch(store, bench, plan, requested);
}

/// The last row of each kind.
void noteRows(std::span<const Row> rows, SessionOutcome& sat) {
  for (const Row& row : rows) {
    if (const auto* session = std::get_if<SessionRow>(&row)) sat.row = *session;
    if (const auto* block = std::get_if<BlockRow>(&row)) sat.block = *block;
    if (const auto* trial = std::get_if<TrialRow>(&row)) sat.trials.push_back(*trial);
  }
}

}  // namespace

SiteSet sitesOn(const scene::World& body, const Protocol& protocol) {
  const auto& landmarks = body.body->anatomy.landmarks;
  return protocol.sites.empty() ? twelveSites(landmarks) : sitesNamed(landmarks, protocol.sites);
}

SessionOutcome runSession(Store& store, const TraineeBench& bench, const TraineeSession& requested) {
  const bool lumps = hidesLumps(requested.kind);
  if (lumps && !bench.body) throw Error("trainee: a lump session needs a body; leave out --fast");
  SessionPlan plan = makeSessionPlan(store, bench, requested);
  if (lumps) plan.bodies = std::make_shared<const LumpBodies>(bench.body, bench.protocol, bench.sites);
  SessionOutcome sat;
  sat.resumed = plan.resumed.has_value();
  if (plan.resumed) sat.block = *plan.resumed;
  std::vector<Row> together;  // without a body a session takes milliseconds, and a disk that long for each trial
  TraineeOrders orders;
  orders.observer = requested.observer;
  orders.lump_observer = requested.lump_observer;
  orders.practised = requested.practised;
  orders.most_trials = requested.most_trials;
  orders.answered = bench.answered;
  orders.stop = bench.stop;
  orders.save = [&](std::vector<Row> rows) {
    noteRows(rows, sat);
    if (bench.body) return store.save(rows);
    for (Row& row : rows) together.push_back(std::move(row));
  };
  const auto sit = [&](SittingRun&& run, Touching& touching) {
    run.run();
    touching.finish(run.now().utc_ms);
    sat.simulated_s = run.now().s;
  };
  const Moment begun{.s = 0.0, .utc_ms = requested.start_ms, .tick = 0};
  if (lumps) {
    const std::unique_ptr<BodyTouch> touch = makeBodyTouch(store, bench, plan, requested);
    LumpSession session(plan, begun);
    sit(LumpRun(session, *touch, orders, requested.start_ms), *touch);
    sat.lumps = session.counts();
  } else {
    const std::unique_ptr<Touching> touching = makeTouching(store, bench, plan, requested);
    Session session(plan, begun);
    sit(TraineeRun(session, *touching, orders, requested.start_ms), *touching);
    sat.result = session.result();
  }
  if (!sat.row.file.empty()) {
    sat.row.file_sha256 = sha256OfFile(store.folder() / sat.row.file);
    together.emplace_back(sat.row);
  }
  if (!together.empty()) store.save(together);
  return sat;
}

namespace {

/// A trainee's state in the records so far.
struct CourseSoFar {
  std::vector<SessionKind> done;  ///< kinds of finished blocks
  int sessions = 0;
  int practised = 0;
  std::int64_t newest_ms = 0;  ///< 0: none
};

CourseSoFar courseSoFar(Store& store, const Uuid& trainee) {
  CourseSoFar so_far;
  for (const SessionRow& session : store.sessions(trainee)) {
    ++so_far.sessions;
    so_far.newest_ms = std::max({so_far.newest_ms, session.start_ms, session.end_ms});
    for (const BlockRow& block : store.blocks(session.id)) {
      if (!block.finished) continue;
      so_far.done.push_back(session.kind);
      if (session.kind == SessionKind::practice || session.kind == SessionKind::mastery) ++so_far.practised;
    }
  }
  return so_far;
}

std::vector<SessionKind> withoutDone(const std::vector<SessionKind>& kinds, std::vector<SessionKind> done) {
  std::vector<SessionKind> left;
  for (const SessionKind kind : kinds) {
    const auto found = std::ranges::find(done, kind);
    if (found == done.end()) {
      left.push_back(kind);
    } else {
      done.erase(found);
    }
  }
  return left;
}

}  // namespace

void runProgramme(Store& store, const TraineeBench& bench, const TraineeCourse& course,
                  const std::function<void(const SessionOutcome&)>& after_each) {
  CourseSoFar so_far = courseSoFar(store, course.trainee);
  const std::vector<SessionKind> kinds = course.goes_on ? withoutDone(course.kinds, so_far.done) : course.kinds;
  for (const SessionKind kind : kinds) {
    if (bench.stop && bench.stop()) return;
    TraineeSession session;
    session.observer = course.observer;
    session.lump_observer = course.lump_observer;
    session.kind = kind;
    session.trainee = course.trainee;
    session.seed = mixedSeed(course.seed, "session " + std::to_string(so_far.sessions));
    session.start_ms =
        so_far.newest_ms == 0 ? course.start_ms : std::max(course.start_ms, so_far.newest_ms + kBetweenMs);
    session.practised = so_far.practised;
    session.most_trials = course.most_trials;
    const SessionOutcome sat = runSession(store, bench, session);
    ++so_far.sessions;
    so_far.newest_ms = std::max(sat.row.start_ms, sat.row.end_ms);
    const bool practice = kind == SessionKind::practice || kind == SessionKind::mastery;
    if (practice && sat.block.finished) ++so_far.practised;
    if (after_each) after_each(sat);
  }
}

StationRow simulatedStation(std::int64_t start_ms) {
  return {.id = seededId(0, kStationSeed),
          .name = "simulated",
          .certificate_sha256 = {},
          .device = "simulated",
          .calibrated_ms = start_ms};
}

TraineeRow simulatedTrainee(const std::string& class_id, const std::string& code, std::int64_t created_ms,
                            const std::string& key) {
  return {.id = derivePseudonym(class_id, code, key),
          .class_id = class_id,
          .created_ms = created_ms,
          .dominant_hand = {},
          .consent = true,
          .key_ref = {}};
}

std::string simulatedCode(std::uint64_t seed, int number) {
  return makeTraineeCode(Random(mixedSeed(seed, "trainee " + std::to_string(number))).bits());
}

std::vector<SessionKind> vhbCourse() {
  std::vector<SessionKind> kinds(8, SessionKind::practice);
  kinds.front() = SessionKind::pre_test;
  kinds.back() = SessionKind::post_test;
  return kinds;
}

ObserverSettings oneOfClass(const ObserverSettings& mean, double spread, std::uint64_t seed, int number) {
  constexpr double kCorrelation = 0.5;
  Random random(mixedSeed(seed, "talent " + std::to_string(number)));
  const double before = random.normal();
  const double after = kCorrelation * before + std::sqrt(1.0 - kCorrelation * kCorrelation) * random.normal();
  // Keeps the mean over the class at its stated value.
  const auto spread_out = [&](double value, double z) { return value * std::exp(spread * z - 0.5 * spread * spread); };
  ObserverSettings one = mean;
  one.weber = spread_out(mean.weber, before);
  one.weber_end = spread_out(mean.weber_end, after);
  one.seed = mixedSeed(mean.seed, std::to_string(number));
  return one;
}

}  // namespace palpate::training

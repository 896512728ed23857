#include "palpate/training/trainee/trainee_course.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "palpate/base/hash.h"
#include "palpate/base/private_folder.h"
#include "palpate/engine/session_settings.h"
#include "palpate/training/records/session_files.h"
#include "palpate/training/records/sha256.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/training/trainee/body_touch.h"
#include "palpate/training/trainee/imagined_touch.h"
#include "palpate/training/trainee/trainee_run.h"
#include "palpate/training/trial_scene.h"

namespace palpate::training {

namespace {

/// Of the station's id: any number, always the same.
constexpr std::uint64_t kStationSeed = 1;

/// Between two sittings: half of a week, as two practices a week are.
constexpr std::int64_t kBetweenMs = std::int64_t{84} * 3600 * 1000;

std::uint64_t mixed(std::uint64_t seed, std::string_view words) {
  Hash hash;
  hash.add(seed);
  for (const char letter : words) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(letter)));
  return hash.value();
}

Uuid seededId(std::int64_t start_ms, std::uint64_t seed) {
  Random random(seed);
  const std::uint64_t first = random.bits();
  return uuidOf(start_ms, {first, random.bits()});
}

SittingPlan planOf(Store& store, const TraineeBench& bench, const TraineeSitting& wished) {
  SittingPlan plan;
  plan.protocol = bench.protocol;
  if (bench.body) {
    plan.protocol.base_n_per_mm =
        renderableBase(bench.protocol, bench.body->scene, device::profileOf(bench.hand.device));
  }
  plan.kind = wished.kind;
  plan.sites = bench.sites;
  plan.seed = wished.seed;
  plan.tick_s = bench.body ? 1.0 / bench.body->scene.ticks_per_s : kImaginedTickS;
  plan.row.id = seededId(wished.start_ms, mixed(wished.seed, wished.trainee));
  plan.row.trainee = wished.trainee;
  plan.row.station = bench.station;
  plan.row.start_ms = wished.start_ms;
  plan.row.app_version = engine::sessionHeader(1.0 / plan.tick_s).software;
  plan.row.device = bench.body ? deviceWords(bench.hand) : std::string(kNoBody);
  if (bench.body && bench.session_files) plan.row.file = SessionFiles::nameFor(plan.row.id);
  if (const auto interrupted = store.interrupted(wished.trainee, wished.kind)) plan.resumed = interrupted->block;
  if (const auto last = store.lastMeasured(wished.trainee)) {
    plan.before = ShownThreshold{.median = last->threshold, .low = last->low, .high = last->high};
  }
  return plan;
}

std::unique_ptr<Touching> touchingOf(const Store& store, const TraineeBench& bench, const SittingPlan& plan,
                                     const TraineeSitting& wished) {
  if (!bench.body) return std::make_unique<ImaginedTouch>(plan.protocol, plan.kind);
  BodyTouchSettings settings;
  settings.hand = bench.hand;
  settings.start_ms = wished.start_ms;
  settings.notes = "a simulated trainee: " + observerWords(wished.observer);
  if (!plan.row.file.empty()) {
    settings.session = store.folder() / plan.row.file;
    makePrivateFolder(settings.session.parent_path(), ExistingFolder::closed);
  }
  return std::make_unique<BodyTouch>(TrialWorlds(*bench.body, plan.protocol, plan.kind, plan.sites), plan.sites,
                                     settings);
}

/// The last row of each kind that went by.
void noteRows(std::span<const Row> rows, SatThrough& sat) {
  for (const Row& row : rows) {
    if (const auto* sitting = std::get_if<SittingRow>(&row)) sat.row = *sitting;
    if (const auto* block = std::get_if<BlockRow>(&row)) sat.block = *block;
    if (const auto* trial = std::get_if<TrialRow>(&row)) sat.trials.push_back(*trial);
  }
}

}  // namespace

SiteSet sitesOn(const scene::World& body, const Protocol& protocol) {
  const auto& landmarks = body.body->anatomy.landmarks;
  return protocol.sites.empty() ? twelveSites(landmarks) : sitesNamed(landmarks, protocol.sites);
}

SatThrough sitThrough(Store& store, const TraineeBench& bench, const TraineeSitting& wished) {
  const SittingPlan plan = planOf(store, bench, wished);
  const std::unique_ptr<Touching> touching = touchingOf(store, bench, plan, wished);
  SatThrough sat;
  sat.resumed = plan.resumed.has_value();
  if (plan.resumed) sat.block = *plan.resumed;
  std::vector<Row> together;  // without a body a sitting takes milliseconds, and a disk that long for each trial
  TraineeOrders orders;
  orders.observer = wished.observer;
  orders.practised = wished.practised;
  orders.most_trials = wished.most_trials;
  orders.answered = bench.answered;
  orders.stop = bench.stop;
  orders.keep = [&](std::vector<Row> rows) {
    noteRows(rows, sat);
    if (bench.body) return store.keep(rows);
    for (Row& row : rows) together.push_back(std::move(row));
  };
  Sitting sitting(plan, {.s = 0.0, .utc_ms = wished.start_ms, .tick = 0});
  TraineeRun run(sitting, *touching, orders, wished.start_ms);
  run.run();
  touching->finish(run.now().utc_ms);
  if (!sat.row.file.empty()) {
    sat.row.file_sha256 = sha256OfFile(store.folder() / sat.row.file);
    together.emplace_back(sat.row);
  }
  if (!together.empty()) store.keep(together);
  sat.result = sitting.result();
  sat.simulated_s = run.now().s;
  return sat;
}

namespace {

/// What the records know of a trainee so far.
struct CourseSoFar {
  std::vector<SittingKind> done;  ///< of finished blocks
  int sittings = 0;
  int practised = 0;
  std::int64_t newest_ms = 0;  ///< 0: none
};

CourseSoFar courseSoFar(Store& store, const Uuid& trainee) {
  CourseSoFar so_far;
  for (const SittingRow& sitting : store.sittings(trainee)) {
    ++so_far.sittings;
    so_far.newest_ms = std::max({so_far.newest_ms, sitting.start_ms, sitting.end_ms});
    for (const BlockRow& block : store.blocks(sitting.id)) {
      if (!block.finished) continue;
      so_far.done.push_back(sitting.kind);
      if (sitting.kind == SittingKind::practice || sitting.kind == SittingKind::mastery) ++so_far.practised;
    }
  }
  return so_far;
}

std::vector<SittingKind> withoutDone(const std::vector<SittingKind>& kinds, std::vector<SittingKind> done) {
  std::vector<SittingKind> left;
  for (const SittingKind kind : kinds) {
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

void sitCourse(Store& store, const TraineeBench& bench, const TraineeCourse& course,
               const std::function<void(const SatThrough&)>& after_each) {
  CourseSoFar so_far = courseSoFar(store, course.trainee);
  const std::vector<SittingKind> kinds = course.goes_on ? withoutDone(course.kinds, so_far.done) : course.kinds;
  for (const SittingKind kind : kinds) {
    if (bench.stop && bench.stop()) return;
    TraineeSitting sitting;
    sitting.observer = course.observer;
    sitting.kind = kind;
    sitting.trainee = course.trainee;
    sitting.seed = mixed(course.seed, "sitting " + std::to_string(so_far.sittings));
    sitting.start_ms =
        so_far.newest_ms == 0 ? course.start_ms : std::max(course.start_ms, so_far.newest_ms + kBetweenMs);
    sitting.practised = so_far.practised;
    sitting.most_trials = course.most_trials;
    const SatThrough sat = sitThrough(store, bench, sitting);
    ++so_far.sittings;
    so_far.newest_ms = std::max(sat.row.start_ms, sat.row.end_ms);
    const bool practice = kind == SittingKind::practice || kind == SittingKind::mastery;
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
  return {.id = pseudonymOf(class_id, code, key),
          .class_id = class_id,
          .created_ms = created_ms,
          .dominant_hand = {},
          .consent = true,
          .key_ref = {}};
}

std::string simulatedCode(std::uint64_t seed, int number) {
  return codeOf(Random(mixed(seed, "trainee " + std::to_string(number))).bits());
}

std::vector<SittingKind> vhbCourse() {
  std::vector<SittingKind> kinds(8, SittingKind::practice);
  kinds.front() = SittingKind::pre_test;
  kinds.back() = SittingKind::post_test;
  return kinds;
}

ObserverSettings oneOfClass(const ObserverSettings& mean, double spread, std::uint64_t seed, int number) {
  constexpr double kCorrelation = 0.5;
  Random random(mixed(seed, "talent " + std::to_string(number)));
  const double before = random.normal();
  const double after = kCorrelation * before + std::sqrt(1.0 - kCorrelation * kCorrelation) * random.normal();
  // So that the mean over the class stays what it is said to be.
  const auto spread_out = [&](double value, double z) { return value * std::exp(spread * z - 0.5 * spread * spread); };
  ObserverSettings one = mean;
  one.weber = spread_out(mean.weber, before);
  one.weber_end = spread_out(mean.weber_end, after);
  one.seed = mixed(mean.seed, std::to_string(number));
  return one;
}

}  // namespace palpate::training

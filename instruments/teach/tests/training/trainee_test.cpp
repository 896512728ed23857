// A simulated trainee on a body: the loop closed, sessions walked through, records kept. What was felt is judged from
// the recorded samples, by code of this file.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>

#include "palpate/engine/recording_replay.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/training/session/trial_scene.h"
#include "palpate/training/trainee/body_touch.h"
#include "palpate/training/trainee/imagined_touch.h"
#include "palpate/training/trainee/trainee_course.h"
#include "support/error_message.h"
#include "support/mesh_scene.h"
#include "support/temporary_folder.h"
#include "teach/tests/training/twelve.h"

namespace palpate::training {
namespace {

constexpr std::int64_t kStartMs = 1'790'000'000'000;

/// A gently curved sheet, 180 x 300 mm in cells of 4 mm, under the twelve sites of flatSpine.
mesh::TriangleMesh backPatch() {
  constexpr int kWide = 45;
  constexpr int kHigh = 75;
  constexpr double kCellMm = 4.0;
  mesh::TriangleMesh patch;
  for (int j = 0; j <= kHigh; ++j) {
    for (int i = 0; i <= kWide; ++i) {
      const double x = kCellMm * i - 90.0;
      const double y = kCellMm * j - 50.0;
      patch.positions.emplace_back(x, y, 100.0 - 0.001 * (x * x + (y - 100.0) * (y - 100.0)));
    }
  }
  for (Index j = 0; j < kHigh; ++j) {
    for (Index i = 0; i < kWide; ++i) {
      const Index a = j * (kWide + 1) + i;
      const Index b = a + kWide + 1;
      patch.triangles.push_back({a, a + 1, b + 1});
      patch.triangles.push_back({a, b + 1, b});
    }
  }
  return patch;
}

/// A scene with one fingertip and nothing planned for it.
scene::Scene fingertipScene() {
  scene::Scene scene;
  scene::Finger finger;
  finger.name = "index";
  finger.radius_mm = 8.0;
  scene.fingers.push_back(finger);
  return scene;
}

class Trainee : public testing::Test {
 protected:
  Trainee() { body_ = scene::build(support::meshScene(folder_ / "back.ply", backPatch(), fingertipScene())); }

  TrialWorlds worlds() const { return {*body_, protocol_, SessionKind::pre_test, sites_}; }

  Store recordsIn(const std::string& name) {
    std::filesystem::create_directories(folder_ / name);
    Store store(folder_ / name / "all.results", Store::Open::create_too);
    const StationRow station = simulatedStation(kStartMs);
    store.save(station);
    store.save(makeProtocolRow(protocol_));
    store.save(trainee_);
    return store;
  }

  TraineeBench bench(bool with_body, bool recorded = true) const {
    TraineeBench bench;
    bench.protocol = protocol_;
    bench.sites = sites_;
    if (with_body) bench.body = body_;
    bench.recording_files = recorded;
    bench.station = simulatedStation(kStartMs).id;
    return bench;
  }

  TraineeSession request(const std::string& words, std::uint64_t seed = 1) const {
    TraineeSession session;
    session.observer = observerNamed(words);
    session.trainee = trainee_.id;
    session.seed = seed;
    session.start_ms = kStartMs;
    return session;
  }

  support::TemporaryFolder folder_;
  std::shared_ptr<const scene::World> body_;
  Protocol protocol_ = builtInProtocol();
  SiteSet sites_ = flatTwelve();
  TraineeRow trainee_ = simulatedTrainee("", simulatedCode(1, 0), kStartMs);
};

/// What one site's press looked like, from its samples.
struct SeenPress {
  double over_half_newton_s = 0.0;
  double stiffness = 0.0;  ///< sum of force over sum of depth, of the ticks near the deepest
};

SeenPress seenPress(const std::vector<trace::Sample>& samples, const Vec2& site) {
  SeenPress seen;
  double deepest = 0.0;
  for (const trace::Sample& sample : samples) deepest = std::max(deepest, sample.contact.depth_mm);
  double force = 0.0;
  double depth = 0.0;
  for (const trace::Sample& sample : samples) {
    if ((sample.contact.anchor.head<2>() - site).norm() > 15.0) continue;
    if (sample.contact.force.norm() >= 0.5) seen.over_half_newton_s += 0.001;
    if (sample.contact.depth_mm < 0.9 * deepest) continue;
    force += sample.device_force.norm();
    depth += sample.contact.depth_mm;
  }
  seen.stiffness = depth > 0.0 ? force / depth : 0.0;
  return seen;
}

TEST_F(Trainee, FeelsTwelveSitesInAClosedLoopAndTheirStiffnessAsItIs) {
  const HiddenNow hidden{.site = 5, .change = 0.28};
  BodyTouch touch(worlds(), sites_, {});
  touch.change(hidden);
  Exploration exploration(sites_, protocol_.exploration, touch.tickS());
  Random random(1);
  for (const Site& site : sites_.sites) {
    std::vector<trace::Sample> samples;
    const MeantPress meant{.beside_mm = Vec2(1.5 * random.normal(), 1.5 * random.normal()), .force_n = 1.5};
    const FeltPress felt = touch.press(site, meant, [&](const trace::Sample& sample) {
      samples.push_back(sample);
      exploration.follow(sample);
    });
    const SeenPress seen = seenPress(samples, site.place_mm);
    EXPECT_GE(seen.over_half_newton_s, 0.3) << site.number;
    const double ratio = site.number == hidden.site ? 1.0 / 0.72 : 1.0;
    EXPECT_NEAR(seen.stiffness / protocol_.base_n_per_mm, ratio, 0.02) << site.number;
    EXPECT_NEAR(felt.stiffness() / protocol_.base_n_per_mm, ratio, 0.01) << site.number;
    EXPECT_NEAR(felt.force_n, meant.force_n, 0.2) << site.number;
    EXPECT_TRUE(felt.reached);
  }
  EXPECT_EQ(exploration.visitedSites(), 12);
}

TEST_F(Trainee, PressesTheLargestChangeHardEnoughToo) {
  BodyTouch touch(worlds(), sites_, {});
  touch.change(HiddenNow{.site = 9, .change = kMaxComplianceChange});
  const FeltPress felt = touch.press(*sites_.numbered(9), {}, [](const trace::Sample&) {});
  const FeltPress other = touch.press(*sites_.numbered(10), {}, [](const trace::Sample&) {});
  EXPECT_TRUE(felt.reached);
  // The device cannot render it: all forces are softened, and what is compared stays as it is.
  EXPECT_LT(touch.chain().limiter_settings.stiffness_factor, 1.0);
  EXPECT_NEAR(felt.stiffness() / other.stiffness(), 1.0 / (1.0 - kMaxComplianceChange), 0.05);
}

TEST_F(Trainee, MakesTheWorldOfATrialAsTheSceneDoesItBitByBit) {
  const TrialWorlds made = worlds();
  for (const HiddenNow& hidden : {HiddenNow{3, 0.07}, HiddenNow{12, 0.8}}) {
    const auto quick = made.with(hidden);
    const auto slow =
        scene::rebuilt(*body_, trialScene(body_->scene, protocol_, SessionKind::pre_test, sites_, hidden));
    EXPECT_EQ(engine::hashOf(*quick), engine::hashOf(*slow));
    EXPECT_EQ(*quick->surface.stiffness_n_per_mm, *slow->surface.stiffness_n_per_mm);
    EXPECT_NE(engine::hashOf(*quick), engine::hashOf(*made.even()));
  }
  EXPECT_EQ(made.with({}), made.even());
}

TEST_F(Trainee, FeelsTheTwelveSitesOfTheTrunkAndLeavesItsFrontAlone) {
  scene::Scene scene = fingertipScene();
  scene.body.triangles = 14000;
  body_ = scene::build(scene);
  sites_ = sitesOn(*body_, protocol_);
  const HiddenNow hidden{.site = 8, .change = 0.5};
  const auto slow = scene::rebuilt(*body_, trialScene(scene, protocol_, SessionKind::pre_test, sites_, hidden));
  const TrialWorlds made = worlds();
  EXPECT_EQ(*made.with(hidden)->surface.stiffness_n_per_mm, *slow->surface.stiffness_n_per_mm);
  BodyTouch touch(made, sites_, {});
  touch.change(hidden);
  for (const Site& site : sites_.sites) {
    const double ratio = touch.press(site, {}, [](const trace::Sample&) {}).stiffness() / protocol_.base_n_per_mm;
    EXPECT_NEAR(ratio, site.number == 8 ? 2.0 : 1.0, 0.03) << site.number;
  }
}

TEST_F(Trainee, SaysWhichHandGoesNowhere) {
  BodyTouchSettings settings;
  settings.hand = device::handChoice("released");
  EXPECT_NE(support::thrownMessage([&] { BodyTouch(worlds(), sites_, settings); }).find("released"), std::string::npos);
}

TEST_F(Trainee, OfATwentyPercentThresholdIsMeasuredAsOne) {
  Store store = recordsIn("a");
  const SessionOutcome sat = runSession(store, bench(true, false), request("weber=0.2"));
  ASSERT_TRUE(sat.result);
  EXPECT_EQ(sat.trials.size(), 43u);  // three to warm up
  EXPECT_EQ(sat.block.trials, 40);
  EXPECT_LT(sat.block.threshold_low, 0.2);
  EXPECT_GT(sat.block.threshold_high, 0.2);
  EXPECT_LT(sat.block.threshold_high / sat.block.threshold_low, 2.5);
  EXPECT_TRUE(std::ranges::all_of(sat.trials, [](const TrialRow& trial) { return trial.sites_felt == 12; }));
  EXPECT_TRUE(std::ranges::all_of(sat.trials, [](const TrialRow& trial) {
    return trial.seconds > 10.0 && trial.seconds < 45.0 && trial.excluded.empty();
  }));
  EXPECT_EQ(store.blocks(sat.row.id).front().threshold, sat.block.threshold);
}

TEST_F(Trainee, WithoutABodyAnswersAsWithOne) {
  Store with_body = recordsIn("a");
  Store without = recordsIn("b");
  TraineeSession session = request("weber=0.2", 5);
  session.most_trials = 20;
  const SessionOutcome felt = runSession(with_body, bench(true, false), session);
  const SessionOutcome imagined = runSession(without, bench(false), session);
  ASSERT_EQ(felt.trials.size(), imagined.trials.size());
  int same = 0;
  for (std::size_t i = 0; i < felt.trials.size(); ++i) {
    if (felt.trials[i].site_answer == imagined.trials[i].site_answer) ++same;
  }
  EXPECT_GE(same, 19);  // what its fingers add to its own noise is next to nothing
  EXPECT_EQ(imagined.row.device, "simulated, no body");
  EXPECT_EQ(felt.row.device, "simulated thimble on touch_x");
  EXPECT_TRUE(imagined.row.file.empty());
}

TEST_F(Trainee, WhoSearchesEightSitesIsFlaggedInEveryTrialAndMeasuredAllTheSame) {
  constexpr double kTruth = 0.28;
  constexpr int kRuns = 40;
  Store store = recordsIn("a");
  double ln_corrected = 0.0;
  double ln_naive = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    TraineeSession session = request("weber=0.28,sites=8", 100 + static_cast<std::uint64_t>(run));
    session.start_ms += run;
    const SessionOutcome sat = runSession(store, bench(false), session);
    for (const TrialRow& trial : sat.trials) {
      ASSERT_EQ(trial.sites_felt, 8);
      const bool pressed = std::ranges::any_of(
          trial.visits, [&](const SiteVisit& visit) { return visit.site == trial.site_true && visit.presses > 0; });
      ASSERT_EQ(trial.excluded.empty(), pressed);
    }
    const std::vector<EventRow> events = store.events(sat.row.id);
    EXPECT_EQ(std::ranges::count(events, "warning", &EventRow::kind), static_cast<int>(sat.trials.size()));
    Posterior naive;  // as if every site had been felt
    for (const TrialRow& trial : sat.trials) {
      if (trial.kind != TrialKind::warm_up) naive.add({.change = trial.change, .correct = trial.correct});
    }
    ln_corrected += std::log(sat.block.threshold) / kRuns;
    ln_naive += std::log(naive.summary().median) / kRuns;
  }
  EXPECT_NEAR(std::exp(ln_corrected) / kTruth, 1.0, 0.10);
  EXPECT_GT(std::exp(ln_naive) / kTruth, 1.25);
}

TEST_F(Trainee, WhoTouchesTooLightlyHasFeltNothing) {
  Store store = recordsIn("a");
  TraineeSession session = request("press_n=0.2");
  session.most_trials = 3;
  for (const TrialRow& trial : runSession(store, bench(true, false), session).trials) {
    EXPECT_EQ(trial.sites_felt, 0);
    EXPECT_EQ(trial.excluded, "target not felt");
    EXPECT_LT(trial.peak_force_n, 0.5);
  }
}

TEST_F(Trainee, WhoTakesTooLongRunsOutOfTime) {
  Store store = recordsIn("a");
  TraineeSession session = request("press_s=4");
  session.most_trials = 2;
  const SessionOutcome sat = runSession(store, bench(true, false), session);
  ASSERT_EQ(sat.trials.size(), 2u);
  for (const TrialRow& trial : sat.trials) {
    EXPECT_TRUE(trial.timed_out);
    EXPECT_EQ(trial.site_answer, 0);
    EXPECT_NEAR(trial.seconds, 45.0, 0.01);
  }
}

TEST_F(Trainee, LeavesTheSameRecordsFromTheSameSeed) {
  TraineeSession session = request("weber=0.2");
  session.most_trials = 2;
  std::array<SessionOutcome, 3> sat;
  std::array<std::vector<std::string>, 3> ids;
  for (std::size_t i = 0; i < 3; ++i) {
    session.seed = i < 2 ? 1 : 2;
    Store store = recordsIn(std::to_string(i));
    sat.at(i) = runSession(store, bench(true), session);
    for (const TrialRow& trial : sat.at(i).trials) ids.at(i).push_back(trial.id);
  }
  EXPECT_EQ(ids[0], ids[1]);
  EXPECT_EQ(sat[0].row.id, sat[1].row.id);
  EXPECT_EQ(sat[0].block.state_json, sat[1].block.state_json);
  EXPECT_EQ(sat[0].row.file_sha256, sat[1].row.file_sha256);  // the recording to the last byte
  EXPECT_EQ(sat[0].trials.back().mean_force_n, sat[1].trials.back().mean_force_n);
  EXPECT_NE(sat[0].row.file_sha256, sat[2].row.file_sha256);
  EXPECT_NE(ids[0], ids[2]);
}

TEST_F(Trainee, GoesOnWithTheBlockThatItWasTornFrom) {
  protocol_.pre_test.block.easy = 1;
  protocol_.pre_test.block.stop = {.least = 9, .most = 9};  // and three to warm up
  Store store = recordsIn("a");
  TraineeBench torn = bench(true);
  int trials = 0;
  torn.answered = [&](const TrialRow&) {
    if (++trials == 7) throw std::runtime_error("torn");
  };
  TraineeSession session = request("weber=0.2");
  EXPECT_THROW(runSession(store, torn, session), std::runtime_error);
  const auto interrupted = store.interrupted(trainee_.id, SessionKind::pre_test);
  ASSERT_TRUE(interrupted);
  EXPECT_EQ(interrupted->session.end_ms, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a" / (interrupted->session.file + ".partial")));
  const std::size_t kept = store.trials(interrupted->block.id).size();
  EXPECT_EQ(kept, 7u);

  session.start_ms += 3'600'000;
  const SessionOutcome sat = runSession(store, bench(true), session);
  EXPECT_TRUE(sat.resumed);
  EXPECT_EQ(sat.block.id, interrupted->block.id);
  EXPECT_NE(sat.row.id, interrupted->session.id);
  EXPECT_EQ(sat.trials.front().number, 8);
  EXPECT_EQ(sat.trials.size(), 5u);
  EXPECT_TRUE(sat.block.finished);
  EXPECT_FALSE(store.interrupted(trainee_.id, SessionKind::pre_test));
  const std::vector<TrialRow> all = store.trials(sat.block.id);
  ASSERT_EQ(all.size(), 12u);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].number, static_cast<int>(i) + 1);
  EXPECT_EQ(all[6].session_id, interrupted->session.id);
  EXPECT_EQ(all[7].session_id, sat.row.id);
}

TEST_F(Trainee, IsReplayedFromItsRecording) {
  Store store = recordsIn("a");
  TraineeSession session = request("weber=0.2,sites=9");
  session.most_trials = 3;
  const SessionOutcome sat = runSession(store, bench(true), session);
  const std::filesystem::path file = store.folder() / sat.row.file;
  trace::RecordingReader recording(file);

  // Ticks without a gap, from the first screen to the last.
  std::uint64_t next = 0;
  recording.forEachTick({}, [&](std::span<const trace::Sample> tick) { return tick.front().tick == next++; });
  EXPECT_EQ(next, recording.facts().samples);
  EXPECT_EQ(static_cast<double>(next) * 0.001, sat.simulated_s);

  std::multimap<std::uint64_t, std::string> marks;
  for (const trace::RecordingEvent& event : recording.events()) {
    if (event.kind == "mark") marks.emplace(event.tick, event.text);
  }
  const auto marked = [&](std::uint64_t tick, const std::string& text) {
    const auto [from, to] = marks.equal_range(tick);
    return std::any_of(from, to, [&](const auto& mark) { return mark.second == text; });
  };
  for (const TrialRow& trial : sat.trials) {
    const std::string name = "trial " + std::to_string(trial.number);
    EXPECT_TRUE(marked(trial.file_tick_first, name)) << name;
    EXPECT_TRUE(marked(trial.file_tick_last, name + " answered " + std::to_string(trial.site_answer))) << name;
    Exploration again(sites_, protocol_.exploration, 0.001);
    recording.forEachTick({trial.file_tick_first, trial.file_tick_last - 1}, [&](std::span<const trace::Sample> tick) {
      again.follow(tick.front());
      return true;
    });
    const std::vector<SiteVisit> visits = again.visits();
    ASSERT_EQ(visits.size(), trial.visits.size());
    for (std::size_t i = 0; i < visits.size(); ++i) {
      EXPECT_EQ(visits[i].site, trial.visits[i].site);
      EXPECT_EQ(visits[i].presses, trial.visits[i].presses);
      EXPECT_EQ(visits[i].dwell_ms, trial.visits[i].dwell_ms);
      EXPECT_EQ(visits[i].peak_force_n, trial.visits[i].peak_force_n);
      EXPECT_EQ(visits[i].mean_force_n, trial.visits[i].mean_force_n);
      EXPECT_EQ(visits[i].deepest_mm, trial.visits[i].deepest_mm);
    }
  }
  // The worlds that the file names, built the long way, give the same forces.
  const engine::ReplayReport replayed = engine::replay(recording);
  EXPECT_TRUE(replayed.identical()) << (replayed.notes.empty() ? "" : replayed.notes.front());
  EXPECT_EQ(replayed.ticks, recording.facts().samples);
}

TEST_F(Trainee, LearnsThroughTheWholeCourse) {
  Store store = recordsIn("a");
  TraineeCourse course;
  course.observer = observerNamed("weber=0.28,weber_end=0.14,learning_blocks=1.5");
  course.trainee = trainee_.id;
  course.kinds = vhbCourse();
  course.goes_on = true;
  course.seed = 3;
  course.start_ms = kStartMs;
  // Torn away in the third practice; the same words again go on from there.
  TraineeBench torn = bench(false);
  int sessions = 0;
  EXPECT_THROW(runProgramme(store, torn, course,
                            [&](const SessionOutcome&) {
                              if (++sessions == 3) throw std::runtime_error("torn");
                            }),
               std::runtime_error);
  std::vector<SessionOutcome> rest;
  runProgramme(store, bench(false), course, [&](const SessionOutcome& sat) { rest.push_back(sat); });
  ASSERT_EQ(rest.size(), 5u);
  const std::vector<SessionRow> kept = store.sessions(trainee_.id);
  ASSERT_EQ(kept.size(), 8u);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(kept[i].kind, vhbCourse()[i]);
    if (i == 0) continue;
    EXPECT_GT(kept[i].start_ms, kept[i - 1].end_ms);
  }
  const double before = store.blocks(kept.front().id).front().threshold;
  EXPECT_NEAR(before, 0.28, 0.10);
  EXPECT_NEAR(rest.back().block.threshold, 0.14, 0.05);
}

TEST(TraineeClass, SpreadsAroundItsMeansAndWhoBeginsWellEndsWell) {
  const ObserverSettings mean = observerNamed("weber=0.28,weber_end=0.14");
  constexpr int kTrainees = 4000;
  double before = 0.0;
  double squares = 0.0;
  double after = 0.0;
  double together = 0.0;
  for (int i = 0; i < kTrainees; ++i) {
    const ObserverSettings one = oneOfClass(mean, 0.33, 1, i);
    before += one.weber / kTrainees;
    after += one.weber_end / kTrainees;
    squares += (one.weber - 0.28) * (one.weber - 0.28) / kTrainees;
    together += (one.weber - 0.28) * (one.weber_end - 0.14) / kTrainees;
  }
  EXPECT_NEAR(before, 0.28, 0.006);
  EXPECT_NEAR(after, 0.14, 0.003);
  EXPECT_NEAR(std::sqrt(squares), 0.095, 0.006);  // Howell 2008
  EXPECT_GT(together, 0.3 * squares / 2.0);
}

}  // namespace
}  // namespace palpate::training

// A sitting with lumps on a body: what it asks, what it keeps, and that an examination shows nothing.
#include "palpate/training/session/lump_session.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "palpate/scene/lumps_of_body.h"
#include "palpate/scene/world.h"
#include "palpate/training/records/verify.h"
#include "palpate/training/trainee/trainee_course.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::training {
namespace {

using lumps::LumpQuestion;

constexpr std::int64_t kSessionStartMs = 1'790'000'000'000;

/// A coarse trunk with one fingertip; built once.
std::shared_ptr<const scene::World> trunk() {
  static const auto world = [] {
    scene::Scene scene;
    scene.body.kind = scene::BodyKind::trunk;
    scene.body.triangles = 14000;
    scene::Finger finger;
    finger.name = "index";
    finger.radius_mm = 8.0;
    scene.fingers.push_back(finger);
    return scene::build(scene);
  }();
  return world;
}

Protocol shortProtocol() {
  Protocol protocol = builtInLumpProtocol();
  protocol.id = "short";
  protocol.lump->bodies = 4;
  return protocol;
}

SessionPlan planOfLumps(SessionKind kind) {
  static const Protocol protocol = shortProtocol();
  static const SiteSet sites = sitesOn(*trunk(), protocol);
  static const auto bodies = std::make_shared<const LumpBodies>(trunk(), protocol, sites);
  SessionPlan plan;
  plan.protocol = protocol;
  plan.kind = kind;
  plan.bodies = bodies;
  plan.sites = sites;
  plan.row.id = "018f3c1e-0000-7000-8000-000000000001";
  return plan;
}

Moment at(double s) { return {.s = s, .utc_ms = kSessionStartMs + std::llround(1000.0 * s), .tick = 0}; }

TEST(LumpBodies, HideLumpsWhereThereIsRoomAndNowhereElse) {
  const SessionPlan plan = planOfLumps(SessionKind::lump);
  ASSERT_GT(plan.bodies->places().size(), 100U);
  for (std::size_t i = 0; i < plan.bodies->places().size(); i += 97) {
    const lumps::HiddenLump largest{.place_mm = plan.bodies->places()[i], .size = 2, .depth = 2, .hardness = 2};
    const auto world = plan.bodies->with(std::span(&largest, 1));
    ASSERT_EQ(world->lumps.size(), 1U);
    EXPECT_EQ(world->lumps.front()->settings.diameter_mm, plan.protocol.lump->diameters_mm[2]);
  }
}

TEST(LumpBodies, ALargeHardShallowLumpIsPlainerThanASmallSoftDeepOne) {
  const SessionPlan plan = planOfLumps(SessionKind::lump);
  const Vec2 place = plan.bodies->places()[plan.bodies->places().size() / 2];
  const double plain = plan.bodies->computeClarity({.place_mm = place, .size = 2, .depth = 0, .hardness = 2});
  const double faint = plan.bodies->computeClarity({.place_mm = place, .size = 0, .depth = 2, .hardness = 0});
  EXPECT_GT(plain, 10.0);
  EXPECT_LT(faint, 1.0);
  EXPECT_GT(faint, 0.0);
}

TEST(LumpSession, AnExaminationNeverShowsALump) {
  LumpSession session(planOfLumps(SessionKind::lump_exam), at(0));
  double now = 0.0;
  for (int i = 0; session.screen() != Screen::finished; ++i) {
    ASSERT_LT(i, 1000);
    EXPECT_TRUE(session.shown().empty());
    EXPECT_FALSE(session.padShown());
    now += 1.0;
    if (session.screen() != Screen::trial) {
      session.next(at(now));
    } else if (session.question() != LumpQuestion::place) {
      ASSERT_TRUE(session.answer(1, at(now)));
    } else if (session.named().size() == 3) {
      ASSERT_TRUE(session.noMore(at(now)));
    } else {
      ASSERT_TRUE(session.answer(Vec2(session.hidden()[session.named().size()].place_mm), at(now)));
    }
  }
  EXPECT_EQ(session.counts().found, lumps::kExamLumps);
}

TEST(LumpSession, APauseHidesNothingTakesNoAnswerAndIsNoTimeOfTheBody) {
  LumpSession session(planOfLumps(SessionKind::lump_exam), at(0));
  session.pause(at(0));
  EXPECT_FALSE(session.paused()) << "nothing is asked yet";
  session.next(at(1));
  session.ready(at(2));
  session.pause(at(5));
  EXPECT_TRUE(session.paused());
  EXPECT_TRUE(session.hidden().empty());
  EXPECT_FALSE(session.noMore(at(6)));
  session.ready(at(7));  // the empty body is felt
  session.goOn(at(105));
  EXPECT_EQ(session.hidden().size(), 3U);
  ASSERT_TRUE(session.noMore(at(106)));
  ASSERT_EQ(session.trials().size(), 1U);
  EXPECT_DOUBLE_EQ(session.trials().front().seconds, 4.0);
  std::vector<std::string> events;
  for (const Row& row : session.drainRows()) {
    if (const auto* event = std::get_if<EventRow>(&row)) events.push_back(event->kind);
  }
  EXPECT_EQ(events, (std::vector<std::string>{"pause", "resume"}));
}

TEST(LumpSession, PracticeShowsTheLumpInItsFeedbackAlone) {
  LumpSession session(planOfLumps(SessionKind::lump), at(0));
  session.next(at(1));
  int shown = 0;
  while (session.screen() != Screen::block_summary) {
    ASSERT_EQ(session.screen(), Screen::trial);
    EXPECT_TRUE(session.shown().empty());
    EXPECT_FALSE(session.padShown());
    ASSERT_TRUE(session.answer(0, at(2)));
    ASSERT_EQ(session.screen(), Screen::feedback);
    EXPECT_EQ(session.shown(), session.hidden());
    EXPECT_TRUE(session.padShown());
    shown += static_cast<int>(session.shown().size());
    EXPECT_NE(session.said().text.find(session.shown().empty() ? "There was none" : "There was one"),
              std::string::npos);
    session.next(at(3));
  }
  EXPECT_GT(shown, 0);
}

TEST(LumpSession, EveryAnswerIsInTheRowsAndASittingGoesOnFromIt) {
  SessionPlan plan = planOfLumps(SessionKind::lump_exam);
  LumpSession session(plan, at(0));
  session.next(at(1));
  session.answer(Vec2(session.hidden().front().place_mm), at(2));
  session.answer(2, at(3));
  session.drainRows();
  session.answer(1, at(4));
  const std::vector<Row> rows = session.drainRows();
  ASSERT_EQ(rows.size(), 1U) << "one answer, one row";
  plan.resumed = std::get<BlockRow>(rows.front());
  plan.row.id = "018f3c1e-0000-7000-8000-000000000002";
  LumpSession again(plan, at(100));
  again.next(at(101));
  EXPECT_EQ(again.question(), LumpQuestion::hardness);
  EXPECT_EQ(again.named(), session.named());
  EXPECT_EQ(again.hidden(), session.hidden());
}

TEST(LumpSession, NeedsAProtocolWithLumps) {
  const Protocol plain = builtInProtocol();
  const std::string message = support::thrownMessage([&] { LumpBodies(trunk(), plain, sitesOn(*trunk(), plain)); });
  EXPECT_NE(message.find("[lump]"), std::string::npos) << message;
}

/// A whole examination by a trainee whose hand is in the loop: kept, and verified by what was kept.
TEST(LumpTrainee, OneWhoMissesNothingFindsWhatIsPlain) {
  const support::TemporaryFolder folder;
  Store store(folder / "r.results", Store::Open::create_too);
  TraineeBench bench;
  bench.protocol = shortProtocol();
  bench.body = trunk();
  bench.sites = sitesOn(*trunk(), bench.protocol);
  bench.recording_files = false;
  const StationRow station = simulatedStation(kSessionStartMs);
  store.save(station);
  store.save(makeProtocolRow(bench.protocol));
  bench.station = station.id;
  const TraineeRow trainee = simulatedTrainee("", "7Q2MK9DX", kSessionStartMs, "");
  store.save(trainee);
  TraineeSession wanted;
  wanted.kind = SessionKind::lump_exam;
  wanted.trainee = trainee.id;
  wanted.start_ms = kSessionStartMs;
  wanted.lump_observer.spread = 0.05;
  wanted.lump_observer.false_alarms = 0.0;
  wanted.most_trials = 2;
  const SessionOutcome begun = runSession(store, bench, wanted);
  EXPECT_FALSE(begun.block.finished);
  EXPECT_EQ(begun.trials.size(), 2U);
  wanted.most_trials = 0;
  wanted.seed = 2;
  wanted.start_ms += 86'400'000;
  const SessionOutcome ended = runSession(store, bench, wanted);
  EXPECT_TRUE(ended.resumed);
  EXPECT_TRUE(ended.block.finished);
  EXPECT_EQ(ended.trials.size(), 4U);
  EXPECT_EQ(ended.lumps.lumps, lumps::kExamLumps);
  EXPECT_GE(ended.lumps.found, 6) << "what is plain";
  EXPECT_LT(ended.lumps.found, lumps::kExamLumps) << "and not what nobody feels";
  EXPECT_EQ(ended.lumps.false_places, 0);
  const std::vector<TrialRow> kept = store.trials(begun.block.id);
  ASSERT_EQ(kept.size(), static_cast<std::size_t>(lumps::kExamBodies));
  EXPECT_GT(kept.back().mean_force_n, 0.1) << "it was felt";
  const Verified verified = verifyRecords(store);
  EXPECT_TRUE(verified.ok()) << (verified.faults.empty() ? "" : verified.faults.front());
  EXPECT_EQ(verified.recomputed, 1U);
}

}  // namespace
}  // namespace palpate::training

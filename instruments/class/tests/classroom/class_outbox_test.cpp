// Rows of stations reach the class's records, each once, although broker, collector and database die on the way; the
// instructor sees and asks; a deletion reaches the class and what the broker keeps.
#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <thread>

#include "class/tests/classroom/class_broker.h"
#include "class/tests/support/postgres_server.h"
#include "palpate/classroom/class_store.h"
#include "palpate/classroom/class_watch.h"
#include "palpate/classroom/collector.h"
#include "palpate/classroom/station_link.h"
#include "palpate/training/records/deletion.h"
#include "support/wait_for.h"
#include "teach/tests/training/records_samples.h"

namespace palpate::classroom {
namespace {

namespace rows = training::samples;
using support::waitFor;
using training::Store;

/// Quicker than in a class, so that a test need not wait for what was lost.
constexpr OutboxPace kQuickPace = {500.0, 0.5, 200};

class ClassOutboxTest : public brokers::BrokerTest {
 protected:
  void SetUp() override {
    BrokerTest::SetUp();
    if (IsSkipped()) return;
    records_ = temporary_ / "class.results";
  }
  std::unique_ptr<Store> storeOf(const std::string& name) const {
    return std::make_unique<Store>(temporary_ / (name + ".results"), Store::Open::create_too);
  }
  std::unique_ptr<Collector> collector() const { return std::make_unique<Collector>(ingest(), fileSink(records_)); }

  std::filesystem::path records_;
};

/// Trials of one block, one after the other, as a session keeps them.
class Trainee {
 public:
  explicit Trainee(Store& store, std::uint64_t number, const std::string& at = "s01") : store_(store) {
    const auto who = rows::trainee("T" + std::to_string(number));
    trainee = who.id;
    training::StationRow station = rows::station();
    station.id = deriveStationId("osteo-1", at);
    store_.save(station);
    store_.save(rows::aClass());
    store_.save(who);
    store_.save(rows::protocol());
    session_ = rows::session(who, number);
    session_.station_id = station.id;
    block_ = rows::block(session_, number);
    block_.finished = false;
    store_.save(std::vector<training::Row>{session_, block_});
  }
  void answer() {
    const auto number = static_cast<std::uint64_t>(++trials_);
    block_.trials = trials_;
    block_.finished = trials_ == kTrials;
    const auto trial = rows::trial(
        block_, 1000 * block_.id.size() + number + std::hash<std::string>()(block_.id) % 99991, trials_, random_);
    store_.save(std::vector<training::Row>{block_, trial});
    kept.insert(trial.id);
  }

  static constexpr int kTrials = 30;
  std::set<training::Uuid> kept;
  training::Uuid trainee;

 private:
  Store& store_;
  training::SessionRow session_;
  training::BlockRow block_;
  int trials_ = 0;
  Random random_{7};
};

std::multiset<training::Uuid> trialsIn(training::RowTables& tables) {
  std::multiset<training::Uuid> ids;
  for (const training::AnyRow& row : tables.all()) {
    if (const auto* trial = std::get_if<training::TrialRow>(&row)) ids.insert(trial->id);
  }
  return ids;
}

TEST_F(ClassOutboxTest, RowsOfAStationReachTheClassAndLeaveTheOutbox) {
  const auto store = storeOf("s01");
  Trainee trainee(*store, 1);
  for (int i = 0; i < 5; ++i) trainee.answer();
  const StationLink link(station("s01"), *store, {"palpate", "mouse"}, kQuickPace);
  EXPECT_TRUE(waitFor([&] { return link.connected(); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  EXPECT_GT(store->waitingCount(), 0U) << "without a collector everything waits, whatever the broker says";
  const auto collects = collector();
  EXPECT_TRUE(waitFor([&] { return store->waitingCount() == 0; }));
  Store gathered(records_, Store::Open::read_only);
  EXPECT_EQ(rows::saidAll(gathered.rows().all()), rows::saidAll(store->rows().all()));
}

TEST_F(ClassOutboxTest, EveryTrialIsThereOnceAlthoughBrokerAndCollectorAreKilled) {
  std::vector<std::unique_ptr<Store>> stores;
  std::vector<std::unique_ptr<Trainee>> trainees;
  std::vector<std::unique_ptr<StationLink>> links;
  std::set<training::Uuid> expected;
  for (const char* name : {"s01", "s02", "s03"}) {
    stores.push_back(storeOf(name));
    trainees.push_back(std::make_unique<Trainee>(*stores.back(), stores.size(), name));
    links.push_back(
        std::make_unique<StationLink>(station(name), *stores.back(), StationInfo{"palpate", "mouse"}, kQuickPace));
  }
  auto collects = collector();
  for (int i = 0; i < Trainee::kTrials; ++i) {
    for (auto& trainee : trainees) trainee->answer();
    std::this_thread::sleep_for(std::chrono::milliseconds(40));
    if (i == 8 || i == 20) broker_->kill();
    if (i == 11 || i == 23) broker_->restart();
    if (i == 5 || i == 21) collects.reset();
    if (i == 13 || i == 26) collects = collector();
  }
  for (const auto& trainee : trainees) expected.insert(trainee->kept.begin(), trainee->kept.end());
  ASSERT_EQ(expected.size(), 90U);
  EXPECT_TRUE(waitFor(
      [&] { return std::ranges::all_of(stores, [](const auto& store) { return store->waitingCount() == 0; }); }));
  Store gathered(records_, Store::Open::read_only);
  const auto there = trialsIn(gathered.rows());
  EXPECT_EQ(std::set<training::Uuid>(there.begin(), there.end()), expected);
  EXPECT_EQ(there.size(), expected.size());
  for (const auto& block : gathered.rows().blocks(gathered.sessions().front().id)) {
    EXPECT_TRUE(block.finished) << "an older state of the block has replaced the newest";
  }
}

TEST_F(ClassOutboxTest, TheDatabaseMayDieOnTheWay) {
  const auto server = support::PostgresServer::started();
  if (server == nullptr) GTEST_SKIP() << support::PostgresServer::kNotInstalled;
  const std::string connection = server->connection("class");
  const auto store = storeOf("s01");
  Trainee trainee(*store, 1);
  const StationLink link(station("s01"), *store, {"palpate", "mouse"}, kQuickPace);
  const Collector collects(ingest(), databaseSink(connection));
  for (int i = 0; i < Trainee::kTrials; ++i) {
    trainee.answer();
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    if (i == 8) server->kill();
    if (i == 20) server->start();
  }
  EXPECT_TRUE(waitFor([&] { return store->waitingCount() == 0; })) << collects.report().trouble;
  ClassStore gathered(connection);
  const auto there = trialsIn(gathered.rows());
  EXPECT_EQ(std::set<training::Uuid>(there.begin(), there.end()), trainee.kept);
  EXPECT_EQ(there.size(), trainee.kept.size());
}

TEST_F(ClassOutboxTest, TheInstructorSeesTheStationAndAsksIt) {
  const auto store = storeOf("s01");
  auto link = std::make_unique<StationLink>(station("s01"), *store, StationInfo{"palpate", "Touch"}, kQuickPace);
  ClassWatch watch(instructor());
  StationState state;
  state.session = rows::id(2, 1);
  state.trainee = rows::trainee().id;
  state.screen = training::Screen::trial;
  state.trial = 4;
  link->publishState(state);
  LiveSample live;
  live.force_n = 1.5;
  EXPECT_TRUE(waitFor([&] {
    link->publishLive(live);
    const auto tile = watch.tile("s01");
    return tile && tile->online && tile->state && tile->live.force_n == 1.5;
  }));
  EXPECT_EQ(watch.tile("s01")->state->trial, 4);
  EXPECT_EQ(watch.tile("s01")->status.device, "Touch");

  EXPECT_TRUE(watch.ask("s01", {CommandKind::message, "Well done"}));
  std::optional<Command> command;
  EXPECT_TRUE(waitFor([&] { return (command = link->popCommand()).has_value(); }));
  EXPECT_EQ(command->text, "Well done");

  link.reset();  // signs off
  EXPECT_TRUE(waitFor([&] { return !watch.tile("s01")->online && !watch.tile("s01")->state; }));
  const ClassWatch late(instructor());
  EXPECT_TRUE(waitFor([&] { return late.tile("s01").has_value(); }));
  EXPECT_FALSE(late.tile("s01")->state) << "the retained state was not cleared";
}

TEST_F(ClassOutboxTest, LiveSamplesGoOutTenTimesASecond) {
  const auto store = storeOf("s01");
  StationLink link(station("s01"), *store, {"palpate", "mouse"});
  std::atomic<int> seen = 0;
  MqttSettings settings = makeMqttSettings(instructor());
  settings.subscriptions = {{topicText({"osteo-1", "s01", "live"}), 0}};
  const MqttLink viewer(settings, {[&](auto, auto payload) { seen += parseLive(payload) ? 1 : 0; }, {}});
  ASSERT_TRUE(waitFor([&] { return link.connected() && viewer.connected(); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const auto until = Clock::now() + std::chrono::seconds(2);
  while (Clock::now() < until) {
    link.publishLive({});
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_GE(seen, 12);  // a busy machine sends fewer
  EXPECT_LE(seen, 22);
}

TEST_F(ClassOutboxTest, WhoIsDeletedIsGoneFromTheClassAndFromTheBroker) {
  const auto store = storeOf("s01");
  Trainee deleted(*store, 1);
  Trainee stays(*store, 2);
  deleted.answer();
  stays.answer();
  auto link = std::make_unique<StationLink>(station("s01"), *store, StationInfo{"palpate", "mouse"}, kQuickPace);
  StationState state;
  state.session = rows::id(2, 1);
  state.trainee = deleted.trainee;
  link->publishState(state);
  const auto collects = collector();
  ASSERT_TRUE(waitFor([&] { return store->waitingCount() == 0; }));
  ClassWatch watch(instructor());
  ASSERT_TRUE(waitFor([&] { return watch.tile("s01") && watch.tile("s01")->state; }));

  const training::DeletionRow deletion{training::deletedMark(deleted.trainee), training::utcMs()};
  const Envelope envelope{1, training::outboxKey(deletion), 0.0};
  const auto ask = [&](const Member& who, const std::string& as) {
    MqttLink link(makeMqttSettings(who), {});
    return waitFor([&] { return link.connected(); }) &&
           link.publish(
               {topicText({"osteo-1", as, "delete"}), rowText(envelope, training::rowJson(deletion)), 1, false, 0});
  };
  Store gathered(records_, Store::Open::read_only);
  ASSERT_TRUE(ask(station("s02"), "s02"));
  std::vector<std::string> said;
  EXPECT_TRUE(waitFor([&] { return !(said = collects->drainReports()).empty(); }));
  EXPECT_NE(said.front().find("s02 deleted a trainee: 0 of its sessions are gone; not deleted: 1 of"),
            std::string::npos)
      << said.front();
  EXPECT_TRUE(gathered.trainee(deleted.trainee)) << "another station's notice took it away";
  EXPECT_TRUE(watch.tile("s01")->state);
  ASSERT_TRUE(ask(readMember(addInstructor(folder_)), "instructor"));
  EXPECT_TRUE(waitFor([&] { return !gathered.trainee(deleted.trainee); }));
  EXPECT_TRUE(waitFor([&] { return !watch.tile("s01")->state; })) << "the broker still says who sits there";
  EXPECT_TRUE(gathered.trainee(stays.trainee));
  const auto there = trialsIn(gathered.rows());
  EXPECT_EQ(std::set<training::Uuid>(there.begin(), there.end()), stays.kept);
}

TEST_F(ClassOutboxTest, WhatAStationMayNotWriteIsRefusedSaidAndParkedInItsOutbox) {
  const auto store = storeOf("s01");
  Trainee owner(*store, 1);
  owner.answer();
  const auto link = std::make_unique<StationLink>(station("s01"), *store, StationInfo{"palpate", "mouse"}, kQuickPace);
  const auto collects = collector();
  ASSERT_TRUE(waitFor([&] { return store->waitingCount() == 0; }));

  // Records that were copied to another computer: of a station that s02 is not.
  const auto copied = storeOf("s02");
  Trainee foreign(*copied, 2, "s01");
  foreign.answer();
  const StationLink other(station("s02"), *copied, {"palpate", "mouse"}, kQuickPace);
  EXPECT_TRUE(waitFor([&] { return other.counts().refused >= 4; })) << other.counts().refused;
  EXPECT_TRUE(waitFor([&] { return copied->waiting(100).empty(); })) << "it is not sent for ever";
  EXPECT_EQ(copied->waitingCount(), copied->refusedCount()) << "nothing is lost at the station";
  EXPECT_NE(other.trouble().find("the class refused"), std::string::npos) << other.trouble();
  EXPECT_GE(collects->report().refused, 4u);
  const auto said = collects->drainReports();
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said.front().rfind("s02: ", 0), 0u) << said.front();
  Store gathered(records_, Store::Open::read_only);
  EXPECT_EQ(trialsIn(gathered.rows()).size(), 1u);
}

TEST_F(ClassOutboxTest, AStationHearsOfADeletionInTheClassAndIsWelcomeAfterwards) {
  const auto store = storeOf("s01");
  Trainee gone(*store, 1);
  gone.answer();
  StationLink link(station("s01"), *store, {"palpate", "mouse"}, kQuickPace);
  const auto collects = collector();
  ASSERT_TRUE(waitFor([&] { return store->waitingCount() == 0; }));
  {
    Store gathered(records_, Store::Open::existing);
    EXPECT_TRUE(training::deleteTrainee(gathered, gone.trainee, "palpate train results").found);
  }
  gone.answer();  // the session that goes on is not kept, and does not wait for ever either
  EXPECT_TRUE(waitFor([&] { return store->waitingCount() == 0; }));
  Store gathered(records_, Store::Open::read_only);
  EXPECT_FALSE(gathered.trainee(gone.trainee));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // the notice, and its confirmation
  EXPECT_TRUE(waitFor([&] { return store->waitingCount() == 0; }));
  const auto again = rows::trainee("T1");
  ASSERT_EQ(again.id, gone.trainee);
  store->save(again);
  auto session = rows::session(again, 50);
  session.station_id = deriveStationId("osteo-1", "s01");
  store->save(std::vector<training::Row>{session});
  EXPECT_TRUE(waitFor([&] { return store->waitingCount() == 0; }));
  EXPECT_EQ(gathered.sessions(gone.trainee).size(), 1u) << "a later sign-in counts, whatever the clocks say";
}

TEST_F(ClassOutboxTest, NobodyIsThrownOutByAClientIdOfAnother) {
  const auto store = storeOf("s01");
  const StationLink link(station("s01"), *store, {"palpate", "mouse"}, kQuickPace);
  const auto collects = collector();
  ASSERT_TRUE(waitFor([&] { return link.connected() && collects->report().connected; }));
  for (int i = 0; i < 10; ++i) {
    for (const char* id : {"palpate-osteo-1-ingest", "palpate-osteo-1-s01", "ingest+", "s01"}) {
      MqttSettings settings = makeMqttSettings(station("s02"));
      settings.client_id = id;
      const MqttLink thief(settings, {});
      EXPECT_TRUE(waitFor([&] { return thief.connected(); }));
      EXPECT_TRUE(link.connected()) << id;
      EXPECT_TRUE(collects->report().connected) << id;
    }
  }
}

TEST_F(ClassOutboxTest, AStationThatFloodsTheInboxWaitsForItself) {
  const auto server = support::PostgresServer::started();
  if (server == nullptr) GTEST_SKIP() << support::PostgresServer::kNotInstalled;
  const std::string connection = server->connection("flood");
  server->kill();  // nothing is taken
  const Collector collects(ingest(), databaseSink(connection));
  ASSERT_TRUE(waitFor([&] { return collects.report().connected; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // its subscriptions
  training::ProtocolRow protocol = rows::protocol();
  protocol.text = std::string(60'000, 'x');
  MqttLink flood(makeMqttSettings(station("s02")), {});
  ASSERT_TRUE(waitFor([&] { return flood.connected(); }));
  std::uint64_t sent = 0;
  for (int version = 2; version < 1000; ++version) {
    protocol.version = version;
    const training::AnyRow row = protocol;
    const OutMessage message{topicText({"osteo-1", "s02", "protocol"}),
                             rowText({sent, training::outboxKey(row), 0.0}, training::rowJson(row)), 1, false, 0};
    EXPECT_LT(message.payload.size(), 1000u);
    if (waitFor([&] { return flood.publish(message); })) ++sent;
  }
  EXPECT_TRUE(waitFor([&] { return collects.report().dropped > 100; }));
  EXPECT_LE(collects.report().inbox_bytes, (std::size_t{4} << 20) + 70'000);
}

}  // namespace
}  // namespace palpate::classroom

// The class's store against a real PostgreSQL 15: every row comes back bit for bit, once, whatever the order and
// however often it was sent; what was acknowledged survives the server's death; who is deleted stays deleted.
#include "palpate/classroom/class_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>
#include <utility>

#include "class/tests/support/postgres_server.h"
#include "palpate/classroom/class_settings.h"
#include "palpate/classroom/collector.h"
#include "palpate/classroom/database_copy.h"
#include "palpate/training/records/schema.h"
#include "palpate/training/records/store.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"
#include "teach/tests/training/records_old_rows.h"
#include "teach/tests/training/records_pace.h"
#include "teach/tests/training/records_suite.h"

namespace palpate::classroom {
namespace {

namespace samples = training::samples;
using support::PostgresServer;
using training::AnyRow;

class ClassStoreTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { server_ = PostgresServer::started().release(); }
  static void TearDownTestSuite() {
    delete server_;
    server_ = nullptr;
  }
  void SetUp() override {
    if (server_ == nullptr) GTEST_SKIP() << PostgresServer::kNotInstalled;
    std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    std::ranges::transform(name, name.begin(), [](char c) { return static_cast<char>(std::tolower(c)); });
    connection_ = server_->connection(name);
  }

  static PostgresServer* server_;
  std::string connection_;
};
PostgresServer* ClassStoreTest::server_ = nullptr;

using training::suite::sorted;

TEST_F(ClassStoreTest, DoesWhatEveryDatabaseMust) {
  for (const training::suite::Case& tried : training::suite::cases()) {
    SCOPED_TRACE(tried.name);
    PostgresSql sql(connection_);
    sql.connect();
    sql.run("DROP SCHEMA public CASCADE; CREATE SCHEMA public");
    ClassStore store(connection_);
    tried.run(store.rows());
  }
}

TEST_F(ClassStoreTest, AFilledDatabaseOfVersionOneComesForwardWhole) {
  {
    PostgresSql sql(connection_);
    sql.connect();
    sql.run(training::old_rows::text("version-1-postgresql.sql"));
    sql.run(training::old_rows::text("version-1-rows.sql"));
  }
  ClassStore store(connection_);
  EXPECT_EQ(training::readSchemaVersion(store.rows().sql()), training::kSchemaVersion);
  EXPECT_EQ(sorted(samples::saidAll(store.rows().all())), sorted(samples::saidAll(training::old_rows::expected())));
  ClassStore again(connection_);  // once is enough
  EXPECT_EQ(again.rows().sql().number("SELECT count(*) FROM schema_version"), training::kSchemaVersion);
}

TEST_F(ClassStoreTest, GivesBackEveryRowAsASqliteFileDoes) {
  const samples::History history = samples::history(3, 2, 12);
  ClassStore store(connection_);
  EXPECT_EQ(store.save(history.rows).keys.size(), history.rows.size());
  const support::TemporaryFolder folder;
  training::Store file(folder / "a.results", training::Store::Open::create_too);
  file.storeAnyRows(history.rows);
  EXPECT_EQ(sorted(samples::saidAll(store.rows().all())), sorted(samples::saidAll(history.rows)));
  EXPECT_EQ(samples::saidAll(store.rows().all()), samples::saidAll(file.rows().all()));  // in the same order
  EXPECT_EQ(store.rows().trialCount(), 72);
}

TEST_F(ClassStoreTest, RowsInAnyOrderAndTwiceAreThereOnce) {
  samples::History history = samples::history(2, 2, 5);
  ClassStore store(connection_);
  std::ranges::reverse(history.rows);
  for (int time = 0; time < 2; ++time) {
    const ClassStore::Kept kept = store.save(history.rows);
    EXPECT_EQ(kept.keys.size(), history.rows.size());
    EXPECT_TRUE(kept.refused.empty());
  }
  EXPECT_EQ(sorted(samples::saidAll(store.rows().all())), sorted(samples::saidAll(history.rows)));
}

TEST_F(ClassStoreTest, ARowWithoutItsBlockIsRefusedAndTheOthersAreKept) {
  const samples::History history = samples::history(1, 1, 3);
  std::vector<AnyRow> rows = history.rows;
  Random random(3);
  const training::TrialRow lonely =
      samples::trial(samples::block(samples::session(samples::trainee(), 1), 99), 7, 1, random);
  rows.insert(rows.begin() + 2, lonely);
  ClassStore store(connection_);
  const ClassStore::Kept kept = store.save(rows);
  EXPECT_EQ(kept.keys.size(), history.rows.size());
  ASSERT_EQ(kept.waits.size(), 1u);
  EXPECT_EQ(kept.waits.front().key, lonely.id);
  EXPECT_NE(kept.waits.front().why.find("cannot be stored before its block"), std::string::npos)
      << kept.waits.front().why;
  EXPECT_EQ(store.rows().trialCount(), 3);
}

TEST_F(ClassStoreTest, AnOlderStateOfABlockDoesNotReplaceANewerOne) {
  const samples::History history = samples::history(1, 1, 0);
  ClassStore store(connection_);
  store.save(history.rows);
  training::BlockRow block = std::get<training::BlockRow>(history.rows[5]);
  const std::string newest = training::rowJson(AnyRow(block));
  block.finished = false;
  block.trials = 3;
  block.state_json = "{}";
  const AnyRow older = block;
  EXPECT_EQ(store.save(std::span(&older, 1)).keys.size(), 1u);  // acknowledged: it is superseded
  EXPECT_EQ(training::rowJson(AnyRow(*store.rows().block(block.id))), newest);
}

TEST_F(ClassStoreTest, WhatWasKeptSurvivesTheServersDeath) {
  const samples::History history = samples::history(1, 2, 10);
  ClassStore store(connection_);
  std::set<training::Uuid> acknowledged;
  std::size_t next = 0;
  for (int death = 0; death < 2; ++death) {
    for (int i = 0; i < 6; ++i, ++next) {
      for (const auto& key : store.save(std::span(&history.rows[next], 1)).keys) acknowledged.insert(key);
    }
    server_->kill();
    EXPECT_THROW(store.save(std::span(&history.rows[next], 1)), DatabaseAway);
    EXPECT_FALSE(store.connected());
    EXPECT_THROW(store.reconnect(), DatabaseAway);
    server_->start();
    store.reconnect();
    EXPECT_TRUE(store.connected());
  }
  std::set<training::Uuid> there;
  for (const AnyRow& row : store.rows().all()) there.insert(training::outboxKey(row));
  EXPECT_EQ(acknowledged.size(), 12u);
  EXPECT_TRUE(std::ranges::includes(there, acknowledged));
}

TEST_F(ClassStoreTest, WhoWasDeletedStaysDeletedWhateverStillComes) {
  const samples::History history = samples::history(3, 2, 4);
  const training::Uuid gone = history.trainees[1].id;
  ClassStore store(connection_);
  store.save(history.rows);
  std::vector<std::string> others;
  for (const AnyRow& row : store.rows().all()) others.push_back(samples::said(row));
  const AnyRow notice = training::DeletionRow{training::deletedMark(gone), training::utcMs()};
  EXPECT_EQ(store.save(std::span(&notice, 1)).keys, std::vector{training::outboxKey(notice)});
  EXPECT_FALSE(store.rows().trainee(gone));
  // A station that was away sends all of it once more, and is told that it need not.
  const ClassStore::Kept again = store.save(history.rows);
  EXPECT_EQ(again.keys.size(), history.rows.size());
  EXPECT_FALSE(store.rows().trainee(gone));
  EXPECT_EQ(store.rows().trialCount(), 16);
  for (const AnyRow& row : store.rows().all()) EXPECT_NE(std::ranges::find(others, samples::said(row)), others.end());
}

TEST_F(ClassStoreTest, PurgeForgetsWhatWasKeptLongEnoughAndNobodyForGood) {
  const samples::History history = samples::history(3, 2, 4);
  constexpr std::int64_t kDay = 86'400'000;
  ClassStore store(connection_);
  store.save(history.rows);
  EXPECT_EQ(store.purge(samples::kMonday + 200 * kDay).sessions, 0);
  EXPECT_EQ(store.rows().trialCount(), 24);
  const training::Purged purged = store.purge(samples::kMonday + 500 * kDay);
  EXPECT_EQ(purged.sessions, 6);
  EXPECT_EQ(purged.trainees, 3);
  EXPECT_EQ(store.rows().trialCount(), 0);
  EXPECT_TRUE(store.rows().trainees().empty());
  EXPECT_EQ(store.purge(samples::kMonday + 500 * kDay).sessions, 0);
  // Who comes back after years is no stranger: their station sends them again (TrainingMode::beginSession).
  const AnyRow trainee = history.trainees[1];
  const AnyRow session = samples::session(history.trainees[1], 600);
  const std::vector<AnyRow> back = {trainee, session};
  EXPECT_EQ(store.save(back).keys.size(), 2u);
  EXPECT_EQ(store.rows().sessions(history.trainees[1].id).size(), 1u);
}

TEST_F(ClassStoreTest, HowLongAClassKeepsThingsIsSaidByItsFolderAndByNoStation) {
  const training::ClassRow ours{"osteo-1", "Osteopathy, first year", 30, 10};
  const auto sink = databaseSink(connection_, {ours});
  const SentRow theirs{training::ClassRow{"osteo-1", "x", 36500, 36500}, deriveStationId("osteo-1", "s01"), "s01"};
  EXPECT_EQ(sink->save(std::span(&theirs, 1)).keys.size(), 1u);
  const training::ClassRow kept = ClassStore(connection_).rows().classes().at(0);
  EXPECT_EQ(kept.label, ours.label);
  EXPECT_EQ(kept.retain_days, 30);
  EXPECT_EQ(kept.retain_samples_days, 10);
}

TEST_F(ClassStoreTest, ACopyInMemoryHoldsEveryRowAndNeverSaysTheAddress) {
  const samples::History history = samples::history(3, 2, 12);
  ClassStore store(connection_);
  store.save(history.rows);
  EXPECT_TRUE(training::isDatabaseAddress(connection_)) << connection_;
  training::Store copy = copyOfDatabase(connection_);
  EXPECT_EQ(samples::saidAll(copy.rows().all()), samples::saidAll(store.rows().all()));
  EXPECT_EQ(copy.file(), "database acopyinmemoryholdseveryrowandneversaystheaddress");
}

TEST_F(ClassStoreTest, ACopyIsOfOneMomentWhileTheCollectorGoesOn) {
  const samples::History history = samples::history(1, 1, 0);
  ClassStore(connection_).save(history.rows);
  std::jthread collector([&](const std::stop_token& ending) {
    ClassStore store(connection_);
    for (std::uint64_t number = 100; number < 300 && !ending.stop_requested(); ++number) {
      const training::TraineeRow trainee = samples::trainee(std::to_string(number));
      const training::SessionRow session = samples::session(trainee, number);
      const std::vector<AnyRow> rows = {trainee, session, samples::block(session, number)};
      store.save(rows);
    }
  });
  std::size_t seen = 0;
  for (int i = 0; i < 10 || (seen < 2 && i < 500); ++i) {
    training::Store copy = copyOfDatabase(connection_);
    const std::size_t trainees = copy.trainees().size();
    EXPECT_EQ(copy.sessions().size(), trainees);
    EXPECT_GE(trainees, std::exchange(seen, trainees));
  }
  EXPECT_GT(seen, 1u);
}

TEST_F(ClassStoreTest, AStrangersDatabaseIsNotCopiedAndGetsNoTables) {
  const std::string words = support::thrownMessage([&] { copyOfDatabase(connection_); });
  EXPECT_NE(words.find("holds no training records"), std::string::npos) << words;
  PostgresSql sql(connection_);
  sql.connect();
  EXPECT_EQ(training::readSchemaVersion(sql), 0);
}

TEST_F(ClassStoreTest, ARoleThatDoesNotOwnTheTablesIsNotToldDeleted) {
  const samples::History history = samples::history(2, 1, 2);
  {
    ClassStore owner(connection_);
    owner.save(history.rows);
    EXPECT_TRUE(owner.erase(history.trainees[0].id, "palpate train results"));
    EXPECT_EQ(owner.notErased(), "");
    owner.rows().sql().run(
        "DROP ROLE IF EXISTS helper; CREATE ROLE helper LOGIN; GRANT SELECT, INSERT, UPDATE, DELETE ON ALL TABLES IN "
        "SCHEMA public TO helper; DROP ROLE IF EXISTS stranger; CREATE ROLE stranger LOGIN");
  }
  const auto as = [&](const std::string& role) {
    std::string connection = connection_;
    connection.replace(connection.find("user=palpate"), 12, "user=" + role);
    return connection;
  };
  ClassStore helper(as("helper"));
  EXPECT_TRUE(helper.erase(history.trainees[1].id, "palpate train results"));
  EXPECT_NE(helper.notErased().find("still in the server's files"), std::string::npos) << helper.notErased();
  EXPECT_NE(helper.notErased().find("VACUUM (FULL)"), std::string::npos);
  const std::string words = support::thrownMessage([&] { copyOfDatabase(as("stranger")); });
  EXPECT_NE(words.find("permission denied"), std::string::npos) << words;
  EXPECT_EQ(words.find("holds no training records"), std::string::npos) << words;
  helper.rows().sql();
  ClassStore owner(connection_);
  owner.rows().sql().run("DROP OWNED BY helper; DROP ROLE helper; DROP ROLE stranger");
}

TEST(DatabaseAddress, WithAPasswordIsRefused) {
  for (const char* address :
       {"postgresql://teacher:secret@localhost/osteo", "host=/run/postgresql dbname=o password=secret",
        "postgresql://localhost/osteo?password=secret", "dbname=o password = 'se cret'"}) {
    const std::string words = support::thrownMessage([&] { ClassStore store(address); });
    EXPECT_NE(words.find("pgpass"), std::string::npos) << words;
    EXPECT_EQ(words.find("secret"), std::string::npos) << words;
    EXPECT_THROW(databaseSink(address), Error);
  }
  refusePassword("postgresql://teacher@localhost/osteo");
  refusePassword("service=osteo passfile=/home/a/.pgpass");
}

TEST(DatabaseAddress, IsToldFromAFile) {
  for (const char* address : {"postgresql://teacher@localhost/osteo", "postgres:///osteo", "dbname=osteo",
                              "host=/run/postgresql dbname=osteo", "service=osteo", "user=me dbname=osteo"}) {
    EXPECT_TRUE(training::isDatabaseAddress(address)) << address;
  }
  for (const char* file : {"class.results", "/home/a/dbname.results", "", "postgresql.results", "./host"}) {
    EXPECT_FALSE(training::isDatabaseAddress(file)) << file;
  }
}

TEST_F(ClassStoreTest, TwelveTrialsASecondAreKeptInTime) {
  ClassStore store(connection_);
  const samples::History history = samples::history(1, 1, 0);
  store.save(history.rows);
  const auto& block = std::get<training::BlockRow>(history.rows[5]);
  const auto measured = training::pace::atTwelveASecond([&](std::uint64_t number) {
    Random random(number);
    const std::vector<AnyRow> rows = {samples::trial(block, number, static_cast<int>(number), random), block};
    EXPECT_EQ(store.save(rows).keys.size(), 2u);
  });
  EXPECT_EQ(static_cast<std::uint64_t>(store.rows().trialCount()), measured.trials);
  training::pace::judge("PostgreSQL", measured);
}

TEST_F(ClassStoreTest, SaysWhatIsWrongWithAConnection) {
  const std::string words = support::thrownMessage([] { ClassStore("host=/tmp/palpate_nowhere dbname=x"); });
  EXPECT_EQ(words.rfind("the class's database: ", 0), 0u) << words;
  EXPECT_EQ(words.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace palpate::classroom

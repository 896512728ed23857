// A station's store: what every database must do (records_suite.h), the outbox, files that are not ours, and what a
// killed program leaves.
#include "palpate/training/records/store.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <csignal>
#include <set>
#include <thread>

#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/trace/database.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"
#include "teach/tests/training/records_samples.h"
#include "teach/tests/training/records_suite.h"

namespace palpate::training {
namespace {

namespace fs = std::filesystem;

class RecordsInSqlite : public testing::TestWithParam<suite::Case> {};

TEST_P(RecordsInSqlite, DoesWhatEveryDatabaseMust) {
  const support::TemporaryFolder folder;
  Store store(folder / "a.results", Store::Open::create_too);
  GetParam().run(store.rows());
}
INSTANTIATE_TEST_SUITE_P(Suite, RecordsInSqlite, testing::ValuesIn(suite::cases()),
                         [](const auto& tried) { return tried.param.name; });

std::vector<std::string> waitingKeys(Store& store) {
  std::vector<std::string> keys;
  for (const OutboxEntry& entry : store.waiting(1000)) keys.push_back(entry.row);
  return keys;
}

TEST(RecordsStore, IsThereAgainAfterItWasClosed) {
  const support::TemporaryFolder folder;
  const samples::History history = samples::history(2, 1, 4);
  Store(folder / "sub/a.results", Store::Open::create_too).storeAnyRows(history.rows);
  Store again(folder / "sub/a.results", Store::Open::read_only);
  EXPECT_EQ(suite::sorted(samples::saidAll(again.rows().all())), suite::sorted(samples::saidAll(history.rows)));
  EXPECT_EQ(fs::status(folder / "sub").permissions(), fs::perms::owner_all);
  const auto allowed = fs::status(folder / "sub/a.results").permissions();
  EXPECT_EQ(allowed & (fs::perms::group_all | fs::perms::others_all), fs::perms::none);
}

/// A limit on the size of files fails as a full disk does.
TEST(RecordsStore, LeavesNoEmptyFileWhereItCannotBegin) {
  const support::TemporaryFolder folder;
  rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto previous = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {0, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message =
      support::thrownMessage([&] { const Store store(folder / "a.results", Store::Open::create_too); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, previous);
  EXPECT_NE(message, "no error");
  EXPECT_FALSE(fs::exists(folder / "a.results"));
}

TEST(RecordsStore, IsAsDurableAsItSays) {
  const support::TemporaryFolder folder;
  Store store(folder / "a.results", Store::Open::create_too);
  Sql& sql = store.rows().sql();
  EXPECT_EQ(std::get<std::string>(sql.ask("PRAGMA journal_mode")[0][0]), "wal");
  EXPECT_EQ(sql.number("PRAGMA synchronous"), 2);  // FULL: each commit waits for the disk
  EXPECT_EQ(sql.number("PRAGMA foreign_keys"), 1);
  EXPECT_EQ(sql.number("PRAGMA secure_delete"), 1);
  EXPECT_EQ(sql.number("SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND sql NOT LIKE '%STRICT' "
                       "AND name NOT LIKE 'sqlite%'"),
            0);
}

TEST(RecordsStore, KeepsAllRowsOfACallOrNone) {
  const support::TemporaryFolder folder;
  Store store(folder / "a.results", Store::Open::create_too);
  const samples::History history = samples::history(1, 1, 2);
  store.storeAnyRows(std::span(history.rows).first(6));
  auto broken = std::get<TrialRow>(history.rows[7]);
  broken.block_id = samples::id(9, 9);
  const std::array<Row, 2> rows = {std::get<TrialRow>(history.rows[6]), broken};
  EXPECT_NE(support::thrownMessage([&] { store.save(rows); }).find("a.results"), std::string::npos);
  EXPECT_EQ(store.rows().trialCount(), 0);
}

TEST(RecordsStore, OutboxHoldsWhatAClassHasNotAcknowledged) {
  const support::TemporaryFolder folder;
  const samples::History history = samples::history(1, 1, 3);
  Store store(folder / "a.results", Store::Open::create_too);
  store.storeAnyRows(std::span(history.rows).first(6));
  EXPECT_EQ(store.waitingCount(), 0u);
  store.fillOutbox(true);  // whatever is there already
  EXPECT_EQ(store.waitingCount(), 6u);
  store.storeAnyRows(std::span(history.rows).subspan(6));
  const auto waiting = store.waiting(1000);
  ASSERT_EQ(waiting.size(), history.rows.size());
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    const AnyRow row = rowFromJson(waiting[i].kind, waiting[i].body);
    EXPECT_EQ(waiting[i].row, outboxKey(row));
    EXPECT_TRUE(i == 0 || waiting[i - 1].number < waiting[i].number);
  }
  EXPECT_EQ(store.waiting(2).size(), 2u);
  EXPECT_EQ(store.waiting(2)[1].number, waiting[1].number);
  const std::vector<Uuid> some = {waiting[0].row, waiting[7].row, "something else"};
  store.acknowledged(some);
  Store again(folder / "a.results", Store::Open::existing);  // it is on the disk
  EXPECT_EQ(again.waitingCount(), waiting.size() - 2);
  EXPECT_TRUE(again.fillsOutbox());
  again.fillOutbox(true);  // is on already: nothing comes twice
  EXPECT_EQ(again.waitingCount(), waiting.size() - 2);
}

/// One trial in a new file, of which every row waits for a class.
struct WaitingRecords {
  WaitingRecords() {
    store.fillOutbox(true);
    store.storeAnyRows(history.rows);
  }
  support::TemporaryFolder folder;
  samples::History history = samples::history(1, 1, 1);
  Store store{folder / "a.results", Store::Open::create_too};
};

TEST(RecordsStore, AcknowledgingAnOldStateLeavesTheNewOneWaiting) {
  WaitingRecords records;
  Store& store = records.store;
  const std::vector<std::string> first = waitingKeys(store);
  auto block = std::get<BlockRow>(records.history.rows[5]);
  const Uuid old_key = outboxKey(AnyRow(block));
  block.state_json = R"({"seed":"7","outcomes":[1,2]})";
  const Row newer = block;
  store.save(std::span(&newer, 1));
  const std::vector<std::string> second = waitingKeys(store);
  ASSERT_EQ(second.size(), first.size());  // in its place: the trial still comes after it
  EXPECT_EQ(std::ranges::find(first, old_key) - first.begin(),
            std::ranges::find(second, outboxKey(AnyRow(block))) - second.begin());
  store.acknowledged(std::span(&old_key, 1));
  EXPECT_EQ(waitingKeys(store), second);
}

TEST(RecordsStore, RefusesFilesThatAreNotItsOwn) {
  const support::TemporaryFolder folder;
  EXPECT_NE(support::thrownMessage([&] { Store(folder / "none", Store::Open::existing); }).find("no such file"),
            std::string::npos);
  writeFile(folder / "text", std::string(5000, 'x'));
  EXPECT_NE(
      support::thrownMessage([&] { Store(folder / "text", Store::Open::existing); }).find("holds no training records"),
      std::string::npos);
  trace::Database(folder / "other", trace::Database::Mode::create).run("CREATE TABLE t (a)");
  EXPECT_NE(support::thrownMessage([&] {
              Store(folder / "other", Store::Open::create_too);
            }).find("holds no training records"),
            std::string::npos);
  Store(folder / "newer", Store::Open::create_too).rows().sql().run("INSERT INTO schema_version VALUES (99, 0)");
  EXPECT_NE(
      support::thrownMessage([&] { Store(folder / "newer", Store::Open::existing); }).find("newer palpate (schema 99"),
      std::string::npos);
}

TEST(RecordsStore, AFileThatWasNeverFinishedBecomesOne) {
  const support::TemporaryFolder folder;
  writeFile(folder / "a.results", "");  // killed after making it, before there was a table
  Store store(folder / "a.results", Store::Open::existing);
  EXPECT_EQ(store.rows().trialCount(), 0);
}

TEST(RecordsStore, TwoProgramsKeepAtOnce) {
  const support::TemporaryFolder folder;
  Store one(folder / "a.results", Store::Open::create_too);
  Store two(folder / "a.results", Store::Open::create_too);
  const samples::History history = samples::history(2, 1, 10);
  for (std::size_t i = 0; i < history.rows.size(); ++i) {
    (i % 2 == 0 ? one : two).storeAnyRows(std::span(history.rows).subspan(i, 1));
  }
  EXPECT_EQ(samples::saidAll(one.rows().all()), samples::saidAll(two.rows().all()));
  EXPECT_EQ(one.rows().trialCount(), 20);
}

TEST(RecordsStore, WaitsForAnotherProgramAsLongAsItIsToldAndElseForFiveSeconds) {
  const support::TemporaryFolder folder;
  Store patient(folder / "a.results", Store::Open::create_too);
  Store hasty(folder / "a.results", Store::Open::existing, std::chrono::milliseconds(100));
  trace::Database other(folder / "a.results", trace::Database::Mode::write);
  other.run("BEGIN IMMEDIATE");
  const auto began = Clock::now();
  EXPECT_THROW(hasty.save(samples::station()), Error);
  EXPECT_LT(Clock::now() - began, std::chrono::milliseconds(900));
  std::thread ends([&] {
    std::this_thread::sleep_until(began + std::chrono::milliseconds(1500));
    other.run("COMMIT");
  });
  EXPECT_NO_THROW(patient.save(samples::station()));
  EXPECT_GE(Clock::now() - began, std::chrono::milliseconds(1500));
  ends.join();
}

TEST(RecordsStore, WhatAClassRefusedStaysAndIsTriedAgainWhenAsked) {
  WaitingRecords records;
  Store& store = records.store;
  const std::vector<std::string> keys = waitingKeys(store);
  store.refused(std::span(keys).first(2), "not yours");
  EXPECT_EQ(waitingKeys(store).size(), keys.size() - 2);
  EXPECT_EQ(store.waitingCount(), keys.size()) << "nothing is lost";
  EXPECT_EQ(store.refusedCount(), 2u);
  store.tryRefusedAgain();
  EXPECT_EQ(waitingKeys(store), keys);
}

TEST(RecordsStore, ADeletionThatWasHeardOfStandsBetweenWhatWasAndWhatComes) {
  WaitingRecords records;
  Store& store = records.store;
  const TraineeRow who = records.history.trainees[0];
  const std::vector<std::string> marks = {deletedMark(who.id)};
  store.applyDeletionNotice(marks);
  store.applyDeletionNotice(marks);
  store.save(who);
  std::vector<std::string> kinds;
  for (const OutboxEntry& entry : store.waiting(100)) kinds.push_back(entry.kind);
  ASSERT_GE(kinds.size(), 2u);
  EXPECT_EQ(kinds.back(), "trainee") << "signed in after it";
  EXPECT_EQ(kinds[kinds.size() - 2], "delete");
  EXPECT_EQ(std::ranges::count(kinds, "delete"), 1);
  EXPECT_EQ(std::ranges::count(kinds, "trainee"), 1);
}

}  // namespace
}  // namespace palpate::training

// What `save` returned from is there after kill -9 at any moment, with what waits for the class; and how long a commit
// takes while trials come as a class makes them. tools/check-records runs this for longer (PALPATE_KILLS,
// PALPATE_LOAD_S). A power cut is not tried here: that commits wait for the disk is (records_store_test.cpp).
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <set>
#include <thread>

#include "palpate/training/records/store.h"
#include "support/temporary_folder.h"
#include "teach/tests/training/records_pace.h"
#include "teach/tests/training/records_samples.h"

namespace palpate::training {
namespace {

/// One trial and its block's state, as a session hands them out.
std::array<Row, 2> keptTogether(const SessionRow& session, std::uint64_t number) {
  Random random(number);
  BlockRow block = samples::block(session, 1);
  block.trials = static_cast<int>(number);
  block.state_json = std::string(100 + number % 3000, 's');
  return {samples::trial(block, number, static_cast<int>(number), random), block};
}

/// Keeps trials until it is killed; says each number when it is kept.
[[noreturn]] void keepUntilKilled(const std::filesystem::path& file, std::uint64_t first, int acknowledge_to) {
  Store store(file, Store::Open::existing);
  const SessionRow session = samples::session(samples::trainee(), 1);
  for (std::uint64_t number = first;; ++number) {
    store.save(keptTogether(session, number));
    if (::write(acknowledge_to, &number, sizeof number) != sizeof number) ::_exit(1);
  }
}

/// The numbers that a child acknowledged before it died.
std::vector<std::uint64_t> killedAfter(const std::filesystem::path& file, std::uint64_t first,
                                       std::chrono::microseconds lives) {
  std::array<int, 2> ends{};
  EXPECT_EQ(::pipe(ends.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    keepUntilKilled(file, first, ends[1]);
  }
  ::close(ends[1]);
  std::this_thread::sleep_for(lives);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  std::vector<std::uint64_t> acknowledged;
  std::uint64_t number = 0;
  while (::read(ends[0], &number, sizeof number) == sizeof number) acknowledged.push_back(number);
  ::close(ends[0]);
  return acknowledged;
}

TEST(RecordsKilled, NoAcknowledgedTrialIsLost) {
  const support::TemporaryFolder folder;
  const auto file = folder / "a.results";
  const SessionRow session = samples::session(samples::trainee(), 1);
  {
    Store store(file, Store::Open::create_too);
    store.fillOutbox(true);
    store.storeAnyRows(std::vector<AnyRow>{samples::station(), samples::protocol(), samples::trainee(), session,
                                           samples::block(session, 1)});
  }
  Random random(20261122);
  std::set<std::uint64_t> acknowledged;
  std::uint64_t next = 1;
  const auto kills = static_cast<int>(pace::fromEnvironment("PALPATE_KILLS", 10));
  for (int kill = 0; kill < kills; ++kill) {
    const std::chrono::microseconds lives(random.below(120'000));
    for (const std::uint64_t number : killedAfter(file, next, lives)) acknowledged.insert(number);
    Store store(file, Store::Open::existing);
    ASSERT_EQ(std::get<std::string>(store.rows().sql().ask("PRAGMA integrity_check")[0][0]), "ok") << "kill " << kill;
    ASSERT_TRUE(store.rows().sql().ask("PRAGMA foreign_key_check").empty());
    // The last one may have been kept and not been acknowledged.
    const auto there = static_cast<std::uint64_t>(store.rows().trialCount());
    next = there + 1;
    ASSERT_LE(acknowledged.size(), there);
    ASSERT_LE(there, acknowledged.size() + static_cast<std::size_t>(kill) + 1);
  }
  Store store(file, Store::Open::existing);
  std::set<std::string> waiting;
  for (const OutboxEntry& entry : store.waiting(1'000'000)) waiting.insert(entry.row);
  for (const std::uint64_t number : acknowledged) {
    const auto trial = std::get<TrialRow>(keptTogether(session, number)[0]);
    const auto kept = store.rows().trial(trial.id);
    ASSERT_TRUE(kept) << "trial " << number << " was acknowledged and is gone";
    EXPECT_EQ(rowJson(*kept), rowJson(trial));
    EXPECT_TRUE(waiting.contains(trial.id));
  }
  EXPECT_GT(acknowledged.size(), static_cast<std::size_t>(kills));
  RecordProperty("kills", kills);
  RecordProperty("acknowledged", static_cast<int>(acknowledged.size()));
  if (kills > 10) std::printf("%d kills, %zu acknowledged trials, none lost\n", kills, acknowledged.size());
}

TEST(RecordsLoad, TwelveTrialsASecondAreKeptInTime) {
  const support::TemporaryFolder folder;
  Store store(folder / "a.results", Store::Open::create_too);
  store.fillOutbox(true);
  const SessionRow session = samples::session(samples::trainee(), 1);
  store.storeAnyRows(std::vector<AnyRow>{samples::station(), samples::protocol(), samples::trainee(), session,
                                         samples::block(session, 1)});
  const pace::Measured measured =
      pace::atTwelveASecond([&](std::uint64_t number) { store.save(keptTogether(session, number)); });
  EXPECT_EQ(static_cast<std::uint64_t>(store.rows().trialCount()), measured.trials);
  pace::judge("SQLite", measured);
}

}  // namespace
}  // namespace palpate::training

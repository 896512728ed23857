#include "lab/counters/lock_count.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <thread>

#include "lab/counters/thread_counts.h"

namespace palpate::lab {
namespace {

/// Locks that `work` asks for on this thread.
template <class Work>
std::uint64_t locksOf(Work work) {
  const std::uint64_t before = lab::locksOfThisThread().value();
  work();
  return lab::locksOfThisThread().value() - before;
}

class LockCount : public testing::Test {
  void SetUp() override {
    if (!lab::locksOfThisThread()) GTEST_SKIP() << "locks cannot be counted in this build";
  }
};

TEST_F(LockCount, SeesMutexesAndReadWriteLocks) {
  std::mutex mutex;
  std::shared_mutex shared;
  EXPECT_EQ(locksOf([&] { const std::lock_guard lock(mutex); }), 1u);
  EXPECT_EQ(locksOf([&] { const std::unique_lock lock(mutex, std::try_to_lock); }), 1u);
  EXPECT_EQ(locksOf([&] { const std::shared_lock lock(shared); }), 1u);
  EXPECT_EQ(locksOf([&] { const std::unique_lock lock(shared); }), 1u);
}

TEST_F(LockCount, SeesTheMutexOfACondition) {
  std::mutex mutex;
  std::condition_variable condition;
  EXPECT_GE(locksOf([&] {
              std::unique_lock lock(mutex);
              condition.wait_for(lock, std::chrono::microseconds(1));
            }),
            1u);
}

TEST_F(LockCount, IsPerThread) {
  std::mutex mutex;
  std::uint64_t inside = 0;
  const std::uint64_t here =
      locksOf([&] { std::thread([&] { inside = locksOf([&] { const std::lock_guard lock(mutex); }); }).join(); });
  EXPECT_EQ(inside, 1u);
  EXPECT_EQ(here, 0u);
}

TEST(ThreadCounts, SeeTheFirstTouchOfAPage) {
  if (!lab::countsOfThisThread().page_faults) GTEST_SKIP() << "page faults cannot be counted on this system";
  constexpr std::size_t kBytes = std::size_t{64} << 20;  // above malloc's threshold: pages of its own, none touched yet
  const lab::ThreadCounts before = lab::countsOfThisThread();
  const auto memory = std::unique_ptr<volatile char[]>(new char[kBytes]);
  for (std::size_t i = 0; i < kBytes; i += 4096) memory[i] = 1;
  EXPECT_GE(*lab::countsSince(before).page_faults, 1u);
}

}  // namespace
}  // namespace palpate::lab

#include "lab/counters/thread_counts.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <thread>

#include "palpate/base/aligned.h"
#include "palpate/base/system/process.h"

namespace palpate::lab {
namespace {

/// What `work` asks for on this thread.
template <class Work>
ThreadCounts measureCounts(Work work) {
  const ThreadCounts before = countsOfThisThread();
  work();
  return countsSince(before);
}

/// Of calls that must be counted in this build.
class ThreadCountsOfCalls : public testing::Test {
  void SetUp() override {
    if (!kCountsCalls) GTEST_SKIP() << "allocations and locks cannot be counted in this build";
  }

 protected:
  template <class Work>
  static std::uint64_t allocationsOf(Work work) {
    return measureCounts(work).allocations.value();
  }
  template <class Work>
  static std::uint64_t locksOf(Work work) {
    return measureCounts(work).locks.value();
  }
};

void* volatile kept;  // keeps the optimiser from removing a pair of new and delete

TEST_F(ThreadCountsOfCalls, SeeEveryWayToAllocate) {
  EXPECT_EQ(allocationsOf([] {
              auto* p = new int(1);
              kept = p;
              delete p;
            }),
            1u);
  EXPECT_EQ(allocationsOf([] {
              AlignedVector<float> v(100);
              kept = v.data();
            }),
            1u);
  EXPECT_EQ(allocationsOf([] {
              Eigen::VectorXd v(100);
              kept = v.data();
            }),
            1u);
  EXPECT_EQ(allocationsOf([] {
              kept = std::calloc(2, 50);
              kept = std::realloc(kept, 200);
              std::free(kept);
            }),
            2u);
}

TEST_F(ThreadCountsOfCalls, AreZeroWithoutAllocationsAndPerThread) {
  EXPECT_EQ(allocationsOf([] {
              const Eigen::Vector3d v(1, 2, 3);
              kept = const_cast<double*>(v.data());
            }),
            0u);
  std::uint64_t inside = 0;
  std::thread([&] { inside = allocationsOf([] { kept = std::make_unique<int>(1).get(); }); }).join();
  EXPECT_EQ(inside, 1u);
}

TEST_F(ThreadCountsOfCalls, SeeMutexesAndReadWriteLocks) {
  std::mutex mutex;
  std::shared_mutex shared;
  EXPECT_EQ(locksOf([&] { const std::lock_guard lock(mutex); }), 1u);
  EXPECT_EQ(locksOf([&] { const std::unique_lock lock(mutex, std::try_to_lock); }), 1u);
  EXPECT_EQ(locksOf([&] { const std::shared_lock lock(shared); }), 1u);
  EXPECT_EQ(locksOf([&] { const std::shared_lock lock(shared, std::try_to_lock); }), 1u);
  EXPECT_EQ(locksOf([&] { const std::unique_lock lock(shared); }), 1u);
  EXPECT_EQ(locksOf([&] { const std::unique_lock lock(shared, std::try_to_lock); }), 1u);
}

TEST_F(ThreadCountsOfCalls, SeeTheMutexOfACondition) {
  std::mutex mutex;
  std::condition_variable condition;
  EXPECT_GE(locksOf([&] {
              std::unique_lock lock(mutex);
              condition.wait_for(lock, std::chrono::microseconds(1));
            }),
            1u);
}

TEST_F(ThreadCountsOfCalls, OfLocksArePerThread) {
  std::mutex mutex;
  std::uint64_t inside = 0;
  const std::uint64_t here =
      locksOf([&] { std::thread([&] { inside = locksOf([&] { const std::lock_guard lock(mutex); }); }).join(); });
  EXPECT_EQ(inside, 1u);
  EXPECT_EQ(here, 0u);
}

TEST(ThreadCounts, SeeTheFirstTouchOfAPage) {
  if (!countsOfThisThread().page_faults) GTEST_SKIP() << "page faults cannot be counted on this system";
  constexpr std::size_t kBytes = std::size_t{64} << 20;  // above malloc's threshold: pages of its own, none touched yet
  const auto memory = std::unique_ptr<volatile char[]>(new char[kBytes]);
  const ThreadCounts counts = measureCounts([&] {
    for (std::size_t i = 0; i < kBytes; i += 4096) memory[i] = 1;
  });
  EXPECT_GE(*counts.page_faults, 1u);
}

// A list that is made and freed again and again, as those of a frame are: new pages each time slowed the ticks beside
// it.
TEST(LargeArrays, LeaveSmallerListsTheirPages) {
  if (!countsOfThisThread().page_faults) GTEST_SKIP() << "page faults cannot be counted on this system";
  system::returnLargeArrays();
  const auto make_and_free = [] {
    const std::vector<char> list(system::kLargeArrayBytes / 2, 'x');
    kept = const_cast<char*>(list.data());
  };
  make_and_free();
  const ThreadCounts counts = measureCounts([&] {
    for (int i = 0; i < 10; ++i) make_and_free();
  });
  EXPECT_LT(*counts.page_faults, 100u) << "512 each time without";
}

}  // namespace
}  // namespace palpate::lab

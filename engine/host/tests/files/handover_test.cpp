#include "palpate/base/handover.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

namespace palpate {
namespace {

/// Counts its living copies and remembers which thread destroyed the last one.
struct Thing {
  explicit Thing(int n) : number(n), check(2 * n) { ++alive; }
  ~Thing() {
    --alive;
    destroyed_by = std::this_thread::get_id();
  }
  Thing(const Thing&) = delete;
  Thing& operator=(const Thing&) = delete;
  int number;
  int check;
  static inline std::atomic<int> alive{0};
  static inline std::thread::id destroyed_by;
};

constexpr auto kKeepsNothing = [](Thing&, Thing&) {};

TEST(Handover, GivesTheNewestAndTakesBackTheOld) {
  {
    Handover<Thing> handover;
    auto current = std::make_unique<Thing>(1);
    EXPECT_FALSE(handover.receive(current, kKeepsNothing)) << "nothing was offered";
    handover.offer(std::make_unique<Thing>(2));
    handover.offer(std::make_unique<Thing>(3));
    ASSERT_TRUE(handover.receive(current, kKeepsNothing));
    EXPECT_EQ(current->number, 3);
    EXPECT_EQ(Thing::alive, 2) << "the old one waits to be collected";
    EXPECT_TRUE(handover.collect());
    EXPECT_FALSE(handover.collect());
    EXPECT_EQ(Thing::alive, 1);
  }
  EXPECT_EQ(Thing::alive, 0);
}

TEST(Handover, DoesNotTakeWhileTheLastOneIsNotCollected) {
  Handover<Thing> handover;
  auto current = std::make_unique<Thing>(1);
  handover.offer(std::make_unique<Thing>(2));
  ASSERT_TRUE(handover.receive(current, kKeepsNothing));
  handover.offer(std::make_unique<Thing>(3));  // collects the first
  ASSERT_TRUE(handover.receive(current, kKeepsNothing));
  EXPECT_EQ(current->number, 3);
  EXPECT_FALSE(handover.receive(current, kKeepsNothing));
}

TEST(Handover, LetsTheTakerMoveThingsOverBeforeTheOldOneIsPutDown) {
  Handover<Thing> handover;
  auto current = std::make_unique<Thing>(1);
  handover.offer(std::make_unique<Thing>(2));
  ASSERT_TRUE(handover.receive(current, [](Thing& before, Thing& next) { std::swap(before.check, next.check); }));
  EXPECT_EQ(current->number, 2);
  EXPECT_EQ(current->check, 2) << "of the first";
}

// Also the test that ThreadSanitizer watches.
TEST(Handover, BetweenTwoThreadsEverythingArrivesWholeAndIsDestroyedByItsMaker) {
  constexpr int kThings = 2000;
  Handover<Thing> handover;
  std::atomic<bool> done{false};
  auto current = std::make_unique<Thing>(0);
  std::thread loop([&] {
    int last = 0;
    while (!done.load() || last < kThings) {
      if (handover.receive(current, kKeepsNothing)) {
        ASSERT_GT(current->number, last);
        ASSERT_EQ(current->check, 2 * current->number);
        last = current->number;
      }
    }
  });
  for (int i = 1; i <= kThings; ++i) handover.offer(std::make_unique<Thing>(i));
  done = true;
  while (handover.collect() || Thing::alive > 1) std::this_thread::yield();
  loop.join();
  EXPECT_EQ(current->number, kThings);
  EXPECT_EQ(Thing::destroyed_by, std::this_thread::get_id());
}

}  // namespace
}  // namespace palpate

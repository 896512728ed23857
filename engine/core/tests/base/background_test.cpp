#include "palpate/base/background.h"

#include <gtest/gtest.h>
#ifdef __linux__
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "support/error_message.h"

namespace palpate {

TEST(Background, HasDoneItsWorkWhenJoined) {
  std::vector<int> squares(64);
  std::vector<Background> helpers;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    helpers.emplace_back([&squares, i] { squares[i] = static_cast<int>(i * i); });
  }
  for (Background& helper : helpers) helper.join();
  for (std::size_t i = 0; i < squares.size(); ++i) EXPECT_EQ(squares[i], static_cast<int>(i * i));
}

TEST(Background, ThrowsOnJoiningWhatItsWorkThrew) {
  Background helper([] { throw Error("the work failed"); });
  EXPECT_EQ(support::thrownMessage([&] { helper.join(); }), "the work failed");
}

TEST(Background, IsDoneWhenItGoesEvenIfNobodyJoinedIt) {
  bool done = false;
  {
    const Background helper([&] { done = true; });
  }
  EXPECT_TRUE(done);
  EXPECT_NO_THROW({ const Background failing([] { throw Error("lost"); }); });
}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// In a process that has no room left for the stack of another thread. Stacks of ended ones are kept, too small for it.
int codeWithoutAThread() {
  pthread_attr_t large;
  ::pthread_attr_init(&large);
  ::pthread_attr_setstacksize(&large, std::size_t{1} << 30);
  ::pthread_setattr_default_np(&large);
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const auto room = static_cast<rlim_t>(pages * ::sysconf(_SC_PAGESIZE)) + (rlim_t{1} << 20);
  const rlimit limit{room, room};
  if (::setrlimit(RLIMIT_AS, &limit) != 0) return 3;
  try {
    std::thread([] {}).join();
    return 4;
  } catch (const std::system_error&) {  // as it should be
  }
  int times = 0;
  Background helper([&times] { ++times; });
  helper.join();
  std::vector<int> shared(8);
  shareOut(shared.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++shared[i];
  });
  return times == 1 && shared == std::vector<int>(8, 1) ? 0 : 1;
}

TEST(Background, DoesItsWorkItselfWhereTheSystemRefusesAThread) {
  EXPECT_EXIT(std::_Exit(codeWithoutAThread()), testing::ExitedWithCode(0), "");
}
#endif

TEST(ShareOut, GivesEachItemToOneThread) {
  for (const std::size_t count : {0u, 1u, 7u, 1000u}) {
    std::vector<int> times(count, 0);
    shareOut(count, 3, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++times[i];
    });
    EXPECT_EQ(std::count(times.begin(), times.end(), 1), static_cast<std::ptrdiff_t>(count));
  }
}

TEST(ShareOut, ThrowsWhatAPartThrew) {
  const auto fail_at_the_end = [](std::size_t, std::size_t end) {
    if (end == 100) throw Error("the last part failed");
  };
  EXPECT_EQ(support::thrownMessage([&] { shareOut(100, 1, fail_at_the_end); }), "the last part failed");
}

}  // namespace palpate

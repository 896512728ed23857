#include "palpate/base/background.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
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
  EXPECT_EQ(support::messageOf([&] { helper.join(); }), "the work failed");
}

TEST(Background, IsDoneWhenItGoesEvenIfNobodyJoinedIt) {
  bool done = false;
  {
    const Background helper([&] { done = true; });
  }
  EXPECT_TRUE(done);
  EXPECT_NO_THROW({ const Background failing([] { throw Error("lost"); }); });
}

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
  EXPECT_EQ(support::messageOf([&] { shareOut(100, 1, fail_at_the_end); }), "the last part failed");
}

}  // namespace palpate

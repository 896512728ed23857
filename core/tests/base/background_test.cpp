#include "palpate/base/background.h"

#include <gtest/gtest.h>

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

}  // namespace palpate

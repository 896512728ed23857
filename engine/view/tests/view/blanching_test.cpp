#include "palpate/view/layers/skin_paint.h"

#include <gtest/gtest.h>

namespace palpate::view {
namespace {

Press pressAt(double x, double depth_mm = 5.0) { return {{x, 0.0, 0.0}, 8.0, depth_mm}; }

TEST(Blanching, IsStrongestUnderTheFingerAndGrowsWithDepth) {
  Blanching blanching;
  const Press light = pressAt(0.0, 1.0);
  const float weak = blanching.at(0.0, {&light, 1}).front().strength;
  const Press deep = pressAt(0.0, 5.0);
  EXPECT_GT(blanching.at(0.1, {&deep, 1}).front().strength, weak);
}

TEST(Blanching, RefillsWithinASecondAndAHalf) {
  Blanching blanching;
  const Press press = pressAt(0.0);
  blanching.at(0.0, {&press, 1});
  float last = 1.1f;
  for (const double time : {0.1, 0.5, 1.0, 1.4}) {
    const auto marks = blanching.at(time, {});
    ASSERT_EQ(marks.size(), 1u);
    EXPECT_LT(marks.front().strength, last);
    last = marks.front().strength;
  }
  EXPECT_TRUE(blanching.at(kRefillS, {}).empty());
}

TEST(Blanching, LeavesATraceBehindASlidingFinger) {
  Blanching blanching;
  for (int i = 0; i <= 20; ++i) {
    const Press press = pressAt(i);
    blanching.at(0.01 * i, {&press, 1});
  }
  const auto marks = blanching.at(0.3, {});
  EXPECT_GT(marks.size(), 3u);
  EXPECT_LE(marks.size(), kMaxMarks);
}

TEST(Blanching, DoesNotChangeWhenAskedAgain) {
  Blanching blanching;
  const Press press = pressAt(3.0);
  blanching.at(0.0, {&press, 1});
  const auto once = std::vector<PressMark>(blanching.at(0.2, {}).begin(), blanching.at(0.2, {}).end());
  const auto again = blanching.at(0.2, {});
  ASSERT_EQ(again.size(), once.size());
  EXPECT_EQ(again.front().strength, once.front().strength);
}

TEST(Blanching, ForgetsWhenTimeRunsBack) {
  Blanching blanching;
  const Press press = pressAt(0.0);
  blanching.at(5.0, {&press, 1});
  EXPECT_TRUE(blanching.at(4.9, {}).empty());
}

}  // namespace
}  // namespace palpate::view

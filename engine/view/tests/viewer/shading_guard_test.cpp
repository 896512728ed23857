#include "view/viewer/shading_guard.h"

#include <gtest/gtest.h>

namespace palpate::viewer {
namespace {

using Change = ShadingGuard::Change;

/// Frames of one kind for some seconds; the first change that came of it.
Change after(ShadingGuard& guard, double seconds, double between_s, double cost_s) {
  for (double t = 0.0; t < seconds; t += between_s) {
    if (const Change change = guard.frame(between_s, cost_s, true); change != Change::none) return change;
  }
  return Change::none;
}

TEST(ShadingGuard, DrawsSimplerAfterASecondAndAHalfOfSlowPictures) {
  ShadingGuard guard;
  EXPECT_EQ(after(guard, 1.3, 0.06, 0.055), Change::none);
  EXPECT_EQ(after(guard, 0.5, 0.06, 0.055), Change::simpler);
  EXPECT_TRUE(guard.simple());
}

TEST(ShadingGuard, ForgivesHitchesStopsAndLoading) {
  ShadingGuard guard;
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(guard.frame(i % 10 == 0 ? 0.08 : 1.0 / 60.0, 0.01, true), Change::none) << "one slow frame in ten";
  }
  for (int i = 0; i < 20; ++i) EXPECT_EQ(guard.frame(2.0, 0.01, true), Change::none) << "the program was stopped";
  for (int i = 0; i < 200; ++i) EXPECT_EQ(guard.frame(0.1, 0.1, false), Change::none) << "a body is being loaded";
}

TEST(ShadingGuard, GoesBackOnlyWhenThereIsTimeToSpareForLong) {
  ShadingGuard guard;
  ASSERT_EQ(after(guard, 3.0, 0.06, 0.055), Change::simpler);
  EXPECT_EQ(after(guard, 60.0, 1.0 / 40.0, 0.022), Change::none) << "in time, but with nothing to spare";
  EXPECT_EQ(after(guard, 7.5, 1.0 / 60.0, 0.005), Change::none);
  EXPECT_EQ(after(guard, 1.0, 1.0 / 60.0, 0.005), Change::as_requested);
}

TEST(ShadingGuard, DoesNotSwayBackAndForth) {
  ShadingGuard guard;
  // Simple pictures are quick and the others slow, for ever.
  int changes = 0;
  for (double t = 0.0; t < 600.0;) {
    const double between = guard.simple() ? 1.0 / 60.0 : 0.06;
    changes += guard.frame(between, guard.simple() ? 0.005 : 0.055, true) != Change::none ? 1 : 0;
    t += between;
  }
  EXPECT_LE(changes, 13) << "in ten minutes";
}

TEST(ShadingGuard, ForgetsEverythingWhenTheUserChooses) {
  ShadingGuard guard;
  ASSERT_EQ(after(guard, 3.0, 0.06, 0.055), Change::simpler);
  guard.reset();
  EXPECT_FALSE(guard.simple());
}

}  // namespace
}  // namespace palpate::viewer

#include "view/viewer/state/sample_history.h"

#include <gtest/gtest.h>

#include <array>

#include "palpate/servo/limiter.h"

namespace palpate::viewer {
namespace {

trace::Sample sampleAt(std::uint64_t tick, double force_n, double depth_mm = 1.0) {
  trace::Sample sample;
  sample.tick = tick;
  const Vec3 tip(0.1 * static_cast<double>(tick), 0, 0);
  sample.contact = {tip, tip, tip, tip, Vec3::UnitZ(), Vec3(0.5, 0, force_n)};
  sample.contact.depth_mm = depth_mm;
  return sample;
}

TEST(SampleHistory, NoSpikeIsLostHoweverNarrowThePlot) {
  SampleHistory history;
  for (std::uint64_t tick = 0; tick < 10000; ++tick) history.add(sampleAt(tick, tick == 4321 ? 9.0 : 1.0));
  const auto columns = history.columns(PlotValue::normal_force, history.newestTime(), 10.0, 50);
  float highest = 0.0f;
  for (const Extent& column : columns) {
    EXPECT_TRUE(column.any);
    EXPECT_EQ(column.low, 1.0f);
    highest = std::max(highest, column.high);
  }
  EXPECT_EQ(highest, 9.0f);
}

TEST(SampleHistory, MarksTouchSlipAndForcesThatADeviceWouldNotGet) {
  SampleHistory history;
  for (std::uint64_t tick = 0; tick < 1000; ++tick) {
    trace::Sample sample = sampleAt(tick, tick >= 310 && tick < 390 ? 9.0 : 1.0);
    if (tick >= 210 && tick < 690) sample.contact.touch = contact::Touch::stick;
    if (tick >= 510 && tick < 590) sample.contact.touch = contact::Touch::slip;
    if (tick == 650) sample.safety = servo::kForceJumped;
    if (tick == 250) sample.safety = servo::kHeldBack;  // no news
    history.add(sample, 5.0);
  }
  const auto marks = history.marks(1.0, 1.0, 10);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(marks[i].touching, i >= 2 && i < 7) << i;
    EXPECT_EQ(marks[i].slipping, i == 5) << i;
    EXPECT_EQ(marks[i].limited, i == 3 || i == 6) << i;
  }
}

TEST(SampleHistory, ForgetsWhatIsOlderThanItsLength) {
  SampleHistory history(1000.0, 2.0);
  for (std::uint64_t tick = 0; tick < 5000; ++tick) history.add(sampleAt(tick, 1.0));
  EXPECT_EQ(history.size(), 2000u);
  EXPECT_DOUBLE_EQ(history.at(0).time_s, 3.0);
  EXPECT_DOUBLE_EQ(history.newestTime(), 4.999);
  EXPECT_FALSE(history.columns(PlotValue::depth, 4.999, 4.0, 10).front().any);
}

TEST(SampleHistory, SplitsTheForceAndMeasuresTheSpeed) {
  SampleHistory history;
  for (std::uint64_t tick = 0; tick < 500; ++tick) history.add(sampleAt(tick, 2.0));
  const PlotSample& newest = history.at(history.size() - 1);
  EXPECT_FLOAT_EQ(newest.normal_n, 2.0f);
  EXPECT_FLOAT_EQ(newest.tangential_n, 0.5f);
  EXPECT_FLOAT_EQ(newest.force_n, std::hypot(2.0f, 0.5f)) << "the whole, as beside the finger";
  EXPECT_NEAR(newest.speed_mm_per_s, 100.0f, 0.5f);
}

TEST(SampleHistory, FindsTheSampleUnderTheCursor) {
  SampleHistory history;
  EXPECT_EQ(history.near(1.0), nullptr);
  for (std::uint64_t tick = 0; tick < 100; ++tick) history.add(sampleAt(tick, static_cast<double>(tick)));
  EXPECT_FLOAT_EQ(history.near(0.0502)->normal_n, 50.0f);
  EXPECT_FLOAT_EQ(history.near(-5.0)->normal_n, 0.0f);
  EXPECT_FLOAT_EQ(history.near(5.0)->normal_n, 99.0f);
}

TEST(Plots, PausedOnesGiveThePausedMomentAndSayHowLongAgoItWas) {
  Plots plots{{SampleHistory(1000.0, 2.0), SampleHistory(1000.0, 2.0)}};
  const auto feel = [&](std::uint64_t from, std::uint64_t to, double newtons) {
    for (std::uint64_t tick = from; tick < to; ++tick) plots.fingers[0].add(sampleAt(tick, newtons));
  };
  feel(0, 500, 2.0);
  EXPECT_DOUBLE_EQ(plots.pausedFor(), 0.0);
  plots.end_s = plots.shownEnd();
  plots.paused = true;
  feel(500, 1500, 0.0);
  EXPECT_FLOAT_EQ(plots.felt(0, plots.shownEnd())->normal_n, 2.0f);
  EXPECT_NEAR(plots.pausedFor(), 1.0, 1e-9);
  feel(1500, 3000, 0.0);
  EXPECT_EQ(plots.felt(0, plots.shownEnd()), nullptr) << "its history has forgotten that moment";
  EXPECT_EQ(plots.felt(1, plots.shownEnd()), nullptr) << "this one has never felt anything";
}

TEST(PlotAxis, EndsAtOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(axisEnd(0.3, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(axisEnd(1.2, 1.0), 2.0);
  EXPECT_DOUBLE_EQ(axisEnd(3.0, 1.0), 5.0);
  EXPECT_DOUBLE_EQ(axisEnd(7.0, 5.0), 10.0);
  EXPECT_DOUBLE_EQ(axisEnd(60.0, 50.0), 100.0);
}

TEST(PlotCsv, HoldsTheWindowOfEveryFinger) {
  std::array<SampleHistory, 2> fingers;
  for (std::uint64_t tick = 0; tick < 3000; ++tick) {
    fingers[0].add(sampleAt(tick, 1.0));
    fingers[1].add(sampleAt(tick, 2.0));
  }
  const std::string text = historyAsCsv(fingers, fingers[0].newestTime(), 1.0);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1001);
  EXPECT_TRUE(text.starts_with("t_s,normal_1_n,tangential_1_n,depth_1_mm,speed_1_mm_per_s,force_1_n,normal_2_n"));
  EXPECT_NE(text.find("\n2.999,1.0000,0.5000,1.0000,"), std::string::npos);
}

}  // namespace
}  // namespace palpate::viewer

#include "palpate/device/trajectory.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/error_message.h"
#include "support/expect_each.h"

namespace palpate::device {
namespace {

std::string thrownMessage(std::string_view text) {
  return support::thrownMessage([&] { parseTrajectory(text, "path.csv"); });
}

TEST(Trajectory, ReadsRowsWithAndWithoutHeader) {
  for (const char* text : {"t_s,x_mm,y_mm,z_mm\n0,1,2,3\n0.5,4,5,6\n", "0,1,2,3\r\n\r\n0.5, 4, 5, 6"}) {
    const Trajectory read = parseTrajectory(text, "path.csv");
    EXPECT_EQ(read.time_s, (std::vector<double>{0.0, 0.5}));
    EXPECT_EQ(read.tip_mm, (std::vector<Vec3>{Vec3(1, 2, 3), Vec3(4, 5, 6)}));
  }
}

TEST(Trajectory, NamesTheLineAndTheCause) {
  support::expectEach(
      thrownMessage,
      {{"0,1,2,3\n1,1,2\n", "path.csv:2: expected 4 fields (t_s,x_mm,y_mm,z_mm), found 3"},
       {"0,1,2,3,4\n", "path.csv:1: expected 4 fields (t_s,x_mm,y_mm,z_mm), found 5"},
       {"0,1,2,3\n1,1,two,3\n", "path.csv:2: y_mm is not a number: 'two'"},
       {"0,1,2,3\n1,,2,3\n", "path.csv:2: x_mm is not a number: ''"},
       {"0,1,2,nan\n", "path.csv:1: z_mm must be finite, got nan"},
       {"0,1,2,inf\n", "path.csv:1: z_mm must be finite, got inf"},
       {"0,1,2,3\n\n0,1,2,3\n", "path.csv:3: t_s must increase, but 0 s follows 0 s"},
       {"t_ms,x,y,z\n0,1,2,3\n", "path.csv:1: expected the header t_s,x_mm,y_mm,z_mm or numbers, found 't_ms,x,y,z'"},
       {"0,1,2,2e11\n", "path.csv:1: z_mm = 200000000000 is out of range: -100,000,000,000 to 100,000,000,000"},
       {"5,1,2,3\n60005,1,2,3\n",
        "path.csv:2: t_s = 60005 is 60000 s after the first row; a trajectory lasts at most 50,000 s"}});
  EXPECT_EQ(thrownMessage(std::string_view("0,1,2,3\n\0\1\2,,,\n", 15)),
            "path.csv:2: not a text table (byte 0x00); expected comma-separated text");
  EXPECT_EQ(thrownMessage("t_s,x_mm,y_mm,z_mm\n"), "path.csv: the trajectory has no rows");
  EXPECT_EQ(thrownMessage(""), "path.csv: the trajectory has no rows");
}

TEST(Trajectory, WrittenTextReadsBack) {
  const Trajectory path{{0.0, 0.001}, {Vec3(1.25, -2, 3e-6), Vec3(100, 0, -0.5)}};
  const std::string text = formatTrajectory(path);
  EXPECT_EQ(text, "t_s,x_mm,y_mm,z_mm\n0.000,1.250000,-2.000000,0.000003\n0.001,100.000000,0.000000,-0.500000\n");
  EXPECT_EQ(parseTrajectory(text, "path.csv").tip_mm, path.tip_mm);
}

TEST(Trajectory, SkipsCommentsAndAByteOrderMark) {
  const Trajectory read =
      parseTrajectory("\xef\xbb\xbf# a slide\r\nt_s,x_mm,y_mm,z_mm\r\n0,1,2,3 # begin\r\n", "path.csv");
  EXPECT_EQ(read.tip_mm, (std::vector<Vec3>{Vec3(1, 2, 3)}));
}

TEST(Trajectory, WritesTimesOfAFastDeviceWithAllTheirDigits) {
  const Trajectory fast{{0.0, 0.00025, 0.0005}, {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}};
  EXPECT_EQ(parseTrajectory(formatTrajectory(fast), "path.csv").time_s, fast.time_s);
}

TEST(Trajectory, NamesAFileThatCannotBeReadOrWritten) {
  EXPECT_THROW(readTrajectory("no/such.csv"), Error);
  EXPECT_THROW(writeTrajectory("/dev/null/at/all.csv", {{0.0}, {Vec3::Zero()}}), Error);
}

TEST(Trajectory, ResamplingKeepsRowsThatFallOnTicks) {
  Trajectory path;
  for (int k = 0; k < 500; ++k) {
    path.time_s.push_back(k * 1e-3);
    path.tip_mm.emplace_back(0.1 * k, 1.0 / (k + 1), k * k);
  }
  EXPECT_EQ(resampled(parseTrajectory(formatTrajectory(path), "path.csv"), 0.001).size(), path.size());
  EXPECT_EQ(resampled(path, 0.001).tip_mm, path.tip_mm);
}

TEST(Trajectory, TimesSince1970AndMapCoordinatesAreResampledAsTheSamePathNearZeroIs) {
  constexpr double kThen = 1305031102.1758;
  const Vec3 there(4e8, 4.08e9, 75);
  std::string near, far;
  for (int k = 0; k <= 1500; ++k) {
    near += fmt::format("{:.3f},{},10,{}\n", 1e-3 * k, 20 + 0.004 * k, 75 - 0.02 * k);
    far += fmt::format("{:.4f},{:.3f},{},{}\n", kThen + 1e-3 * k, there.x() + 20 + 0.004 * k, there.y() + 10,
                       75 - 0.02 * k);
  }
  const Trajectory expected = resampled(parseTrajectory(near, "path.csv"), 1e-3);
  const Trajectory found = resampled(parseTrajectory(far, "path.csv"), 1e-3);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Vec3 moved = found.tip_mm[k] - Vec3(there.x(), there.y(), 0);
    ASSERT_LT((moved - expected.tip_mm[k]).norm(), 2e-6) << k;
  }
}

TEST(Trajectory, ResamplingIsLinearBetweenRows) {
  const Trajectory path{{1.0, 1.004, 1.005}, {Vec3(0, 0, 0), Vec3(4, 8, 0), Vec3(4, 8, 10)}};
  const Trajectory ticks = resampled(path, 0.001);
  ASSERT_EQ(ticks.size(), 6u);
  EXPECT_NEAR((ticks.tip_mm[1] - Vec3(1, 2, 0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((ticks.tip_mm[3] - Vec3(3, 6, 0)).norm(), 0.0, 1e-9);
  EXPECT_EQ(ticks.tip_mm.back(), Vec3(4, 8, 10));
}

TEST(Trajectory, ResamplingRefusesWhatHasNoEnd) {
  const Trajectory years{{0.0, 1e12}, {Vec3::Zero(), Vec3::Zero()}};
  EXPECT_THROW(resampled(years, 0.001), Error);
  EXPECT_THROW(resampled(years, 0.0), Error);
  EXPECT_THROW(resampled({}, 0.001), Error);
}

}  // namespace
}  // namespace palpate::device

#include "palpate/trace/forces_table.h"

#include <gtest/gtest.h>

#include "palpate/trace/forces_csv.h"
#include "support/error_message.h"

namespace palpate::trace {
namespace {

std::string tableOf(std::initializer_list<Sample> samples) {
  ForcesCsvSettings settings;
  settings.finger_names = {"left", "right"};
  std::string text = std::string(forcesCsvHeader()) + "\n";
  for (const Sample& sample : samples) appendForcesRow(text, settings, sample);
  return text;
}

Sample makeSample(std::uint64_t tick, std::uint32_t finger, const Vec3& tip, const Vec3& force) {
  Sample sample;
  sample.tick = tick;
  sample.finger = finger;
  sample.contact = {tip, tip, tip, tip, Vec3::UnitZ(), force};
  return sample;
}

TEST(ForcesTable, ReadsBackEveryBitOfWhatWasWritten) {
  const Vec3 tip(0.1, -1.0 / 3.0, 1e5);
  const Vec3 force(1e-17, 2.5, -0.7);
  const auto fingers = parseForcesTable(
      tableOf({makeSample(0, 0, tip, force), makeSample(0, 1, -tip, force), makeSample(1, 0, 2.0 * tip, -force)}), "t");
  ASSERT_EQ(fingers.size(), 2u);
  EXPECT_EQ(fingers[0].name, "left");
  EXPECT_EQ(fingers[0].time_s, (std::vector<double>{0.0, 0.001}));
  EXPECT_EQ(fingers[0].tip, (std::vector<Vec3>{tip, 2.0 * tip}));
  EXPECT_EQ(fingers[0].force, (std::vector<Vec3>{force, -force}));
  EXPECT_EQ(fingers[1].tip, (std::vector<Vec3>{-tip}));
}

TEST(ForcesTable, RefusesWhatIsNone) {
  const auto message = [](const std::string& text) {
    return support::thrownMessage([&] { parseForcesTable(text, "t.csv"); });
  };
  EXPECT_EQ(message("t_s,x_mm\n0,1\n"), "t.csv:1: must be a table of forces: column 2 is 'x_mm'; expected finger");
  EXPECT_EQ(message("x_mm,y_mm\n0,1\n"), "t.csv:1: must be a table of forces; its columns differ");
  EXPECT_EQ(message(tableOf({})), "t.csv: has no rows");
  EXPECT_EQ(message(tableOf({}) + "0,left,1\n"), "t.csv:2: expected 22 fields, found 3");
  EXPECT_EQ(message(tableOf({}) + "0,left,1"), "t.csv:2: the table ends in this row, after 3 of 22 fields");
  const Sample sample = makeSample(0, 0, Vec3::Zero(), Vec3::Zero());
  EXPECT_EQ(message(tableOf({sample, sample})), "t.csv:3: t_s must increase, but 0 s follows 0 s");
}

}  // namespace
}  // namespace palpate::trace

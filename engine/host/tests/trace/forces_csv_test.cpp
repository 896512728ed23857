#include "palpate/trace/forces_csv.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/base/text.h"
#include "support/temporary_folder.h"

namespace palpate::trace {
namespace {

Sample sampleWith(double third) {
  Sample sample;
  sample.tick = 9;
  sample.finger = 1;
  sample.contact.tip = sample.contact.proxy = sample.contact.anchor = Vec3(1.0, -2.5, third);
  sample.contact.force = Vec3(0, 0, 0.1);
  sample.contact.depth_mm = third;
  sample.contact.touch = contact::Touch::slip;
  sample.contact.triangle = 42;
  sample.device_force = Vec3(0, 0, 0.05);
  sample.safety = 8;
  return sample;
}

const ForcesCsvSettings kTwoFingers{{"thumb", "index"}, 0.0, 1000.0};

TEST(ForcesCsv, WritesOneReadableRowAFinger) {
  std::string text;
  appendForcesRow(text, kTwoFingers, sampleWith(0.2));
  EXPECT_EQ(text, "0.009,index,1,-2.5,0.2,1,-2.5,0.2,1,-2.5,0.2,0,0,0.1,0.2,slip,42,0,0,0.05,0,8\n");
}

TEST(ForcesCsv, SaysMinusOneForTheTriangleOfAFreeFinger) {
  Sample sample = sampleWith(0.0);
  sample.contact.touch = contact::Touch::free;
  sample.contact.triangle = kNoIndex;
  std::string text;
  appendForcesRow(text, kTwoFingers, sample);
  EXPECT_NE(text.find(",free,-1,"), std::string::npos);
}

TEST(ForcesCsv, HasAsManyColumnsInItsHeaderAsInItsRows) {
  std::string text;
  appendForcesRow(text, kTwoFingers, sampleWith(1.0));
  EXPECT_EQ(split(forcesCsvHeader(), ',').size(), split(text, ',').size());
}

TEST(ForcesCsv, NumbersReadBackToTheSameBits) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const double depth = random.normal() * std::exp(random.uniform(-40.0, 40.0));
    std::string text;
    appendForcesRow(text, kTwoFingers, sampleWith(depth));
    EXPECT_EQ(*parseNumber(split(text, ',')[14]), depth);
  }
}

TEST(ForcesCsv, ColumnsOfWhoWritesItStandBehindItsOwn) {
  const support::TemporaryFolder folder;
  ForcesCsvWriter writer(
      folder / "forces.csv", kTwoFingers, OutputFile::Unfinished::remove,
      {",twice", [](const Sample& sample, std::string& row) { row += "," + std::to_string(2 * sample.tick); }});
  writer.add(sampleWith(0.2));
  writer.commit();
  std::string own;
  appendForcesRow(own, kTwoFingers, sampleWith(0.2));
  own.pop_back();
  EXPECT_EQ(readFile(folder / "forces.csv", 1 << 20), std::string(forcesCsvHeader()) + ",twice\n" + own + ",18\n");
}

TEST(ForcesCsv, AppearsOnlyWhenItIsComplete) {
  const support::TemporaryFolder folder;
  const auto file = folder / "forces.csv";
  {
    ForcesCsvWriter writer(file, kTwoFingers);
    writer.add(sampleWith(1.0));
  }
  EXPECT_FALSE(std::filesystem::exists(file));
  {
    ForcesCsvWriter writer(file, kTwoFingers);
    for (int i = 0; i < 5000; ++i) writer.add(sampleWith(i));
    writer.commit();
  }
  std::size_t rows = 0;
  forEachCsvRow(readFile(file, 1u << 30), "forces.csv", [&](const CsvRow&) { ++rows; });
  EXPECT_EQ(rows, 5001u);
  EXPECT_THROW(ForcesCsvWriter("/dev/null/at/all.csv", kTwoFingers), Error);
}

}  // namespace
}  // namespace palpate::trace

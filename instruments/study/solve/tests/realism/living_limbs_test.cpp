// The table of presses on living limbs, read from strangers; and its figures, from made-up tests.
#include "solve/realism/living_limbs.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::lab {
namespace {

constexpr const char* kHeader = ",SubID,Location,Thickness,Skin,Fat,Total_Stiff,R_squared\n";

std::filesystem::path written(const support::TemporaryFolder& folder, const std::string& text) {
  std::ofstream(folder / kLivingList, std::ios::binary) << text;
  return folder / kLivingList;
}

TEST(LivingTests, AreReadFromTheListOrItsFolder) {
  const support::TemporaryFolder folder;
  const auto file = written(folder, std::string(kHeader) +
                                        "0,006,LA_A,20.5,1.5,4,0.002,0.9\n"
                                        "1,007,UL_P,55,2,9.5,0.001,0.95\n"
                                        "2,008,UL_P,,2,9.5,,\n");
  const LivingTests list = readLivingTests(file);
  EXPECT_EQ(list.left_out, 1) << "without a thickness";
  ASSERT_EQ(list.tests.size(), 2u);
  EXPECT_EQ(list.tests[0].person, 6);
  EXPECT_EQ(list.tests[0].site, "LA_A");
  EXPECT_DOUBLE_EQ(list.tests[0].cover_mm, 20.5);
  EXPECT_DOUBLE_EQ(list.tests[0].skin_mm, 1.5);
  EXPECT_DOUBLE_EQ(list.tests[1].fat_mm, 9.5);
  EXPECT_DOUBLE_EQ(list.tests[0].n_per_mm, 0.72) << "0.002 MPa/mm on 360 mm^2";
  EXPECT_EQ(readLivingTests(folder.path()).tests.size(), 2u);
}

TEST(LivingTests, OfAnotherTableAreRefusedWithFileAndLine) {
  const support::TemporaryFolder folder;
  const auto complaint = [&](const std::string& text) {
    const auto file = written(folder, text);
    return support::thrownMessage([&] { readLivingTests(file); });
  };
  const auto row = [&](const std::string& fields) { return complaint(std::string(kHeader) + fields + "\n"); };
  const std::string where = std::string(kLivingList) + ":2: ";
  EXPECT_NE(complaint("a,b\n1,2\n").find(":1: the header has no column SubID"), std::string::npos);
  EXPECT_NE(row("0,6,LA_A,20,1,4,0.002").find(where + "found 7 fields; expected 8"), std::string::npos);
  EXPECT_NE(row("0,6,HAND,20,1,4,0.002,1").find(where + "Location is 'HAND'; expected one of LA_A"), std::string::npos);
  EXPECT_NE(row("0,6.5,LA_A,20,1,4,0.002,1").find(where + "SubID must be a whole number"), std::string::npos);
  EXPECT_NE(row("0,6,LA_A,20,1,19.5,0.002,1").find(where + "Skin and Fat (20.5 mm) must be thinner"),
            std::string::npos);
  for (const char* fields : {"0,6,LA_A,1e300,1,4,0.002,1", "0,6,LA_A,20,nan,4,0.002,1", "0,6,LA_A,20,1,-4,0.002,1",
                             "0,6,LA_A,20,1,4,0,1", "0,6,LA_A,20,1,4,much,1", "0,-6,LA_A,20,1,4,0.002,1"}) {
    EXPECT_NE(row(fields).find(where), std::string::npos) << fields;
  }
  EXPECT_NE(complaint(std::string(kHeader) + std::string("0,6,\0,20", 8)).find(kLivingList), std::string::npos);
  EXPECT_NE(complaint(kHeader).find("has no rows with Thickness and Total_Stiff"), std::string::npos);
  EXPECT_NE(complaint(std::string((16u << 20u) + 1, ' ')).find(kLivingList), std::string::npos) << "too large";
}

TEST(LivingFigures, AreMediansOverTestsAndCovers) {
  std::vector<LivingTest> tests;
  for (const double cover : {10.0, 12.0, 14.0, 20.0, 50.0}) {
    tests.push_back({.person = 1, .site = "LA_A", .cover_mm = cover, .skin_mm = 1, .fat_mm = 3, .n_per_mm = 2.0});
  }
  const LivingFigures figures = livingFigures(tests, std::vector<double>{3.0, 2.4, 2.0, 1.0, 4.0});
  EXPECT_EQ(figures.tests, 5u);
  EXPECT_DOUBLE_EQ(figures.median_error, 0.5) << "of 0.5, 0.2, 0, 0.5, 1";
  EXPECT_DOUBLE_EQ(figures.bias, 0.2);
  EXPECT_DOUBLE_EQ(figures.thinCoverRatio(), 1.2);
  EXPECT_EQ(figures.covers[0].tests, 3u);
  EXPECT_DOUBLE_EQ(figures.covers[1].ratio, 0.5);
  EXPECT_EQ(figures.covers[2].tests, 0u);
  EXPECT_DOUBLE_EQ(figures.covers[3].ratio, 2.0);
  EXPECT_NEAR(figures.spread_error, 0.25, 1e-12) << "of 3, 2.4, 2, 1, 4 over 2.4";
  EXPECT_EQ(livingFigures({}, {}).tests, 0u);
}

/// On solved stacks, so that few of them are solved.
LivingTest onTheLadder(double cover_mm, double skin_mm) {
  return {.person = 2,
          .site = "LA_A",
          .cover_mm = cover_mm,
          .skin_mm = skin_mm,
          .fat_mm = 0.15 * (cover_mm - skin_mm),
          .n_per_mm = 1.0};
}

TEST(LivingLimbs, ARoundBoneAndThinSkinMakeThinCoverSofter) {
  const std::vector<LivingTest> tests = {onTheLadder(12.0, 2.0), onTheLadder(60.0, 2.0), onTheLadder(12.0, 1.0)};
  const auto body = probeStiffnesses(tests, LimbModel::body);
  const auto limb = probeStiffnesses(tests, LimbModel::limb);
  const auto relaxed = probeStiffnesses(tests, LimbModel::relaxed_limb);
  EXPECT_LT(limb[0] / body[0], 0.8);
  EXPECT_GT(limb[1] / body[1], limb[0] / body[0]) << "far above the bone its shape matters less";
  EXPECT_LT(limb[2], 0.95 * limb[0]) << "its own skin";
  EXPECT_NEAR(body[2] / body[0], 1.0, 0.03) << "skin of 2 mm on both; the fat is 0.15 mm more";
  const double muscle = siteNamed("LA_A")->muscle_kpa / 27.0;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    EXPECT_LE(relaxed[i] / limb[i], 1.0) << i;
    EXPECT_GE(relaxed[i] / limb[i], muscle) << i;
  }
}

}  // namespace
}  // namespace palpate::lab

// The bars of docs/reference/lump-figures.md, on the presses that an independent solver made.
#include "solve/realism/lump_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <utility>

#include "support/error_message.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace palpate::lab {
namespace {

TEST(LumpJudge, FindsTheModelNearIndependentFiniteElements) {
  const LumpFindings findings = judgeLumps(readLumpCases(support::testData() / "golden/lumps.json"), {});
  ASSERT_EQ(findings.cases.size(), 43u);
  EXPECT_LT(findings.force.worst, 10.0);
  EXPECT_LT(findings.force.p90, 4.0);
  EXPECT_LT(findings.force_small.worst, 4.2);
  EXPECT_GT(findings.extra_ratios.size(), 150u);
  const auto near = std::ranges::count_if(findings.extra_ratios, [](double r) { return r > 0.75 && r < 1.25; });
  EXPECT_GE(static_cast<double>(near), 0.97 * static_cast<double>(findings.extra_ratios.size()));
  EXPECT_LT(findings.pressure.mean, 4.0);
  EXPECT_LT(findings.pressure.p95, 10.0);
  EXPECT_LT(findings.pressure.worst, 20.0);
  EXPECT_LT(findings.pressure_gain, 0.4);
  EXPECT_LT(findings.surface_small.worst, 2.5);
  EXPECT_LT(findings.surface_large.worst, 6.0);
  EXPECT_LT(findings.field.worst, 2.0);
  ASSERT_EQ(findings.beside.size(), 2u);
  for (const LumpFindings::Beside& beside : findings.beside) {
    EXPECT_LT(beside.ratio_percent, 5.0) << beside.name;
    EXPECT_LT(beside.lateral, 0.015) << beside.name;
  }
}

/// Of 12 mm across and hard, a few millimetres under the skin: solved by palpate tissue solve, none of them fitted to.
TEST(LumpJudge, FindsHardLumpsInSoftFatNearFiniteElements) {
  const LumpFindings findings = judgeLumps(readLumpCases(support::testData() / "golden/lumps_in_soft_fat.json"), {});
  ASSERT_GE(findings.cases.size(), 8u);
  EXPECT_LT(findings.force.worst, 10.0);
  EXPECT_LT(findings.force.mean, 3.0);
  const auto near = std::ranges::count_if(findings.extra_ratios, [](double r) { return r > 0.75 && r < 1.25; });
  EXPECT_GE(static_cast<double>(near), 0.97 * static_cast<double>(findings.extra_ratios.size()));
  EXPECT_EQ(findings.pressure.count, 0u) << "a file without pressures is judged by force alone";
}

TEST(LumpJudge, DrawsSoftFatAndLargeHardShallowLumps) {
  const LumpCases drawn = drawLumpCases(1, 4000);
  const auto least = [&](const auto& value_of) {
    return value_of(*std::ranges::min_element(drawn.cases, {}, value_of));
  };
  const auto most = [&](const auto& value_of) {
    return value_of(*std::ranges::max_element(drawn.cases, {}, value_of));
  };
  const auto fat = [&](const LumpCase& one) { return drawn.stacks[one.stack].layers[1].young_kpa; };
  const auto diameter = [](const LumpCase& one) { return 2.0 * one.lump.half_axes_mm[0]; };
  const auto ratio = [](const LumpCase& one) { return one.lump.stiffness_ratio; };
  const auto spare = [&](const LumpCase& one) {
    return one.lump.depth_mm - tissue::topRange(one.lump, drawn.stacks[one.stack]).from_mm;
  };
  EXPECT_LT(least(fat), 2.2);
  EXPECT_GT(most(fat), 18.0);
  EXPECT_GT(most(diameter), 13.5);
  EXPECT_GT(most(ratio), 38.0);
  EXPECT_LT(least(spare), 0.1);
  for (const LumpCase& one : drawn.cases) EXPECT_NO_THROW(tissue::check(one.lump, drawn.stacks[one.stack])) << one.name;
}

/// A file of one case whose lump has these keys.
std::string fileWithLump(const std::string& keys) {
  return R"({"stacks": [{"name": "S", "layers_mm_kpa": [[2, 150], [8, 10], [30, 27]]}],
             "cases": [{"name": "a", "stack": "S", "presses": [], "lump": {"depth_mm": 4, )" +
         keys + "}}]}";
}

TEST(LumpJudge, ReadsALumpByTheKeysOfScenes) {
  const auto lump = [](const std::string& keys) { return parseLumpCases(fileWithLump(keys), "s.json").cases[0].lump; };
  const tissue::LumpShape flat = lump(R"("half_axes_mm": [6, 6, 3], "stiffness_ratio": 8, "edge": 0.5)");
  EXPECT_EQ(flat.half_axes_mm, (std::array{6.0, 6.0, 3.0}));
  EXPECT_EQ(flat.stiffness_ratio, 8.0);
  EXPECT_FALSE(flat.young_kpa);
  EXPECT_EQ(flat.edge, 0.5);
  const tissue::LumpShape ball = lump(R"("diameter_mm": 6, "young_kpa": 80, "name": "node", "mobility_mm_per_n": 0)");
  EXPECT_EQ(ball.half_axes_mm, (std::array{3.0, 3.0, 3.0}));
  EXPECT_EQ(ball.young_kpa, 80.0);
}

TEST(LumpJudge, RefusesALumpThatNobodyCanPress) {
  const auto fault = [](const std::string& keys) {
    return support::thrownMessage([&] { parseLumpCases(fileWithLump(keys), "s.json"); });
  };
  for (const auto& [keys, words] : {
           std::pair{R"("half_axes_mm": [6, 6, 3], "diameter_mm": 6, "young_kpa": 9)",
                     "must have either half_axes_mm or diameter_mm"},
           std::pair{R"("diameter_mm": 6)", "must have either young_kpa or stiffness_ratio"},
           std::pair{R"("half_axes_mm": [6, 6], "young_kpa": 9)", "half_axes_mm must be three numbers"},
           std::pair{R"("half_axes_mm": [6, 5, 3], "young_kpa": 9)", "the first two half axes must be equal"},
           std::pair{R"("half_axes_mm": 6, "young_kpa": 9)", "half_axes_mm must be three numbers"},
           std::pair{R"("diameter_mm": 6, "young_kpa": 90, "raise_mm": 2)", "must not have raise_mm"},
           std::pair{R"("diameter_mm": 6, "young_kpa": 90, "mobility_mm_per_n": 2)", "must not have mobility_mm_per_n"},
       }) {
    EXPECT_NE(fault(keys).find(words), std::string::npos) << keys << ": " << fault(keys);
  }
}

TEST(LumpJudge, NamesWhatIsWrongWithAFile) {
  const support::TemporaryFolder folder;
  const auto fault = [&](const std::string& text) {
    std::ofstream(folder / "cases.json") << text;
    return support::thrownMessage([&] { readLumpCases(folder / "cases.json"); });
  };
  EXPECT_NE(fault("[").find("is not a file of lump cases"), std::string::npos);
  EXPECT_NE(fault("{}").find("stacks"), std::string::npos);
  EXPECT_NE(fault(R"({"stacks": [], "cases": [{"name": "a", "stack": "Z", "lump": {"diameter_mm": 3, "depth_mm": 3,
                      "young_kpa": 3}, "presses": []}]})")
                .find("unknown stack 'Z'"),
            std::string::npos);
}

TEST(LumpJudge, SpreadsByRank) {
  const Spread spread = computeSpread({3.0, 1.0, 2.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0});
  EXPECT_EQ(spread.p90, 9.0);
  EXPECT_EQ(spread.worst, 10.0);
  EXPECT_EQ(spread.mean, 5.5);
  EXPECT_EQ(computeSpread({}).count, 0u);
}

}  // namespace
}  // namespace palpate::lab

// The bars of docs/explanation/lumps.md, on the presses that an independent solver made.
#include "solve/realism/lump_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

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

TEST(LumpJudge, NamesWhatIsWrongWithAFile) {
  const support::TemporaryFolder folder;
  const auto fault = [&](const std::string& text) {
    std::ofstream(folder / "cases.json") << text;
    return support::messageOf([&] { readLumpCases(folder / "cases.json"); });
  };
  EXPECT_NE(fault("[").find("is not a file of lump cases"), std::string::npos);
  EXPECT_NE(fault("{}").find("stacks"), std::string::npos);
  EXPECT_NE(fault(R"({"stacks": [], "cases": [{"name": "a", "stack": "Z", "lump": {"diameter_mm": 3, "depth_mm": 3,
                      "young_kpa": 3}, "presses": []}]})")
                .find("unknown stack 'Z'"),
            std::string::npos);
}

TEST(LumpJudge, SpreadsByRank) {
  const Spread spread = spreadOf({3.0, 1.0, 2.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0});
  EXPECT_EQ(spread.p90, 9.0);
  EXPECT_EQ(spread.worst, 10.0);
  EXPECT_EQ(spread.mean, 5.5);
  EXPECT_EQ(spreadOf({}).count, 0u);
}

}  // namespace
}  // namespace palpate::lab

// The dissertation's numbers are reproduced, and a wrong one does not slip through.
#include "dissertation/numbers/numbers_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "dissertation/numbers/printed_numbers.h"
#include "dissertation/numbers/table_5_1.h"
#include "dissertation/profile/array_quality.h"
#include "dissertation/report/report.h"
#include "palpate/base/text.h"
#include "support/error_message.h"
#include "support/golden.h"
#include "support/temporary_folder.h"

namespace palpate::study {

namespace {

const NumberRow& rowAt(const std::vector<NumberRow>& rows, const std::string& where, const std::string& what) {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const NumberRow& row) { return row.where == where && row.what == what; });
  if (found == rows.end()) throw Error("no row " + where + ", " + what);
  return *found;
}

// The printed numbers with one of them changed: the study must fail at exactly that place.
template <class Change>
void expectToFail(const Change& change, const std::string& where) {
  PrintedNumbers printed = printedNumbers();
  change(printed);
  const auto rows = studyNumbers(printed);
  EXPECT_FALSE(studyHolds(rows)) << where;
  for (const NumberRow& row : rows) {
    EXPECT_TRUE(row.verdict != Verdict::not_reproduced || row.where.starts_with(where)) << row.where;
  }
}

}  // namespace

TEST(Numbers, EveryComputableNumberIsReproducedOrANamedMisprint) {
  const auto rows = studyNumbers();
  EXPECT_TRUE(studyHolds(rows));
  for (const NumberRow& row : rows) {
    EXPECT_NE(row.verdict, Verdict::not_reproduced) << row.where << " " << row.what << " " << row.ours;
    EXPECT_TRUE(row.verdict != Verdict::misprint || row.erratum != Erratum::none) << row.where;
    EXPECT_FALSE(row.reason.empty()) << row.where;
  }
  EXPECT_EQ(countRows(rows, Verdict::misprint), 5);
  EXPECT_GE(countRows(rows, Verdict::from_engine), 50);
  EXPECT_GE(countRows(rows, Verdict::arithmetic), 150);
}

TEST(Numbers, WhatFollowsFromPrintedNumbersIsNotCalledTheEngines) {
  for (const NumberRow& row : studyNumbers()) {
    const bool is_arithmetic = row.where.starts_with("Appendix") || row.where.starts_with("Table 3.1") ||
                               row.where.starts_with("Table 3.2") || row.where.starts_with("Figure 5.3");
    EXPECT_FALSE(row.verdict == Verdict::from_engine && is_arithmetic) << row.where << " " << row.what;
    EXPECT_EQ(row.tolerance.empty(), row.verdict == Verdict::not_computable) << row.where << " " << row.what;
  }
}

TEST(Numbers, EachRowSaysHowNearItMustBeAndHowNearItIs) {
  const auto rows = studyNumbers();
  const NumberRow& rate = rowAt(rows, "Table 3.2, drawing", "FPS at 1387 triangles");
  EXPECT_NEAR(rate.off_percent.value(), 100.0 * (1000.0 / 2.6 / 378.0 - 1.0), 1e-9);
  EXPECT_EQ(rate.tolerance, "376.9 to 392.7: both roundings");
  EXPECT_EQ(rowAt(rows, "4.2.1", "sigma^2").tolerance, "5e-05");
}

TEST(Numbers, AMisprintIsOneOnlyWhileOursIsTheNumberOfTheErratum) {
  const auto height_5 = [](double ours) { return judged("Table 3.3, height 5", "w", "3.04", ours, "").verdict; };
  EXPECT_EQ(height_5(6.0 / 63.0 * 32.0), Verdict::misprint);
  EXPECT_EQ(height_5(3.2), Verdict::not_reproduced) << "a fault of ours is no misprint";
  EXPECT_EQ(judged("Figure 5.9, e = 400 as radius", "R(E1)", "115", 114.04, "").verdict, Verdict::misprint);
  EXPECT_EQ(judged("Figure 5.9, e = 400 as radius", "R(E1)", "115", 113.0, "").verdict, Verdict::not_reproduced);
}

TEST(Numbers, AStatementHoldsWhereItsNumbersDo) {
  PrintedNumbers printed = printedNumbers();
  EXPECT_EQ(rowAt(studyNumbers(printed), "2.1, 5.1", "grid of the back, mm").verdict, Verdict::inconsistent);
  EXPECT_EQ(rowAt(studyNumbers(printed), "Appendix C, P3", "down against up").verdict, Verdict::arithmetic);
  EXPECT_EQ(rowAt(studyNumbers(printed), "Appendix C, P5", "down against up").verdict, Verdict::inconsistent);
  printed.back_grid_mm = "10";
  printed.bunny_fps = "104";
  printed.hand_triangles = "2818";
  printed.appendix_b = printed.table_3_2;
  const auto rows = studyNumbers(printed);
  EXPECT_EQ(rowAt(rows, "2.1, 5.1", "grid of the back, mm").verdict, Verdict::arithmetic);
  EXPECT_EQ(rowAt(rows, "3.3.3", "bunny without BSP, FPS").verdict, Verdict::arithmetic);
  EXPECT_EQ(rowAt(rows, "4.5, Appendix A", "triangles of the hand").verdict, Verdict::arithmetic);
  EXPECT_EQ(rowAt(rows, "3.4.2", "octree against BSP, drawing").verdict, Verdict::arithmetic);
}

TEST(NumbersFindings, CountApartAndFollowTheRows) {
  std::vector<NumberRow> rows = studyNumbers();
  const auto said = [&] { return fmt::format("{}", fmt::join(numbersFindings(rows), "\n")); };
  EXPECT_NE(said().find(fmt::format("{} numbers come out of our engine", countRows(rows, Verdict::from_engine))),
            std::string::npos);
  EXPECT_NE(said().find("None differs without an erratum"), std::string::npos);
  rows.front().verdict = Verdict::not_reproduced;
  EXPECT_NE(said().find("1 differ WITHOUT an erratum"), std::string::npos);
  EXPECT_NE(said().find("and no erratum says why"), std::string::npos);
}

TEST(Numbers, MisprintsAreTheOnesOfTheErrata) {
  const auto rows = studyNumbers();
  EXPECT_EQ(rowAt(rows, "Table 3.3, height 5", "w").verdict, Verdict::misprint);
  EXPECT_EQ(rowAt(rows, "Table 3.3, height 9", "w").erratum, Erratum::E13_misprints);
  EXPECT_EQ(rowAt(rows, "Figure 5.9, e = 400 as radius", "R(E1)").erratum, Erratum::E28_effect_radius);
  EXPECT_EQ(rowAt(rows, "Figure 5.9, e = 400 as diameter", "R(E1)").verdict, Verdict::from_engine);
}

TEST(Numbers, AWrongNumberFailsTheStudy) {
  expectToFail([](PrintedNumbers& p) { p.table_3_3[0].w = "2.14"; }, "Table 3.3, height 3");
  expectToFail([](PrintedNumbers& p) { p.table_3_3[2].w = "3.03"; }, "Table 3.3, height 5");  // another misprint
  expectToFail([](PrintedNumbers& p) { p.table_3_4[1].node_share = "5/585"; }, "Table 3.4, height 3");
  expectToFail([](PrintedNumbers& p) { p.appendix_b.touched[3].fps = "27"; }, "Appendix B, touched");
  expectToFail([](PrintedNumbers& p) { p.gaussian_variance = "0.1593"; }, "4.2.1");
  expectToFail([](PrintedNumbers& p) { p.exact_r = "121"; }, "Figure 5.10");
  expectToFail([](PrintedNumbers& p) { p.appendix_c_ratios[7] = "0.822"; }, "Appendix C, up P2 subject 3");
  expectToFail([](PrintedNumbers& p) { p.keys[4].figure_degree = "121.5"; }, "Figure 5.3, P5");
  expectToFail([](PrintedNumbers& p) { p.array_sizes = {20, 20, 700}; }, "Figure 4.9");
}

TEST(Numbers, ANumberIsAsExactAsItsDigits) {
  EXPECT_TRUE(agrees("3.04", 3.0449));
  EXPECT_FALSE(agrees("3.04", 3.0476));
  EXPECT_TRUE(agrees("115", 115.49));
  EXPECT_TRUE(agrees("4/15", 4.0 / 15.0));
  EXPECT_FALSE(agrees("4/15", 0.2667));
  EXPECT_NE(support::thrownMessage([] { parsePrinted("3,04"); }), "no error");
}

TEST(Numbers, AgreeWithTheIndependentReference) {
  for (const auto& row : test::goldenRows("gri", "series")) {
    const Vec2 place = test::vec2(row["p"]);
    EXPECT_NEAR(naiveHalfMajor(place, row["e"]), row["naive_5_7"].get<double>(), 1e-9);
    EXPECT_NEAR(exactHalfMajor(place, row["e"]), row["exact_5_16"].get<double>(), 1e-9);
  }
  EXPECT_NEAR(worstArrayError(20, tissue::TableLookup::nearest), 0.56, 0.005);
  EXPECT_NEAR(worstArrayError(130, tissue::TableLookup::nearest), 0.083, 0.001);
  EXPECT_NEAR(worstArrayError(700, tissue::TableLookup::nearest), 0.0153, 0.0005);
  EXPECT_NEAR(worstArrayError(130, tissue::TableLookup::linear), 0.0009, 0.0001);
}

TEST(Numbers, TimesAreComparedAtEqualTriangleCounts) {
  const std::vector<PrintedTiming> slow{{100, "10.0", "100"}, {300, "30.0", "33"}};
  const std::vector<PrintedTiming> fast{{200, "10.0", "100"}, {400, "30.0", "33"}};
  EXPECT_DOUBLE_EQ(timeAt(slow, 200), 20.0);
  EXPECT_TRUE(std::isnan(timeAt(slow, 301)));
  const Gain gain = rateGain(fast, slow);
  EXPECT_DOUBLE_EQ(gain.least, 0.5);  // 30 against 20 ms at 300 triangles
  EXPECT_DOUBLE_EQ(gain.most, 1.0);   // 20 against 10 ms at 200
}

TEST(Numbers, AreReportedAsTextJsonMarkdownAndCsv) {
  const auto rows = studyNumbers();
  const auto json = nlohmann::json::parse(toJson(rows));
  EXPECT_TRUE(json.at("holds").get<bool>());
  EXPECT_EQ(json.at("rows").size() + json.at("statements").size(), rows.size());
  EXPECT_EQ(json.at("rows")[0].at("verdict"), "from our engine");
  EXPECT_EQ(json.at("counts").at("from our engine"), countRows(rows, Verdict::from_engine));
  EXPECT_EQ(json.at("counts").at("arithmetic of printed numbers"), countRows(rows, Verdict::arithmetic));
  EXPECT_NE(textOf(rows).find("0 NOT REPRODUCED"), std::string::npos);
  EXPECT_NE(toMarkdown(rows).find("| Table 3.3, height 5 | w | 3.04 | 3.0476 | +0.25 % | 0.005 | misprint (E13) |"),
            std::string::npos);
  const support::TemporaryFolder folder;
  writeNumbers(rows, folder.path() / "new" / "folder");
  EXPECT_EQ(readFile(folder.path() / "new/folder/numbers.csv", 1 << 20), toCsv(rows));
  EXPECT_NE(support::thrownMessage([&] { writeNumbers(rows, folder.path() / "new/folder/numbers.csv"); }), "no error");
}

}  // namespace palpate::study

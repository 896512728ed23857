// A page is written with all its parts, and its numbers read well.
#include "report/page/study_page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "palpate/base/text.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::study {

namespace {

StudyPage samplePage() {
  figures::Plot plot{.title = "Time against size"};
  plot.x = {.label = "triangles"};
  plot.y = {.label = "time", .unit = "ms"};
  plot.series = {{.name = "ours", .x = {1, 2, 3}, .y = {1, 4, 9}}};
  StudyPage page;
  page.name = "sample";
  page.title = "A sample";
  page.question = "Is it written?";
  page.findings = {"It is written.", "Twice as many cost 4 ms."};
  page.method = {"By hand."};
  page.tables = {{"sample_times", "Times.", {{"triangles", "ms"}, {{"1", "1.0"}}}},
                 {"sample_all", "All of them.", {{"ms"}, {{"77"}}}, false}};
  page.figures = {{"sample_time", "Time grows.", {.panels = {plot}}}};
  page.numbers = {{"slope_ms", 4.0}};
  page.command = "palpate study sample --out DIR";
  page.machine = "Machine: a loom";
  page.seconds = 2.0;
  return page;
}

}  // namespace

TEST(StudyPage, IsWrittenWithItsFiguresAndTables) {
  const support::TemporaryFolder folder;
  writePage(samplePage(), folder / "new");
  for (const char* file :
       {"sample_time.png", "sample_time.svg", "sample_time.csv", "sample_times.csv", "sample_all.csv", "sample.md"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "new" / file)) << file;
  }
  const std::string markdown = readFile(folder / "new/sample.md", 1 << 20);
  for (const char* wanted : {"# A sample", "Is it written?", "- Twice as many", "![Time grows.](sample_time.png)",
                             "| 1 | 1.0 |", "sample_all.csv", "By hand.", "palpate study sample", "a loom"}) {
    EXPECT_NE(markdown.find(wanted), std::string::npos) << wanted;
  }
  EXPECT_EQ(markdown.find("| 77 |"), std::string::npos) << "a long table is a file only";
}

TEST(StudyPage, SumsItselfUpAsJson) {
  const auto json = nlohmann::json::parse(toJson(samplePage()));
  EXPECT_EQ(json["study"], "sample");
  EXPECT_EQ(json["numbers"]["slope_ms"], 4.0);
  EXPECT_EQ(json["figures"][0], "sample_time.svg");
  EXPECT_EQ(json["findings"].size(), 2u);
}

TEST(StudyPage, NestsNumbersAndWordsThatHaveDotsInTheirNames) {
  StudyPage page = samplePage();
  page.numbers = {{"found.hard", 61.0}, {"found.soft", 52.0}, {"people", 12.0}};
  page.words = {{"fitted.first", {"hard"}}};
  EXPECT_FALSE(nlohmann::json::parse(toJson(page)).contains("found")) << "only on top";
  page.numbers_on_top = true;
  const auto json = nlohmann::json::parse(toJson(page));
  EXPECT_EQ(json["found"]["hard"], 61.0);
  EXPECT_EQ(json["found"]["soft"], 52.0);
  EXPECT_EQ(json["people"], 12.0);
  EXPECT_EQ(json["numbers"]["found.hard"], 61.0);
  EXPECT_EQ(json["fitted"]["first"][0], "hard");
  EXPECT_EQ(json["figures"][0], "sample_time.svg");
  page.numbers.emplace_back("figures.one", 1.0);
  EXPECT_EQ(nlohmann::json::parse(toJson(page))["figures"]["files"][0], "sample_time.svg");
}

TEST(StudyPage, AFolderThatCannotBeMadeIsNamed) {
  EXPECT_NE(support::thrownMessage([] { writePage(samplePage(), "/proc/nowhere"); }).find("/proc/nowhere"),
            std::string::npos);
}

TEST(StudyPage, WritesNumbersForReaders) {
  EXPECT_EQ(counted(41582), "41,582");
  EXPECT_EQ(counted(999), "999");
  EXPECT_EQ(counted(-1234567), "-1,234,567");
  EXPECT_EQ(rounded(0.01234), "0.012");
  EXPECT_EQ(rounded(1234.0), "1,200");
  EXPECT_EQ(rounded(12.34, 3), "12.3");
  EXPECT_EQ(rounded(0.0), "0");
  EXPECT_EQ(percent(0.1234), "12 %");
  EXPECT_EQ(percent(0.0123), "1.2 %");
}

}  // namespace palpate::study

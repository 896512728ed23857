// The report is one well-formed file with every figure of every chapter in it.
#include "dissertation/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stack>

#include "dissertation/studies.h"
#include "palpate/base/text.h"
#include "report/page/report_html.h"
#include "report/tests/report/texts_apart.h"
#include "support/error_message.h"
#include "support/expect_each.h"
#include "support/temporary_folder.h"

namespace palpate::study {

namespace {

namespace fs = std::filesystem;

StudyPage tinyPage(const std::string& name) {
  figures::Plot plot{.title = "A line"};
  plot.series = {{.name = "ours", .x = {0, 1}, .y = {0, 1}}};
  StudyPage page;
  page.title = "Is a < b & \"so\"?";
  page.question = "Asked with `palpate study`.";
  page.findings = {"One `tick."};
  page.method = {"By hand."};
  page.figures = {{name + "_line", "A <line>.", {.panels = {plot}}}};
  page.tables = {{name + "_table", "A table.", {{"mm"}, {{"1"}}}}};
  return page;
}

std::vector<Study> tinyChapters() {
  return {{"first", "", [](const StudySettings&) { return tinyPage("first"); }},
          {"second", "", [](const StudySettings&) { return tinyPage("second"); }}};
}

// Empty, or what is wrong: an element that is not closed or closes another, an attribute without quotes.
std::string malformed(const std::string& html) {
  std::stack<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    const std::size_t end = html.find('>', at);
    if (end == std::string::npos) return "an open <";
    const std::string inside = html.substr(at + 1, end - at - 1);
    if (inside.starts_with('!') || inside.ends_with('/')) continue;
    const std::string name = inside.substr(inside.starts_with('/') ? 1 : 0, inside.find(' '));
    if (!inside.starts_with('/')) {
      open.push(name);
    } else if (open.empty() || open.top() != name) {
      return "</" + name + "> closes " + (open.empty() ? "nothing" : open.top());
    } else {
      open.pop();
    }
  }
  return open.empty() ? "" : "<" + open.top() + "> stays open";
}

std::size_t countOccurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

constexpr const char* kPngStart = "\x89PNG\r\n\x1a\n";

void expectAskedFoundAndMeasured(const StudyPage& page) {
  EXPECT_FALSE(page.question.empty() || page.findings.empty() || page.method.empty()) << page.name;
  EXPECT_FALSE(page.figures.empty() || page.tables.empty() || page.numbers.empty()) << page.name;
  EXPECT_EQ(page.command, "palpate study " + page.name + " --quick --out DIR");
}

void expectUnitsOnTheAxes(const figures::Plot& plot, const std::string& stem) {
  for (const figures::Axis& axis : {plot.x, plot.y}) {
    EXPECT_TRUE(axis.hidden || !axis.ticks.empty() || !axis.label.empty()) << stem << ", " << plot.title;
  }
  for (const auto& series : plot.series) EXPECT_EQ(series.x.size(), series.y.size()) << series.name;
}

void expectFiguresWithTextsApart(const StudyPage& page) {
  for (const StudyFigure& figure : page.figures) {
    expectTextsApart(figure.figure, figure.stem);
    EXPECT_TRUE(figures::renderPng(figure.figure, 0.5).starts_with(kPngStart)) << figure.stem;
    for (const auto& panel : figure.figure.panels) {
      if (const auto* plot = std::get_if<figures::Plot>(&panel)) expectUnitsOnTheAxes(*plot, figure.stem);
    }
  }
}

void expectTablesWithoutHoles(const StudyPage& page) {
  for (const StudyTable& table : page.tables) {
    EXPECT_FALSE(table.table.rows.empty()) << table.stem;
    for (const auto& row : table.table.rows) EXPECT_EQ(row.size(), table.table.headings.size()) << table.stem;
  }
}

}  // namespace

TEST(ReportHtml, EscapesTextAndShowsCode) {
  support::expectEach(htmlText, {{"a < b & \"c\"", "a &lt; b &amp; &quot;c&quot;"},
                                 {"run `palpate x` now", "run <code>palpate x</code> now"},
                                 {"a single ` stays", "a single ` stays"},
                                 {"**a** and **b**, **c", "<strong>a</strong> and <strong>b</strong>, **c"}});
}

TEST(Report, IsWellFormedAndHoldsEveryFigure) {
  const support::TemporaryFolder folder;
  writeReport(tinyChapters(), {.quick = true}, folder.path());
  const std::string html = readFile(folder / "report.html", 1 << 24);
  EXPECT_EQ(malformed(html), "");
  EXPECT_EQ(countOccurrences(html, "<figure "), 2u);
  EXPECT_EQ(countOccurrences(html, "src=\"data:image/"), 2u);
  EXPECT_EQ(countOccurrences(html, "http"), 0u) << "works without a network";
  for (const char* wanted : {"id=\"first_line\"", "id=\"second_line\"", "href=\"#second\"", "<section id=\"second\">",
                             "Is a &lt; b &amp; &quot;so&quot;?", "A &lt;line&gt;.", "palpate study second --quick"}) {
    EXPECT_NE(html.find(wanted), std::string::npos) << wanted;
  }
  EXPECT_TRUE(fs::exists(folder / "first.md"));
  EXPECT_TRUE(fs::exists(folder / "second_line.svg"));
}

TEST(Report, TellsItsSteps) {
  const support::TemporaryFolder folder;
  std::vector<std::string> stages;
  std::vector<double> shares;
  std::vector<std::size_t> done;
  writeReport(tinyChapters(),
              {.quick = true,
               .progress =
                   [&](std::string_view stage, double share) {
                     stages.emplace_back(stage);
                     shares.push_back(share);
                   }},
              folder.path(), [&](const ChapterDone& chapter) { done.push_back(chapter.number); });
  ASSERT_FALSE(stages.empty());
  EXPECT_TRUE(stages.front().starts_with("1 of 2, ")) << stages.front();
  EXPECT_TRUE(stages.back().starts_with("2 of 2, ")) << stages.back();
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(done, (std::vector<std::size_t>{1, 2}));
}

TEST(Report, AMissingPictureIsNamed) {
  const support::TemporaryFolder folder;
  EXPECT_NE(support::thrownMessage([&] { reportHtml({}, {tinyPage("lost")}, folder.path()); }).find("lost_line"),
            std::string::npos);
}

TEST(Report, HasAChapterForEveryStudyAndNoFileTwice) {
  std::set<std::string> names;
  for (const Study& chapter : reportChapters({})) EXPECT_TRUE(names.insert(chapter.name).second) << chapter.name;
  for (const char* wanted : {"numbers", "figures", "errata", "tables", "hdb", "assignment", "threshold", "profile",
                             "interpolation", "complexity", "directions"}) {
    EXPECT_TRUE(names.contains(wanted)) << wanted;
  }
}

// Studies take seconds: what is asked of each page, and of the report of all, is asked of one run.
TEST(Report, OfAllStudiesInAQuickRunIsFullPagesWithReadableFigures) {
  const support::TemporaryFolder folder;
  const auto pages = writeReport(reportChapters({}), {.quick = true}, folder.path());
  const std::string html = readFile(folder / "report.html", 1 << 26);
  EXPECT_EQ(malformed(html), "");
  std::set<std::string> stems;
  for (const StudyPage& page : pages) {
    EXPECT_FALSE(page.findings.empty()) << page.name;
    EXPECT_FALSE(page.machine.empty()) << page.name;
    EXPECT_TRUE(fs::exists(folder / (page.name + ".md")));
    expectFiguresWithTextsApart(page);
    expectTablesWithoutHoles(page);
    for (const StudyFigure& figure : page.figures) {
      EXPECT_TRUE(stems.insert(figure.stem).second) << figure.stem;
      EXPECT_NE(html.find("<figure id=\"" + figure.stem + "\">"), std::string::npos) << figure.stem;
    }
    for (const StudyTable& table : page.tables) EXPECT_TRUE(stems.insert(table.stem).second) << table.stem;
  }
  for (const Study& study : studies()) {
    const auto page =
        std::find_if(pages.begin(), pages.end(), [&](const StudyPage& p) { return p.name == study.name; });
    ASSERT_NE(page, pages.end()) << study.name;
    expectAskedFoundAndMeasured(*page);
  }
}

}  // namespace palpate::study

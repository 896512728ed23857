// README and docs/reference/dissertation.md count as the studies count.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "dissertation/figures/dissertation_figures.h"
#include "dissertation/numbers/numbers_study.h"
#include "palpate/base/text.h"
#include "palpate/scene/errata.h"
#include "support/places.h"

namespace palpate::study {

namespace {

/// Line breaks of a document as spaces.
std::string pageText(const char* file) {
  std::string text = readFile(support::sourceFolder() / file, 1 << 20);
  std::replace(text.begin(), text.end(), '\n', ' ');
  for (std::size_t at = 0; (at = text.find("  ", at)) != std::string::npos;) text.erase(at, 1);
  return text;
}

void expectSaid(const char* file, const std::string& words) {
  EXPECT_NE(pageText(file).find(words), std::string::npos) << file << " should say: " << words;
}

std::vector<std::string> figuresWithBasis(FigureBasis basis) {
  std::vector<std::string> numbers;
  for (const DissertationFigure& figure : dissertationFigures()) {
    if (figure.basis == basis) numbers.push_back(figure.number);
  }
  return numbers;
}

}  // namespace

TEST(DocumentsOfStudies, CountTheNumbersApart) {
  const auto rows = studyNumbers();
  const auto count = [&](Verdict verdict) { return countRows(rows, verdict); };
  expectSaid("README.md",
             fmt::format("{} printed numbers come out of the engine, {} follow from other printed numbers, {} are "
                         "misprints, {} statements do not hold",
                         count(Verdict::from_engine), count(Verdict::arithmetic), count(Verdict::misprint),
                         count(Verdict::inconsistent)));
  for (const auto& [start, verdict] : {std::pair{"| from our engine", Verdict::from_engine},
                                       {"| arithmetic of printed numbers", Verdict::arithmetic},
                                       {"| misprints", Verdict::misprint},
                                       {"| inconsistent", Verdict::inconsistent},
                                       {"| not computable", Verdict::not_computable}}) {
    const std::string page = pageText("docs/reference/dissertation.md");
    const auto row = page.find(start);
    ASSERT_NE(row, std::string::npos) << start;
    const auto cell = page.find(" | ", row + 2);
    EXPECT_EQ(page.substr(cell, 3 + 5).find(fmt::format(" | {} |", count(verdict))), 0u) << start << count(verdict);
  }
}

TEST(DocumentsOfStudies, CountTheErrataThatAreMeasured) {
  const auto measured = std::count_if(scene::errata().begin(), scene::errata().end(),
                                      [](const auto& text) { return text.form != scene::LiteralForm::none; });
  expectSaid("README.md", fmt::format("for {} of {} errata", measured, kErrata));
}

TEST(DocumentsOfStudies, SayWhatTheFiguresAreDrawnFrom) {
  const auto printed = figuresWithBasis(FigureBasis::printed);
  const auto examples = figuresWithBasis(FigureBasis::own_example);
  expectSaid("docs/reference/dissertation.md",
             fmt::format("Of the {} figures, {} are computed by the engine", dissertationFigures().size(),
                         figuresWithBasis(FigureBasis::computed).size()));
  expectSaid("docs/reference/dissertation.md", fmt::format("{} plot printed numbers again and compute nothing ({})",
                                                           printed.size(), fmt::join(printed, ", ")));
  expectSaid("docs/reference/dissertation.md",
             fmt::format("{} are computed for an example of our own", examples.size()));
  expectSaid("docs/reference/dissertation.md", fmt::format("({})", fmt::join(examples, ", ")));
}

}  // namespace palpate::study

#include "dissertation/report/report.h"

#include <fmt/format.h>

#include "dissertation/errata/errata_study.h"
#include "dissertation/figures/figure_study.h"
#include "dissertation/numbers/numbers_study.h"

namespace palpate::study {

namespace {

StudyPage numbersPage(const StudySettings&) {
  const std::vector<NumberRow> rows = studyNumbers();
  StudyPage page;
  page.title = "The printed numbers";
  page.command = "palpate study numbers --out DIR";
  page.question = "Which of the dissertation's numbers come out, of our engine or of other numbers that it prints?";
  page.findings = numbersFindings(rows);
  page.method = {numbersLegend(), "docs/reference/dissertation.md names the errata."};
  page.tables = {{"numbers_all", "Numbers that can be computed:", tableOf(rows, true)},
                 {"numbers_statements",
                  "Statements that do not hold, and numbers that nobody can compute today:", tableOf(rows, false)}};
  page.numbers = {{"from_engine", countRows(rows, Verdict::from_engine)},
                  {"arithmetic_of_printed_numbers", countRows(rows, Verdict::arithmetic)},
                  {"misprints", countRows(rows, Verdict::misprint)},
                  {"not_reproduced", countRows(rows, Verdict::not_reproduced)},
                  {"inconsistent", countRows(rows, Verdict::inconsistent)},
                  {"not_computable", countRows(rows, Verdict::not_computable)}};
  return page;
}

// Enough to see that drawing works.
const std::vector<std::string> kQuickFigures{"3.11", "4.8", "5.3"};

std::string figureCaption(const DissertationFigure& entry) {
  const std::string caption = fmt::format("{}. {}.", titleOf(entry), entry.caption);
  return entry.difference.empty() ? caption
                                  : fmt::format("{} What differs from the printed one: {}", caption, entry.difference);
}

StudyPage figuresPage(const StudySettings& settings) {
  const auto chosen = chosenFigures(settings.quick ? kQuickFigures : std::vector<std::string>{});
  StudyPage page;
  page.title = "The printed figures";
  page.command = "palpate study figures --out DIR";
  page.question =
      "Which of the dissertation's figures can be drawn, from what, and what differs from the printed ones?";
  for (const DissertationFigure& entry : chosen) {
    report(settings.progress, titleOf(entry),
           static_cast<double>(page.figures.size()) / static_cast<double>(chosen.size()));
    page.figures.push_back({fileStem(entry), figureCaption(entry), entry.draw()});
  }
  page.findings = figuresFindings(chosen);
  page.method = {"The built-in back and hand stand in for the scan and the bunny, which were never published."};
  page.numbers = {{"figures", static_cast<double>(chosen.size())}};
  return page;
}

StudyPage errataPage(const scene::Scene& scene, const StudySettings& settings) {
  StudyPage page;
  page.title = "What each erratum changes";
  page.command = "palpate study errata --out DIR";
  page.question =
      "Where the dissertation's text is wrong or says two things, the engine takes a corrected form. What does the "
      "other reading change on a scene, one at a time?";
  page.method = {fmt::format("The scene \"{}\" runs once corrected and once more for every other reading, with the "
                             "options that each row names.",
                             scene.title),
                 errataLegend()};
  if (settings.quick) {
    page.findings = {"Not measured in a quick run."};
    return page;
  }
  const ErrataEffects effects = studyErrata(scene, settings.progress);
  page.findings = errataFindings(effects);
  page.tables = {{"errata_effects", "Largest differences from the corrected scene:", tableOf(effects)}};
  for (const ErratumEffect& all : effects.all_literal) {
    const std::string stem = fmt::format("all_literal_{}_", all.base);
    page.numbers.insert(page.numbers.end(), {{stem + "skin_mm", all.skin_mm},
                                             {stem + "force_n", all.force_n},
                                             {stem + "touching_percent", all.look.touching_percent}});
  }
  return page;
}

}  // namespace

std::vector<Study> reportChapters(const scene::Scene& scene) {
  std::vector<Study> chapters{{"numbers", "Printed numbers of the dissertation beside ours", numbersPage},
                              {"figures", "The figures of the dissertation, drawn by the engine", figuresPage},
                              {"errata", "What each erratum of the dissertation changes on a scene",
                               [scene](const StudySettings& settings) { return errataPage(scene, settings); }}};
  chapters.insert(chapters.end(), studies().begin(), studies().end());
  return chapters;
}

}  // namespace palpate::study

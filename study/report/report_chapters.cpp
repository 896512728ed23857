#include "study/report/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/errata/errata_report.h"
#include "study/errata/errata_study.h"
#include "study/figures/figure_study.h"
#include "study/numbers/numbers_study.h"

namespace palpate::study {

namespace {

std::vector<std::string> misprintFindings(const std::vector<NumberRow>& rows) {
  std::vector<std::string> findings;
  for (const NumberRow& row : rows) {
    if (row.verdict != Verdict::misprint && row.verdict != Verdict::not_reproduced) continue;
    findings.push_back(fmt::format("{}, {}: printed {}, ours {}{}.", row.where, row.what, row.printed, row.ours,
                                   row.erratum != Erratum::none ? fmt::format(" (E{})", numberOf(row.erratum)) : ""));
  }
  return findings;
}

StudyPage numbersPage(const StudySettings&) {
  const std::vector<NumberRow> rows = studyNumbers();
  const int reproduced = countOf(rows, Verdict::reproduced);
  const int misprints = countOf(rows, Verdict::misprint);
  const int failed = countOf(rows, Verdict::not_reproduced);
  StudyPage page;
  page.title = "The printed numbers";
  page.command = "palpate study numbers --out DIR";
  page.question =
      "Which of the dissertation's numbers that can be computed come out of our engine to the last printed digit?";
  page.findings = {
      fmt::format("{} of {} numbers are reproduced, {} are misprints that an erratum explains, {} differ "
                  "without one. {} statements contradict the text's own numbers or need the author's "
                  "computer, scan or subjects.",
                  reproduced, reproduced + misprints + failed, misprints, failed,
                  countOf(rows, Verdict::inconsistent) + countOf(rows, Verdict::not_computable))};
  for (std::string& finding : misprintFindings(rows)) page.findings.push_back(std::move(finding));
  page.method = {"A number is reproduced when ours rounds to the printed one. docs/dissertation.md names the errata."};
  page.tables = {
      {"numbers_all", "Numbers that can be computed:", tableOf(rows, true)},
      {"numbers_statements",
       "Statements that contradict themselves, and numbers that nobody can compute today:", tableOf(rows, false)}};
  page.numbers = {{"reproduced", reproduced}, {"misprints", misprints}, {"not_reproduced", failed}};
  return page;
}

// Enough to see that drawing works.
const std::vector<std::string> kQuickFigures{"3.11", "4.8", "5.3"};

std::string captionOf(const DissertationFigure& entry) {
  const std::string caption = fmt::format("{}. {}.", titleOf(entry), entry.caption);
  return entry.difference.empty() ? caption
                                  : fmt::format("{} What differs from the printed one: {}", caption, entry.difference);
}

StudyPage figuresPage(const StudySettings& settings) {
  const auto chosen = chosenFigures(settings.quick ? kQuickFigures : std::vector<std::string>{});
  StudyPage page;
  page.title = "The printed figures";
  page.command = "palpate study figures --out DIR";
  page.question = "Which of the dissertation's figures can be drawn from the text alone, and do they look as printed?";
  for (const DissertationFigure& entry : chosen) {
    report(settings.progress, titleOf(entry),
           static_cast<double>(page.figures.size()) / static_cast<double>(chosen.size()));
    page.figures.push_back({fileStem(entry), captionOf(entry), entry.draw()});
  }
  const auto differing = std::count_if(chosen.begin(), chosen.end(),
                                       [](const DissertationFigure& entry) { return !entry.difference.empty(); });
  page.findings = {
      fmt::format("{} figures are drawn by the engine from the text; {} of them differ from the printed one in "
                  "something that their caption names.",
                  chosen.size(), differing)};
  page.method = {"The built-in back and hand stand in for the scan and the bunny, which were never published."};
  page.numbers = {{"figures", static_cast<double>(chosen.size())}};
  return page;
}

const ErratumEffect* largest(const std::vector<ErratumEffect>& effects, double ErratumEffect::*value) {
  const ErratumEffect* most = nullptr;
  for (const ErratumEffect& effect : effects) {
    if (effect.text.erratum != Erratum::none && (most == nullptr || effect.*value > most->*value)) most = &effect;
  }
  return most;
}

std::vector<std::string> errataFindings(const std::vector<ErratumEffect>& effects) {
  const auto inert = std::count_if(effects.begin(), effects.end(), [](const ErratumEffect& effect) {
    return !effect.reading.empty() && effect.force_n == 0.0 && effect.skin_mm == 0.0 && effect.strain_percent == 0.0;
  });
  const ErratumEffect& force = *largest(effects, &ErratumEffect::force_n);
  const ErratumEffect& skin = *largest(effects, &ErratumEffect::skin_mm);
  const ErratumEffect& lost = *largest(effects, &ErratumEffect::missed_percent);
  const std::string force_of_all = effects.front().force_n > 0.0
                                       ? fmt::format("change a force by up to {:.2f} N", effects.front().force_n)
                                       : "change no force";
  return {fmt::format("All printed forms together move the skin by up to {:.1f} mm and {}.", effects.front().skin_mm,
                      force_of_all),
          fmt::format("Taken singly, the reading that is seen most is that of E{} ({:.1f} mm of skin); felt most is "
                      "E{} ({:.1f} N).",
                      numberOf(skin.text.erratum), skin.skin_mm, numberOf(force.text.erratum), force.force_n),
          fmt::format(
              "The printed traversal (E{}) misses up to {:.0f} % of the triangles in the detecting box, so the finger "
              "loses contact for {} ticks.",
              numberOf(lost.text.erratum), lost.missed_percent, counted(static_cast<double>(lost.lost_ticks))),
          fmt::format("{} readings change nothing at all on this scene.", inert)};
}

StudyPage errataPage(const scene::Scene& scene, const StudySettings& settings) {
  StudyPage page;
  page.title = "What each erratum changes";
  page.command = "palpate study errata --out DIR";
  page.question =
      "Where the dissertation's text is wrong or says two things, the engine takes a corrected form. What does the "
      "other reading change on a scene, one at a time?";
  page.method = {fmt::format("The scene \"{}\" runs once as it is and once more for every other reading.", scene.title),
                 errataLegend()};
  if (settings.quick) {
    page.findings = {"Not measured in a quick run."};
    return page;
  }
  const std::vector<ErratumEffect> effects = studyErrata(scene, settings.progress);
  page.findings = errataFindings(effects);
  page.tables = {{"errata_effects", "Largest differences from the corrected scene:", tableOf(effects)}};
  page.numbers = {{"all_literal_skin_mm", effects.front().skin_mm}, {"all_literal_force_n", effects.front().force_n}};
  return page;
}

}  // namespace

std::vector<Study> reportChapters(const scene::Scene& scene) {
  std::vector<Study> chapters{
      {"numbers", "Every number of the dissertation that can be computed, beside ours", numbersPage},
      {"figures", "The figures of the dissertation, drawn by the engine", figuresPage},
      {"errata", "What each erratum of the dissertation changes on a scene",
       [scene](const StudySettings& settings) { return errataPage(scene, settings); }}};
  chapters.insert(chapters.end(), studies().begin(), studies().end());
  return chapters;
}

}  // namespace palpate::study

// Fills in the findings of numbers, figures and errata and the verdicts that the numbers decide.
#include "dissertation/report/report.h"

#include <algorithm>

#include "dissertation_findings_texts.h"

namespace palpate::study {

namespace {

std::vector<std::string> numbersOf(const std::vector<DissertationFigure>& figures, FigureBasis basis) {
  std::vector<std::string> numbers;
  for (const DissertationFigure& figure : figures) {
    if (figure.basis == basis) numbers.push_back(figure.number);
  }
  return numbers;
}

const ErratumEffect* largest(const std::vector<ErratumEffect>& effects, double ErratumEffect::*value) {
  const ErratumEffect* most = nullptr;
  for (const ErratumEffect& effect : effects) {
    if (effect.*value > 0.0 && (most == nullptr || effect.*value > most->*value)) most = &effect;
  }
  return most;
}

FindingValues allTogether(const ErratumEffect& all, const ErratumEffect& corrected) {
  return {{"active", all.active},
          {"felt", all.look.touching_percent == 0.0 ? "nothing"
                   : all.force_n > 0.0              ? "changed"
                                                    : "unchanged"},
          {"force_n", all.force_n},
          {"touching_percent", all.look.touching_percent},
          {"corrected_touching_percent", corrected.look.touching_percent},
          {"peak_n", all.look.peak_force_n},
          {"corrected_peak_n", corrected.look.peak_force_n},
          {"skin_mm", all.skin_mm},
          {"has_inert", !all.inert.empty()},
          {"inert", all.inert}};
}

/// Number and effect of the erratum with the largest effect; 0 and 0 without any.
FindingValues largestErratumValues(const std::vector<ErratumEffect>& errata, double ErratumEffect::*value) {
  const ErratumEffect* most = largest(errata, value);
  if (most == nullptr) return {{"erratum", 0}, {"most", 0.0}};
  return {{"erratum", numberOf(most->text.erratum)}, {"most", most->*value}};
}

FindingValues mostMissed(const std::vector<ErratumEffect>& errata) {
  const ErratumEffect* most = largest(errata, &ErratumEffect::missed_percent);
  FindingValues values = largestErratumValues(errata, &ErratumEffect::missed_percent);
  values["lost_ticks"] = most == nullptr ? 0 : most->lost_ticks;
  return values;
}

FindingValues dragOfE2(const ErrataEffects& effects) {
  const auto e2 = std::find_if(effects.errata.begin(), effects.errata.end(), [](const ErratumEffect& effect) {
    return effect.text.erratum == Erratum::E2_drag_spring;
  });
  if (e2 == effects.errata.end() || effects.corrected.empty()) return {};
  return {{"corrected_mm", effects.corrected.front().look.drag_mm}, {"mm", e2->look.drag_mm}, {"reading", e2->reading}};
}

FindingValues measuredAndInert(const std::vector<ErratumEffect>& errata) {
  std::vector<std::string> inert;
  std::ptrdiff_t measured = 0;
  for (const ErratumEffect& effect : errata) {
    measured += effect.isMeasured() ? 1 : 0;
    if (effect.isMeasured() && effect.changesNothing()) inert.push_back(scene::nameOf(effect.text.erratum));
  }
  return {{"measured", measured}, {"errata", errata.size()}, {"inert", inert}, {"count", inert.size()}};
}

/// Null without figures.
FindingValues countedFigures(const std::vector<std::string>& figures) {
  if (figures.empty()) return {};
  return {{"count", figures.size()}, {"figures", figures}};
}

}  // namespace

std::vector<std::string> numbersFindings(const std::vector<NumberRow>& rows) {
  FindingValues differing = FindingValues::array();
  for (const NumberRow& row : rows) {
    if (row.verdict != Verdict::misprint && row.verdict != Verdict::not_reproduced) continue;
    differing.push_back({{"where", row.where},
                         {"what", row.what},
                         {"printed", row.printed},
                         {"ours", row.ours},
                         {"erratum", row.erratum == Erratum::none ? 0 : numberOf(row.erratum)}});
  }
  return formatFindings(texts::numbers_findings, {{"counts",
                                                   {{"from_engine", countRows(rows, Verdict::from_engine)},
                                                    {"arithmetic", countRows(rows, Verdict::arithmetic)},
                                                    {"misprints", countRows(rows, Verdict::misprint)},
                                                    {"failed", countRows(rows, Verdict::not_reproduced)}}},
                                                  {"statements",
                                                   {{"inconsistent", countRows(rows, Verdict::inconsistent)},
                                                    {"not_computable", countRows(rows, Verdict::not_computable)}}},
                                                  {"differing", differing}});
}

std::vector<std::string> figuresFindings(const std::vector<DissertationFigure>& figures) {
  const auto differing = std::count_if(figures.begin(), figures.end(),
                                       [](const DissertationFigure& figure) { return !figure.difference.empty(); });
  const std::size_t computed = numbersOf(figures, FigureBasis::computed).size();
  return formatFindings(texts::figures_findings,
                        {{"drawn", {{"figures", figures.size()}, {"computed", computed}}},
                         {"printed", countedFigures(numbersOf(figures, FigureBasis::printed))},
                         {"examples", countedFigures(numbersOf(figures, FigureBasis::own_example))},
                         {"differing", {{"count", differing}}}});
}

std::vector<std::string> errataFindings(const ErrataEffects& effects) {
  FindingValues all = FindingValues::array();
  for (std::size_t i = 0; i < effects.all_literal.size(); ++i) {
    all.push_back(allTogether(effects.all_literal[i], effects.corrected.at(i)));
  }
  return formatFindings(texts::errata_findings,
                        {{"all", all},
                         {"most",
                          {{"seen", largestErratumValues(effects.errata, &ErratumEffect::skin_mm)},
                           {"felt", largestErratumValues(effects.errata, &ErratumEffect::force_n)}}},
                         {"missed", mostMissed(effects.errata)},
                         {"drag", dragOfE2(effects)},
                         {"measured", measuredAndInert(effects.errata)}});
}

}  // namespace palpate::study

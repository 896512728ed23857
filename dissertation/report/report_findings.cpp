// Numbers, figures and errata in sentences: every verdict is decided by the numbers that stand beside it.
#include "dissertation/report/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "report/page/study_page.h"

namespace palpate::study {

namespace {

std::string differingNumber(const NumberRow& row) {
  const std::string why =
      row.erratum != Erratum::none ? fmt::format(" (E{})", numberOf(row.erratum)) : ", and no erratum says why";
  return fmt::format("{}, {}: printed {}, ours {}{}.", row.where, row.what, row.printed, row.ours, why);
}

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

std::string allTogether(const ErratumEffect& all, const ErratumEffect& corrected) {
  const std::string verdict = all.look.touching_percent == 0.0 ? "nothing is felt at all"
                              : all.force_n > 0.0 ? fmt::format("forces change by up to {:.2f} N", all.force_n)
                                                  : "no force changes";
  const std::string inert = all.inert.empty() ? "" : fmt::format(" Inert with these options: {}.", all.inert);
  return fmt::format(
      "All printed forms together with {}: {}. The fingers touch in {:.1f} % of the ticks (corrected: {:.1f} %) with "
      "{:.2f} N at most ({:.2f} N), and the skin differs by up to {:.1f} mm.{}",
      all.active, verdict, all.look.touching_percent, corrected.look.touching_percent, all.look.peak_force_n,
      corrected.look.peak_force_n, all.skin_mm, inert);
}

std::string mostSeenAndFelt(const std::vector<ErratumEffect>& errata) {
  const auto most = [&](double ErratumEffect::*value, const char* unit) {
    const ErratumEffect* effect = largest(errata, value);
    return effect == nullptr ? "none"
                             : fmt::format("E{} ({:.1f} {})", numberOf(effect->text.erratum), effect->*value, unit);
  };
  return fmt::format("Taken singly, the reading that is seen most is that of {}; felt most is that of {}.",
                     most(&ErratumEffect::skin_mm, "mm of skin"), most(&ErratumEffect::force_n, "N"));
}

std::string mostMissed(const std::vector<ErratumEffect>& errata) {
  const ErratumEffect* most = largest(errata, &ErratumEffect::missed_percent);
  if (most == nullptr) return "No reading misses a triangle in the detecting box.";
  const std::string lost = most->lost_ticks > 0 ? fmt::format("the fingers lose contact for {} ticks",
                                                              counted(static_cast<double>(most->lost_ticks)))
                                                : "no finger loses contact by it";
  return fmt::format("That of E{} misses most of the triangles in the detecting box, up to {:.0f} %: {}.",
                     numberOf(most->text.erratum), most->missed_percent, lost);
}

std::string dragOfE2(const ErrataEffects& effects) {
  const auto e2 = std::find_if(effects.errata.begin(), effects.errata.end(), [](const ErratumEffect& effect) {
    return effect.text.erratum == Erratum::E2_drag_spring;
  });
  if (e2 == effects.errata.end() || effects.corrected.empty()) return "";
  return fmt::format("The fingers pull the skin along by {:.1f} mm at most, and by {:.1f} mm with {} (E2).",
                     effects.corrected.front().look.drag_mm, e2->look.drag_mm, e2->reading);
}

std::string measuredAndInert(const std::vector<ErratumEffect>& errata) {
  std::vector<std::string> inert;
  std::ptrdiff_t measured = 0;
  for (const ErratumEffect& effect : errata) {
    measured += effect.isMeasured() ? 1 : 0;
    if (effect.isMeasured() && effect.changesNothing()) inert.push_back(scene::nameOf(effect.text.erratum));
  }
  const std::string nothing = inert.empty() ? "each of them changed something on this scene"
                                            : fmt::format("on this scene {} of them changed nothing at all ({})",
                                                          inert.size(), fmt::join(inert, ", "));
  return fmt::format("{} of {} errata have another reading that can be measured; {}.", measured, errata.size(),
                     nothing);
}

}  // namespace

std::vector<std::string> numbersFindings(const std::vector<NumberRow>& rows) {
  const int failed = countOf(rows, Verdict::not_reproduced);
  std::vector<std::string> findings{fmt::format(
      "{} numbers come out of our engine within their tolerance. {} more are arithmetic of other printed numbers and "
      "show that the text agrees with itself. {} are misprints, where ours is the number that an erratum names. {}",
      countOf(rows, Verdict::from_engine), countOf(rows, Verdict::arithmetic), countOf(rows, Verdict::misprint),
      failed == 0 ? "None differs without an erratum." : fmt::format("{} differ WITHOUT an erratum.", failed))};
  findings.push_back(
      fmt::format("{} statements do not hold, and {} numbers need the author's computer, scan or subjects.",
                  countOf(rows, Verdict::inconsistent), countOf(rows, Verdict::not_computable)));
  for (const NumberRow& row : rows) {
    if (row.verdict == Verdict::misprint || row.verdict == Verdict::not_reproduced) {
      findings.push_back(differingNumber(row));
    }
  }
  return findings;
}

std::vector<std::string> figuresFindings(const std::vector<DissertationFigure>& figures) {
  const auto differing = std::count_if(figures.begin(), figures.end(),
                                       [](const DissertationFigure& figure) { return !figure.difference.empty(); });
  const auto printed = numbersOf(figures, FigureBasis::printed);
  const auto examples = numbersOf(figures, FigureBasis::own_example);
  std::vector<std::string> findings{
      fmt::format("{} figures are drawn: {} are computed by the engine from the text's formulae or on our models.",
                  figures.size(), numbersOf(figures, FigureBasis::computed).size())};
  if (!printed.empty()) {
    findings.push_back(fmt::format("{} plot printed numbers again and compute nothing: {}.", printed.size(),
                                   fmt::join(printed, ", ")));
  }
  if (!examples.empty()) {
    findings.push_back(
        fmt::format("{} are computed for an example of our own, with places, axes or drags that the text "
                    "does not give: {}.",
                    examples.size(), fmt::join(examples, ", ")));
  }
  findings.push_back(fmt::format("{} differ from the printed one in something that their caption names.", differing));
  return findings;
}

std::vector<std::string> errataFindings(const ErrataEffects& effects) {
  std::vector<std::string> findings;
  for (std::size_t i = 0; i < effects.all_literal.size(); ++i) {
    findings.push_back(allTogether(effects.all_literal[i], effects.corrected.at(i)));
  }
  findings.push_back(mostSeenAndFelt(effects.errata));
  findings.push_back(mostMissed(effects.errata));
  findings.push_back(dragOfE2(effects));
  findings.push_back(measuredAndInert(effects.errata));
  std::erase(findings, "");
  return findings;
}

}  // namespace palpate::study

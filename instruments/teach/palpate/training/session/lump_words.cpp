// Texts of a session with lumps, on the screen and aloud.
#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/language.h"
#include "palpate/training/session/lump_session.h"

namespace palpate::training {

namespace {

using lumps::LumpQuestion;

const Site& nearestSite(const SiteSet& sites, const Vec2& place_mm) {
  return *std::ranges::min_element(sites.sites, {},
                                   [&](const Site& site) { return (site.place_mm - place_mm).squaredNorm(); });
}

std::string gradeLabel(LumpQuestion question, int grade) {
  return lumpChoices(question)[static_cast<std::size_t>(grade)];
}

std::string kindOf(const lumps::HiddenLump& lump) {
  return trf("{}, {}, {}, {}", gradeLabel(LumpQuestion::size, lump.size), gradeLabel(LumpQuestion::depth, lump.depth),
             gradeLabel(LumpQuestion::hardness, lump.hardness), gradeLabel(LumpQuestion::mobile, lump.mobile ? 1 : 0));
}

}  // namespace

std::string lumpInstruction(bool exam) {
  return exam ? tr("Find every lump in six bodies. Name each place, then its kind.")
              : tr("Feel for a lump. There may be one, or none.");
}

std::string lumpQuestionText(LumpQuestion question, bool exam, std::size_t named) {
  switch (question) {
    case LumpQuestion::there:
      return tr("Is there a lump?");
    case LumpQuestion::place:
      if (!exam) return tr("Where is it? Point at the place.");
      return named == 0 ? tr("Point at a lump, or say there is none.")
                        : tr("Point at another lump, or say there are no more.");
    case LumpQuestion::size:
      return tr("How large is it?");
    case LumpQuestion::depth:
      return tr("How deep is it?");
    case LumpQuestion::hardness:
      return tr("How hard is it?");
    case LumpQuestion::mobile:
      return tr("Is it fixed, or does it move?");
    case LumpQuestion::none:
      break;
  }
  return {};
}

std::vector<std::string> lumpChoices(LumpQuestion question) {
  switch (question) {
    case LumpQuestion::there:
      return {tr("no lump"), tr("a lump")};
    case LumpQuestion::size:
      return {tr("small"), tr("medium-sized"), tr("large")};
    case LumpQuestion::depth:
      return {tr("shallow"), tr("medium-deep"), tr("deep")};
    case LumpQuestion::hardness:
      return {tr("soft"), tr("medium-hard"), tr("hard")};
    case LumpQuestion::mobile:
      return {tr("fixed"), tr("mobile")};
    case LumpQuestion::place:
    case LumpQuestion::none:
      break;
  }
  return {};
}

std::string lumpFeedback(const lumps::LumpTrial& trial, const lumps::LumpTask& task, const SiteSet& sites) {
  const bool said = !trial.findings.empty();
  if (trial.hidden.empty()) return said ? tr("There was none.") : tr("Correct. There was none.");
  const lumps::HiddenLump& lump = trial.hidden.front();
  const std::string where = spoken(nearestSite(sites, lump.place_mm));
  const std::string first = isRight(trial, task) ? trf("Correct, near {}.", where)
                            : said               ? trf("There was one, but near {}.", where)
                                                 : trf("There was one, near {}.", where);
  return fmt::format("{} {}", first, trf("It is {}.", kindOf(lump)));
}

std::string lumpSummary(const lumps::LumpCounts& counts, bool exam) {
  if (exam) {
    const std::string found =
        trf("{} of {} lumps found, {} false alarms.", counts.found, counts.lumps, counts.false_places);
    return fmt::format("{} {}", found, counts.passed ? tr("Passed.") : tr("Not yet."));
  }
  const std::string found = trf("{} of {} lumps found.", counts.found, counts.lumps);
  if (counts.without == 0) return found;
  return fmt::format(
      "{} {}", found,
      trf("{} of {} bodies without a lump recognised.", counts.without - counts.said_without, counts.without));
}

}  // namespace palpate::training

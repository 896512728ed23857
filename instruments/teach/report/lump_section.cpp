// The part of a training report about sessions with lumps: lumps found, by size, depth and hardness, false alarms, and
// what was known of the lumps.
#include <fmt/format.h>

#include "cli/kit/json.h"
#include "palpate/base/json.h"
#include "palpate/base/language.h"
#include "report/recording/report_html.h"
#include "teach/report/training_report.h"

namespace palpate::app {

namespace {

using training::LumpGroup;
using training::LumpSessionResult;
using training::LumpStatistics;
using training::Rate;

std::string formatWholePercent(double share) { return fmt::format("{:.0f} %", WrittenNumber{100.0 * share}); }

/// "12 of 18, 67 % (44 to 84 %)"
std::string formatRate(const Rate& rate) {
  if (rate.whole == 0) return kNoValue;
  const training::ShareInterval interval = rate.interval();
  return trf("{} of {}, {} ({} to {})", rate.part, rate.whole, formatWholePercent(rate.share()),
             formatWholePercent(interval.low), formatWholePercent(interval.high));
}

std::string formatCueThreshold(const lumps::CueThreshold& threshold) {
  if (!(threshold.median > 0.0)) return kNoValue;
  const auto number = [](double value) { return fmt::format("{:.2g}", WrittenNumber{value}); };
  return trf("{} ({} to {})", number(threshold.median), number(threshold.low), number(threshold.high));
}

std::string formatDPrime(const LumpStatistics& statistics) {
  if (!statistics.prime) return kNoValue;
  const auto number = [](double value) { return fmt::format("{:.1f}", WrittenNumber{value}); };
  return trf("{} ({} to {})", number(statistics.prime->value), number(statistics.prime->low),
             number(statistics.prime->high));
}

std::string groupName(const LumpGroup& group) {
  const std::string kind =
      group.kind == training::SessionKind::lump ? tr("Practice with lumps") : tr("Examination with lumps");
  return trf("{} (protocol {} version {})", kind, group.protocol_id, group.protocol_version);
}

std::string verdictText(const LumpSessionResult& sitting) {
  const bool broken_off = sitting.block.verdict == training::Verdict::none && !sitting.block.finished;
  return broken_off ? tr("interrupted") : verdictName(sitting.block.verdict);
}

std::string sittingsTable(const LumpGroup& group, bool of_class) {
  std::vector<Cells> rows;
  for (const LumpSessionResult& sitting : group.sittings) {
    const LumpStatistics& said = sitting.statistics;
    Cells row = {formatDay(sitting.start_ms), fmt::format("{}", said.counts.bodies), formatRate(said.found),
                 fmt::format("{}", said.counts.false_places)};
    if (of_class) row.insert(row.begin(), shortPseudonym(sitting.trainee));
    if (group.kind == training::SessionKind::lump) {
      row.insert(row.end(), {formatRate(said.known_with), formatRate(said.known_without), formatDPrime(said)});
    }
    row.insert(row.end(), {formatCueThreshold(said.counts.threshold), verdictText(sitting)});
    rows.push_back(std::move(row));
  }
  Cells head = {tr("day"), tr("bodies"), tr("lumps found (95 %)"), tr("false alarms")};
  if (of_class) head.insert(head.begin(), tr("trainee"));
  if (group.kind == training::SessionKind::lump) {
    head.insert(head.end(), {tr("bodies with a lump recognised"), tr("bodies without recognised"), tr("d′ (95 %)")});
  }
  head.insert(head.end(), {tr("C of what is found half the time (95 %)"), tr("verdict")});
  return tableOf("numbers", head, rows);
}

std::string gradeName(const LumpGroup& group, const training::LumpTrait& trait, std::size_t grade) {
  return fmt::format(fmt::runtime(tr(trait.words)), (group.task.*trait.grades)[grade]);
}

std::string kindsTable(const LumpGroup& group) {
  std::vector<Cells> rows;
  for (const training::LumpTrait& trait : training::kLumpTraits) {
    for (std::size_t grade = 0; grade < lumps::kGrades; ++grade) {
      const Rate& found = (group.all.*trait.counted).found[grade];
      if (found.whole > 0) rows.push_back({gradeName(group, trait, grade), formatRate(found)});
    }
  }
  rows.push_back({tr("fixed"), formatRate(group.all.fixed)});
  rows.push_back({tr("mobile"), formatRate(group.all.mobile)});
  rows.push_back({tr("all"), formatRate(group.all.found)});
  return tableOf("numbers", {tr("lumps"), tr("found (95 %)")}, rows);
}

std::string saidTable(const LumpGroup& group) {
  std::vector<Cells> rows;
  for (const training::LumpTrait& trait : training::kLumpTraits) {
    for (std::size_t grade = 0; grade < lumps::kGrades; ++grade) {
      Cells& row = rows.emplace_back(Cells{gradeName(group, trait, grade)});
      for (const int count : (group.all.*trait.counted).said[grade]) row.push_back(fmt::format("{}", count));
    }
  }
  return tableOf("numbers",
                 {tr("lumps that were found"), tr("answered: least"), tr("answered: middle"), tr("answered: most")},
                 rows);
}

Json rateJson(const Rate& rate) {
  const training::ShareInterval interval = rate.interval();
  return {{"part", rate.part},
          {"whole", rate.whole},
          {"share", rate.share()},
          {"low", interval.low},
          {"high", interval.high}};
}

Json lumpStatisticsJson(const LumpStatistics& statistics) {
  const lumps::LumpCounts& counts = statistics.counts;
  Json json = {{"bodies", counts.bodies}, {"false_places", counts.false_places}};
  json["found"] = rateJson(statistics.found);
  json["known_with"] = rateJson(statistics.known_with);
  json["known_without"] = rateJson(statistics.known_without);
  json["d_prime"] = nullptr;
  if (statistics.prime) {
    json["d_prime"] = {
        {"value", statistics.prime->value}, {"low", statistics.prime->low}, {"high", statistics.prime->high}};
  }
  json["cue"] = {{"median", counts.threshold.median}, {"low", counts.threshold.low}, {"high", counts.threshold.high}};
  for (const training::LumpTrait& trait : training::kLumpTraits) {
    json[fmt::format("by_{}", trait.name)] = listJson((statistics.*trait.counted).found, rateJson);
  }
  json["fixed"] = rateJson(statistics.fixed);
  json["mobile"] = rateJson(statistics.mobile);
  for (const training::LumpTrait& trait : training::kLumpTraits) {
    json[fmt::format("said_{}", trait.name)] = (statistics.*trait.counted).said;
  }
  json["mobility_right"] = rateJson(statistics.mobility_right);
  json["error_mm"] = {{"count", statistics.error_mm.count},
                      {"median", statistics.error_mm.median},
                      {"greatest", statistics.error_mm.greatest}};
  return json;
}

Json sittingJson(const LumpSessionResult& sitting) {
  Json json = {{"block", sitting.block.id},          {"trainee", shortPseudonym(sitting.trainee)},
               {"start_ms", sitting.start_ms},       {"device", sitting.device},
               {"finished", sitting.block.finished}, {"verdict", wordFor(sitting.block.verdict)}};
  json.update(lumpStatisticsJson(sitting.statistics));
  return json;
}

Json lumpGroupJson(const LumpGroup& group) {
  return {{"kind", wordFor(group.kind)},
          {"protocol", group.protocol_id},
          {"protocol_version", group.protocol_version},
          {"diameters_mm", group.task.diameters_mm},
          {"depths_mm", group.task.depths_mm},
          {"ratios", group.task.ratios},
          {"all", lumpStatisticsJson(group.all)},
          {"sittings", listJson(group.sittings, sittingJson)}};
}

}  // namespace

std::string lumpSections(const TrainingReport& report) {
  std::string html;
  for (const LumpGroup& group : report.lumps) {
    html += headingHtml(groupName(group)) + sittingsTable(group, report.of_class) + kindsTable(group);
    if (group.all.error_mm.count > 0) {
      html += paragraphHtml(trf("Named places were {:.1f} mm from the lumps (median; the farthest {:.1f} mm).",
                                group.all.error_mm.median, group.all.error_mm.greatest));
    }
    html += foldedHtml(tr("Answers about the lumps that were found"), saidTable(group));
  }
  if (!html.empty()) {
    html +=
        paragraphHtml(tr("C is how clearly a lump is felt: the change of force and of the pressure pattern over "
                         "it, each divided by the smallest that people notice. d′ is how well bodies with a "
                         "lump were distinguished from those without: 0 is guessing."));
  }
  return html;
}

std::vector<std::string> lumpSentences(const TrainingReport& report) {
  std::vector<std::string> sentences;
  for (const LumpGroup& group : report.lumps) {
    const LumpStatistics& all = group.all;
    std::string text = trf("{}: {} of {} lumps found, {} false alarms in {} bodies.", groupName(group),
                           all.counts.found, all.counts.lumps, all.counts.false_places, all.counts.bodies);
    if (all.counts.without > 0) {
      text += fmt::format(
          " {}", trf("Of {} bodies without a lump {} were recognised.", all.counts.without, all.known_without.part));
    }
    const LumpSessionResult& last = group.sittings.back();
    if (!report.of_class && last.block.verdict == training::Verdict::pass) {
      text += fmt::format(" {}", trf("The last, of {}: passed.", formatDay(last.start_ms)));
    } else if (!report.of_class && last.block.verdict == training::Verdict::not_yet) {
      text += fmt::format(" {}", trf("The last, of {}: not yet.", formatDay(last.start_ms)));
    }
    sentences.push_back(std::move(text));
  }
  return sentences;
}

Json lumpGroupsJson(const TrainingReport& report) { return listJson(report.lumps, lumpGroupJson); }

}  // namespace palpate::app

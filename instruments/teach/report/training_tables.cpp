#include "teach/report/training_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "palpate/base/language.h"
#include "report/recording/report_html.h"

namespace palpate::app {

namespace {

using training::Spread;
using training::ThresholdPoint;
using training::TraineeStatistics;
using training::TrialStatistics;

/// More sessions than this are counted, not listed.
constexpr std::size_t kMaxSittings = 60;

std::string formatDecimals(double value, int decimals) {
  return fmt::format("{:.{}f}", WrittenNumber{value}, decimals);
}

std::string formatPercent(double share) { return fmt::format("{:.1f} %", WrittenNumber{100.0 * share}); }

std::string joinNonEmpty(const std::set<std::string>& words) {
  std::string list;
  for (const std::string& word : words) {
    if (!word.empty()) list += (list.empty() ? "" : "; ") + word;
  }
  return list;
}

/// A word as records have it, for people; a newer version may write others.
std::string recordWord(const std::string& word) {
  static constexpr std::array kWords = {
      // kinds of sessions and verdicts
      toTranslate("practice"), toTranslate("mastery"), toTranslate("pre_test"), toTranslate("post_test"),
      toTranslate("exam"), toTranslate("retention"), toTranslate("free"), toTranslate("lump"), toTranslate("lump_exam"),
      toTranslate("pass"), toTranslate("not_yet"), toTranslate("repeat"),
      // events
      toTranslate("break"), toTranslate("familiarisation"), toTranslate("leave"), toTranslate("pause"),
      toTranslate("resume"), toTranslate("safety"), toTranslate("tissue"), toTranslate("warning"),
      // why trials are left out
      toTranslate("target not felt"), toTranslate("fewer than two places felt")};
  const auto* known = std::ranges::find(kWords, word);
  return known == kWords.end() ? word : tr(*known);
}

std::string formatReasonCounts(const training::Reasons& reasons) {
  std::string words;
  for (const auto& [reason, count] : reasons)
    words += fmt::format("{}{}: {}", words.empty() ? "" : ", ", recordWord(reason), count);
  return words;
}

std::string methodName(training::Method method) {
  switch (method) {
    case training::Method::marginal_psi:
      return tr("adaptive levels");
    case training::Method::two_down_one_up:
      return tr("staircase levels");
    case training::Method::mastery:
      return tr("mastery, 3 of 4");
    case training::Method::constant_levels:
      break;
  }
  return tr("fixed levels");
}

std::string formatResult(const ThresholdPoint& point) {
  if (point.threshold) return formatThreshold(*point.threshold);
  if (point.method == training::Method::mastery) {
    return point.level ? trf("level {}", formatChange(*point.level)) : tr("no level yet");
  }
  return tr("too few answers");
}

/// median (middle half)
std::string formatSpread(const Spread& spread, int decimals) {
  if (spread.count == 0) return kNoValue;
  return trf("{} ({} to {})", formatDecimals(spread.median, decimals), formatDecimals(spread.lower_quartile, decimals),
             formatDecimals(spread.upper_quartile, decimals));
}

std::string siteName(const training::SiteSet& set, int number) {
  const training::Site* site = set.numbered(number);
  return site == nullptr ? fmt::format("{}", number) : fmt::format("{}: {}", number, site->label);
}

struct MadeWith {
  std::set<std::string> devices, versions, meanings, protocols;
  std::int64_t first_ms = 0, last_ms = 0;
};

MadeWith madeWith(const TrainingReport& report) {
  MadeWith made;
  for (const TraineeStatistics& trainee : report.statistics.trainees) {
    for (const training::SessionQuality& session : trainee.sessions) {
      made.devices.insert(session.row.device);
      made.versions.insert(session.row.app_version);
      if (made.first_ms == 0 || session.row.start_ms < made.first_ms) made.first_ms = session.row.start_ms;
      made.last_ms = std::max(made.last_ms, session.row.start_ms);
    }
    for (const ThresholdPoint& point : trainee.points) {
      made.meanings.insert(changeMeaningName(point.meaning));
      made.protocols.insert(trf("{} version {}", point.protocol_id, point.protocol_version));
    }
  }
  return made;
}

std::string formatEventCounts(const training::SessionQuality& session) {
  std::string words;
  for (const auto& [kind, count] : session.events) {
    if (kind == "block" || kind == "screen") continue;  // part of every session
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", count, recordWord(kind));
  }
  return words.empty() ? kNoValue : words;
}

std::string sessionsTable(const TraineeStatistics& trainee) {
  std::vector<Cells> rows;
  for (const training::SessionQuality& session : trainee.sessions) {
    if (rows.size() == kMaxSittings) break;
    const training::SessionRow& row = session.row;
    rows.push_back({formatDay(row.start_ms), recordWord(std::string(wordFor(row.kind))), row.device, row.app_version,
                    row.end_ms == 0 ? tr("not ended") : tr("ended"), formatEventCounts(session),
                    row.file.empty() ? tr("none") : row.file});
  }
  return tableOf("words",
                 {tr("day"), tr("kind"), tr("device and thimble"), tr("version"), "", tr("events"), tr("recording")},
                 rows);
}

std::string checksTable(const TrialStatistics& tests, const TrialStatistics& practice) {
  std::vector<Cells> rows;
  for (const training::TrialCount& each : training::trialCounts()) {
    if (each.words == nullptr) continue;
    rows.push_back({tr(each.words), fmt::format("{}", tests.*each.count), fmt::format("{}", practice.*each.count)});
  }
  return tableOf("numbers", {"", tr("tests"), tr("practice")}, rows);
}

}  // namespace

std::string trainingFacts(const TrainingReport& report) {
  const MadeWith made = madeWith(report);
  std::string html = "<div class=\"wide\"><table class=\"facts\"><tbody>\n";
  html += factRow(tr("Class"), report.class_words);
  if (report.of_class) html += factRow(tr("Trainees"), fmt::format("{}", report.statistics.trainees.size()));
  if (made.first_ms > 0) {
    const std::string first = formatDay(made.first_ms);
    const std::string last = formatDay(made.last_ms);
    html += factRow(tr("Days"), first == last ? first : trf("{} to {}", first, last));
  }
  html += factRow(tr("Device"), joinNonEmpty(made.devices));
  html += factRow(tr("Change of"), joinNonEmpty(made.meanings));
  html += factRow(tr("Protocol"), joinNonEmpty(made.protocols));
  html += factRow(tr("Recorded by"), made.versions.empty() ? "" : joinNonEmpty(made.versions));
  html += factRow(tr("Records"), report.file.filename().string());
  return html + "</tbody></table></div>\n";
}

std::string blocksTable(const TraineeStatistics& trainee) {
  std::vector<Cells> rows;
  for (const ThresholdPoint& point : trainee.points) {
    const auto filtered = std::ranges::find_if(trainee.curve, [&](const training::FilteredPoint& each) {
      return trainee.points[each.point].block == point.block;
    });
    rows.push_back({occasionName(point.kind, point.nth), formatDay(point.start_ms), methodName(point.method),
                    trf("{} of {}", point.trials.correct, point.trials.counted), formatResult(point),
                    filtered == trainee.curve.end() ? kNoValue : formatThreshold(filtered->filtered),
                    verdictName(point.verdict), formatDecimals(point.trials.places_felt.mean, 1),
                    formatDecimals(point.trials.seconds.median, 0), point.finished ? "" : tr("interrupted")});
  }
  return tableOf("numbers",
                 {tr("block"), tr("day"), tr("method"), tr("right answers"), tr("by itself (95 %)"),
                  tr("so far (95 %)"), tr("verdict"), tr("places felt"), tr("time (s)"), ""},
                 rows);
}

std::string fitsTable(const TraineeStatistics& trainee) {
  std::vector<Cells> rows;
  for (const ThresholdPoint& point : trainee.points) {
    if (!point.threshold) continue;
    rows.push_back({occasionName(point.kind, point.nth), formatDay(point.start_ms), formatResult(point),
                    formatDecimals(point.slope, 2), formatPercent(point.lapse), fmt::format("{}", point.choices),
                    fmt::format("{}", point.trials.counted)});
  }
  if (rows.empty()) return {};
  return tableOf("numbers",
                 {tr("block"), tr("day"), tr("smallest change (95 %)"), tr("slope"), tr("lapse rate"),
                  tr("places asked about"), tr("answers")},
                 rows);
}

std::string occasionsTable(const training::ClassStatistics& all) {
  std::vector<Cells> rows;
  for (const training::Occasion& occasion : all.occasions) {
    const bool known = occasion.group.people >= 2;
    rows.push_back({occasionName(occasion.kind, occasion.nth), fmt::format("{}", occasion.medians.count),
                    known ? formatThreshold(
                                {.median = occasion.group.mean, .low = occasion.group.low, .high = occasion.group.high})
                          : kNoValue,
                    known ? formatChange(occasion.group.sd) : kNoValue, formatChange(occasion.medians.lower_quartile),
                    formatChange(occasion.medians.median), formatChange(occasion.medians.upper_quartile),
                    formatReasonCounts(occasion.verdicts)});
  }
  if (rows.empty()) return {};
  return tableOf("numbers",
                 {tr("occasion"), tr("trainees"), tr("mean smallest change of the group (95 %)"),
                  tr("SD between trainees"), tr("lower quartile"), tr("median"), tr("upper quartile"), tr("verdicts")},
                 rows);
}

std::string traineesTable(const training::TrainingStatistics& statistics) {
  std::vector<Cells> rows;
  for (const TraineeStatistics& trainee : statistics.trainees) {
    const ThresholdPoint* latest = trainee.latest();
    std::string change(kNoValue);
    if (trainee.compared) {
      const training::TestsCompared& compared = *trainee.compared;
      change = compared.why_not            ? tr("not compared")
               : !compared.change.clear    ? tr("too early to call")
               : compared.change.ratio < 1 ? trf("better, {:.2f} times", compared.change.ratio)
                                           : trf("worse, {:.2f} times", compared.change.ratio);
    }
    const int shown = trainee.tests.shown + trainee.practice.shown;
    const int left_out = trainee.tests.excluded + trainee.practice.excluded;
    rows.push_back({shortPseudonym(trainee.id), fmt::format("{}", trainee.points.size()), fmt::format("{}", shown),
                    latest == nullptr ? kNoValue : occasionName(latest->kind, latest->nth),
                    latest == nullptr ? kNoValue : formatResult(*latest), change, fmt::format("{}", left_out),
                    trf("{} of {}", trainee.tests.easy_wrong, trainee.tests.easy)});
  }
  return tableOf("numbers",
                 {tr("trainee"), tr("blocks"), tr("trials"), tr("latest"), tr("smallest change (95 %)"),
                  tr("since the first test"), tr("left out"), tr("easy ones wrong")},
                 rows);
}

std::string levelsTable(const TrialStatistics& trials, const std::string& what) {
  if (trials.levels.empty()) return {};
  std::vector<Cells> rows;
  for (const training::AnswerBox& level : trials.levels) {
    const training::ShareInterval interval = level.right.interval();
    rows.push_back({formatChange(level.middle), fmt::format("{}", level.right.whole),
                    fmt::format("{}", level.right.part), formatPercent(level.right.share()),
                    trf("{} to {}", formatPercent(interval.low), formatPercent(interval.high)),
                    formatPercent(level.chance), formatPercent(level.corrected())});
  }
  return foldedHtml(trf("Each change: {}", what),
                    tableOf("numbers",
                            {tr("change"), tr("answers"), tr("right answers"), tr("share"), "95 %", tr("by chance"),
                             tr("corrected for chance")},
                            rows));
}

std::string sitesTable(const TrialStatistics& trials, const training::SiteSet& set, const std::string& what) {
  if (trials.shown == 0) return {};
  std::vector<Cells> rows;
  for (const training::SiteFelt& site : trials.felt) {
    rows.push_back({siteName(set, site.site), trf("{} of {}", site.felt, site.trials), formatDecimals(site.presses, 2),
                    formatDecimals(site.dwell_s, 2), formatDecimals(site.peak_force_n, 2),
                    formatDecimals(site.greatest_force_n, 2), formatDecimals(site.deepest_mm, 1)});
  }
  return foldedHtml(trf("Each site: {}", what),
                    tableOf("numbers",
                            {tr("site"), tr("felt in trials"), tr("presses a trial"), tr("time a trial (s)"),
                             tr("mean peak force (N)"), tr("greatest force (N)"), tr("deepest (mm)")},
                            rows));
}

std::string measuresTable(const TrialStatistics& tests, const TrialStatistics& practice, bool of_touch) {
  std::vector<Cells> rows;
  for (const training::TrialMeasure& each : training::trialMeasures()) {
    if (each.of_touch != of_touch) continue;
    rows.push_back({tr(each.words), formatSpread(tests.*each.spread, each.decimals),
                    formatSpread(practice.*each.spread, each.decimals)});
  }
  return tableOf("numbers", {tr("median (middle half) of trials"), tr("tests"), tr("practice")}, rows);
}

std::string answersTable(const TrialStatistics& trials, const std::string& what) {
  if (trials.counted == 0) return {};
  const int sites = trials.answers.sites;
  Cells head = {tr("true site")};
  for (int answer = 1; answer <= sites; ++answer) head.push_back(fmt::format("{}", answer));
  head.emplace_back(tr("none"));
  std::vector<Cells> rows;
  for (int truth = 1; truth <= sites; ++truth) {
    rows.push_back({fmt::format("{}", truth)});
    for (int answer = 1; answer <= sites; ++answer)
      rows.back().push_back(fmt::format("{}", trials.answers.at(truth, answer)));
    rows.back().push_back(fmt::format("{}", trials.answers.at(truth, 0)));
  }
  const training::WrongAnswers& wrong = trials.wrong;
  const std::string where =
      trf("Of {} wrong answers in {}, {} named the neighbouring level on the same side, {} the same level on the other "
          "side, {} another place, {} none in time.",
          trials.counted - trials.correct, what, wrong.beside, wrong.other_side, wrong.elsewhere, wrong.none);
  return paragraphHtml(where) + foldedHtml(trf("Counts: {}", what), tableOf("numbers", head, rows));
}

std::string qualitySection(const TrainingReport& report) {
  std::string html = headingHtml(tr("Data quality"));
  const training::TrainingStatistics& statistics = report.statistics;
  html += checksTable(statistics.all.tests, statistics.all.practice);
  training::Reasons excluded;
  int changed = 0;
  for (const TraineeStatistics& trainee : statistics.trainees) {
    for (const auto& [reason, count] : trainee.excluded) excluded[reason] += count;
    changed += trainee.changed_results;
  }
  if (!excluded.empty()) html += paragraphHtml(trf("Left out, with the reason: {}.", formatReasonCounts(excluded)));
  html += paragraphHtml(changed == 0 ? tr("Every stored result matches its trials.")
                                     : trf("{} stored results do not match their trials: the record was changed, or "
                                           "written by another version.",
                                           changed));
  if (!report.of_class) html += sessionsTable(statistics.trainees.front());
  std::vector<Cells> protocols;
  for (const training::ProtocolRow& row : report.record.protocols) {
    protocols.push_back({row.id, fmt::format("{}", row.version), row.sha256});
  }
  if (!protocols.empty())
    html += tableOf("words", {tr("protocol"), tr("version"), tr("SHA-256 of its settings")}, protocols);
  return html;
}

std::string foldedHtml(const std::string& heading, const std::string& html) {
  return "<details>" + htmlElement("summary", heading) + html + "</details>\n";
}

}  // namespace palpate::app

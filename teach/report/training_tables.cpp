#include "teach/report/training_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "report/recording/report_html.h"

namespace palpate::app {

namespace {

using training::Spread;
using training::ThresholdPoint;
using training::TraineeStatistics;
using training::TrialStatistics;

constexpr std::string_view kNoValue = "–";
/// More sessions than this are counted, not listed.
constexpr std::size_t kMaxSittings = 60;

std::string shareWords(double share) { return fmt::format("{:.1f} %", 100.0 * share); }

std::string joinedWords(const std::set<std::string>& words) {
  std::string list;
  for (const std::string& word : words) {
    if (!word.empty()) list += (list.empty() ? "" : "; ") + word;
  }
  return list;
}

std::string reasonsWords(const training::Reasons& reasons) {
  std::string words;
  for (const auto& [reason, count] : reasons)
    words += fmt::format("{}{}: {}", words.empty() ? "" : ", ", reason, count);
  return words;
}

std::string verdictWords(training::Verdict verdict) {
  switch (verdict) {
    case training::Verdict::pass:
      return "pass";
    case training::Verdict::not_yet:
      return "not yet";
    case training::Verdict::repeat:
      return "repeat";
    case training::Verdict::none:
      break;
  }
  return std::string(kNoValue);
}

std::string methodWords(training::Method method) {
  switch (method) {
    case training::Method::marginal_psi:
      return "adaptive levels";
    case training::Method::two_down_one_up:
      return "staircase levels";
    case training::Method::mastery:
      return "mastery, 3 of 4";
    case training::Method::constant_levels:
      break;
  }
  return "fixed levels";
}

std::string resultWords(const ThresholdPoint& point) {
  if (point.threshold) return thresholdWords(point.threshold->median, point.threshold->low, point.threshold->high);
  if (point.method == training::Method::mastery) {
    return point.level ? fmt::format("level {}", changeWords(*point.level)) : "no level yet";
  }
  return "too few answers";
}

/// median (middle half)
std::string spreadWords(const Spread& spread, int decimals) {
  if (spread.count == 0) return std::string(kNoValue);
  return fmt::format("{:.{}f} ({:.{}f} to {:.{}f})", spread.median, decimals, spread.lower_quartile, decimals,
                     spread.upper_quartile, decimals);
}

std::string siteName(const training::SiteSet& set, int number) {
  const training::Site* site = set.numbered(number);
  return site == nullptr ? fmt::format("{}", number) : fmt::format("{}: {}", number, site->label);
}

Cells spreadRow(const std::string& what, const Spread& tests, const Spread& practice, int decimals) {
  return {what, spreadWords(tests, decimals), spreadWords(practice, decimals)};
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
      made.meanings.insert(std::string(wordFor(point.meaning)));
      made.protocols.insert(fmt::format("{} version {}", point.protocol_id, point.protocol_version));
    }
  }
  return made;
}

std::string eventsWords(const training::SessionQuality& session) {
  std::string words;
  for (const auto& [kind, count] : session.events) {
    if (kind == "block" || kind == "screen") continue;  // of the ordinary course
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", count, kind);
  }
  return words.empty() ? std::string(kNoValue) : words;
}

std::string sessionsTable(const TraineeStatistics& trainee) {
  std::vector<Cells> rows;
  for (const training::SessionQuality& session : trainee.sessions) {
    if (rows.size() == kMaxSittings) break;
    const training::SessionRow& row = session.row;
    rows.push_back({dayWords(row.start_ms), std::string(wordFor(row.kind)), row.device, row.app_version,
                    row.end_ms == 0 ? "not ended" : "ended", eventsWords(session),
                    row.file.empty() ? "none" : row.file});
  }
  return tableOf("words", {"day", "kind", "device and thimble", "version", "", "events", "recording"}, rows);
}

void addCheck(std::vector<Cells>& rows, std::string what, const TrialStatistics& tests, const TrialStatistics& practice,
              int TrialStatistics::*count) {
  rows.push_back({std::move(what), fmt::format("{}", tests.*count), fmt::format("{}", practice.*count)});
}

std::string checksTable(const TrialStatistics& tests, const TrialStatistics& practice) {
  std::vector<Cells> rows;
  addCheck(rows, "trials shown", tests, practice, &TrialStatistics::shown);
  addCheck(rows, "warm-up, not counted", tests, practice, &TrialStatistics::warm_up);
  addCheck(rows, "left out", tests, practice, &TrialStatistics::excluded);
  addCheck(rows, "counted", tests, practice, &TrialStatistics::counted);
  addCheck(rows, "no answer in time", tests, practice, &TrialStatistics::timeouts);
  addCheck(rows, "not all places felt", tests, practice, &TrialStatistics::not_all_felt);
  addCheck(rows, "easy trials (lapse check)", tests, practice, &TrialStatistics::easy);
  addCheck(rows, "of them wrong", tests, practice, &TrialStatistics::easy_wrong);
  return tableOf("numbers", {"", "tests", "practice"}, rows);
}

}  // namespace

std::string trainingFacts(const TrainingReport& report) {
  const MadeWith made = madeWith(report);
  std::string html = "<div class=\"wide\"><table class=\"facts\"><tbody>\n";
  html += factRow("Class", report.class_words);
  if (report.of_class) html += factRow("Trainees", fmt::format("{}", report.statistics.trainees.size()));
  if (made.first_ms > 0) {
    const std::string first = dayWords(made.first_ms);
    const std::string last = dayWords(made.last_ms);
    html += factRow("Days", first == last ? first : first + " to " + last);
  }
  html += factRow("Device", joinedWords(made.devices));
  html += factRow("Change of", joinedWords(made.meanings));
  html += factRow("Protocol", joinedWords(made.protocols));
  html += factRow("Recorded by", made.versions.empty() ? "" : joinedWords(made.versions));
  html += factRow("Records", report.file.filename().string());
  return html + "</tbody></table></div>\n";
}

std::string blocksTable(const TraineeStatistics& trainee) {
  std::vector<Cells> rows;
  for (const ThresholdPoint& point : trainee.points) {
    const auto filtered = std::ranges::find_if(trainee.curve, [&](const training::FilteredPoint& each) {
      return trainee.points[each.point].block == point.block;
    });
    rows.push_back({occasionWords(point.kind, point.nth), dayWords(point.start_ms), methodWords(point.method),
                    fmt::format("{} of {}", point.trials.correct, point.trials.counted), resultWords(point),
                    filtered == trainee.curve.end()
                        ? std::string(kNoValue)
                        : thresholdWords(filtered->filtered.median, filtered->filtered.low, filtered->filtered.high),
                    verdictWords(point.verdict), fmt::format("{:.1f}", point.trials.places_felt.mean),
                    fmt::format("{:.0f}", point.trials.seconds.median), point.finished ? "" : "interrupted"});
  }
  return tableOf("numbers",
                 {"block", "day", "method", "right", "by itself (95 %)", "so far (95 %)", "verdict", "places felt",
                  "time (s)", ""},
                 rows);
}

std::string fitsTable(const TraineeStatistics& trainee) {
  std::vector<Cells> rows;
  for (const ThresholdPoint& point : trainee.points) {
    if (!point.threshold) continue;
    rows.push_back({occasionWords(point.kind, point.nth), dayWords(point.start_ms), resultWords(point),
                    fmt::format("{:.2f}", point.slope), shareWords(point.lapse), fmt::format("{}", point.choices),
                    fmt::format("{}", point.trials.counted)});
  }
  if (rows.empty()) return {};
  return tableOf("numbers",
                 {"block", "day", "smallest change (95 %)", "slope", "lapse rate", "places asked about", "answers"},
                 rows);
}

std::string occasionsTable(const training::ClassStatistics& all) {
  std::vector<Cells> rows;
  for (const training::Occasion& occasion : all.occasions) {
    const bool known = occasion.group.people >= 2;
    rows.push_back(
        {occasionWords(occasion.kind, occasion.nth), fmt::format("{}", occasion.medians.count),
         known ? thresholdWords(occasion.group.mean, occasion.group.low, occasion.group.high) : std::string(kNoValue),
         known ? changeWords(occasion.group.sd) : std::string(kNoValue), changeWords(occasion.medians.lower_quartile),
         changeWords(occasion.medians.median), changeWords(occasion.medians.upper_quartile),
         reasonsWords(occasion.verdicts)});
  }
  if (rows.empty()) return {};
  return tableOf("numbers",
                 {"occasion", "trainees", "mean smallest change of the group (95 %)", "SD between trainees",
                  "lower quartile", "median", "upper quartile", "verdicts"},
                 rows);
}

std::string traineesTable(const training::TrainingStatistics& statistics) {
  std::vector<Cells> rows;
  for (const TraineeStatistics& trainee : statistics.trainees) {
    const ThresholdPoint* latest = trainee.latest();
    std::string change(kNoValue);
    if (trainee.compared) {
      const training::TestsCompared& compared = *trainee.compared;
      change = compared.why_not            ? "not compared"
               : !compared.change.clear    ? "too early to call"
               : compared.change.ratio < 1 ? fmt::format("better, {:.2f} times", compared.change.ratio)
                                           : fmt::format("worse, {:.2f} times", compared.change.ratio);
    }
    const int shown = trainee.tests.shown + trainee.practice.shown;
    const int left_out = trainee.tests.excluded + trainee.practice.excluded;
    rows.push_back({shortPseudonym(trainee.id), fmt::format("{}", trainee.points.size()), fmt::format("{}", shown),
                    latest == nullptr ? std::string(kNoValue) : occasionWords(latest->kind, latest->nth),
                    latest == nullptr ? std::string(kNoValue) : resultWords(*latest), change,
                    fmt::format("{}", left_out),
                    fmt::format("{} of {}", trainee.tests.easy_wrong, trainee.tests.easy)});
  }
  return tableOf("numbers",
                 {"trainee", "blocks", "trials", "latest", "smallest change (95 %)", "since the first test", "left out",
                  "easy ones wrong"},
                 rows);
}

std::string levelsTable(const TrialStatistics& trials, const std::string& what) {
  if (trials.levels.empty()) return {};
  std::vector<Cells> rows;
  for (const training::LevelAccuracy& level : trials.levels) {
    rows.push_back({changeWords(level.change), fmt::format("{}", level.trials), fmt::format("{}", level.correct),
                    shareWords(level.share),
                    fmt::format("{} to {}", shareWords(level.interval.low), shareWords(level.interval.high)),
                    shareWords(level.chance), shareWords(level.corrected)});
  }
  return foldedHtml(
      "Each change: " + what,
      tableOf("numbers", {"change", "answers", "right", "share", "95 %", "by chance", "corrected for chance"}, rows));
}

std::string sitesTable(const TrialStatistics& trials, const training::SiteSet& set, const std::string& what) {
  if (trials.shown == 0) return {};
  std::vector<Cells> rows;
  for (const training::SiteFelt& site : trials.felt) {
    rows.push_back({siteName(set, site.site), fmt::format("{} of {}", site.felt, site.trials),
                    fmt::format("{:.2f}", site.presses), fmt::format("{:.2f}", site.dwell_s),
                    fmt::format("{:.2f}", site.peak_force_n), fmt::format("{:.2f}", site.greatest_force_n),
                    fmt::format("{:.1f}", site.deepest_mm)});
  }
  return foldedHtml("Each site: " + what, tableOf("numbers",
                                                  {"site", "felt in trials", "presses a trial", "time a trial (s)",
                                                   "mean peak force (N)", "greatest force (N)", "deepest (mm)"},
                                                  rows));
}

std::string handlingTable(const TrialStatistics& tests, const TrialStatistics& practice) {
  return tableOf("numbers", {"median (middle half) of trials", "tests", "practice"},
                 {spreadRow("mean force while searching (N)", tests.search_force_n, practice.search_force_n, 2),
                  spreadRow("mean force while palpating (N)", tests.palpate_force_n, practice.palpate_force_n, 2),
                  spreadRow("mean force in contact (N)", tests.mean_force_n, practice.mean_force_n, 2),
                  spreadRow("peak force (N)", tests.peak_force_n, practice.peak_force_n, 2),
                  spreadRow("mean speed (mm/s)", tests.speed_mm_per_s, practice.speed_mm_per_s, 0)});
}

std::string secondsTable(const TrialStatistics& tests, const TrialStatistics& practice) {
  return tableOf("numbers", {"median (middle half) of trials", "tests", "practice"},
                 {spreadRow("time (s)", tests.seconds, practice.seconds, 1),
                  spreadRow("time of right answers (s)", tests.seconds_correct, practice.seconds_correct, 1),
                  spreadRow("time of wrong answers (s)", tests.seconds_wrong, practice.seconds_wrong, 1),
                  spreadRow("places felt", tests.places_felt, practice.places_felt, 0)});
}

std::string answersTable(const TrialStatistics& trials, const std::string& what) {
  if (trials.counted == 0) return {};
  const int sites = trials.answers.sites;
  Cells head = {"true site"};
  for (int answer = 1; answer <= sites; ++answer) head.push_back(fmt::format("{}", answer));
  head.emplace_back("none");
  std::vector<Cells> rows;
  for (int truth = 1; truth <= sites; ++truth) {
    rows.push_back({fmt::format("{}", truth)});
    for (int answer = 1; answer <= sites; ++answer)
      rows.back().push_back(fmt::format("{}", trials.answers.at(truth, answer)));
    rows.back().push_back(fmt::format("{}", trials.answers.at(truth, 0)));
  }
  const training::WrongAnswers& wrong = trials.wrong;
  const std::string where = fmt::format(
      "Of {} wrong answers in {}, {} named the level beside on the same side, {} the same level on the other side, {} "
      "another place, {} none in time.",
      trials.counted - trials.correct, what, wrong.beside, wrong.other_side, wrong.elsewhere, wrong.none);
  return elementOf("p", where) + "\n" + foldedHtml("Counts: " + what, tableOf("numbers", head, rows));
}

std::string qualitySection(const TrainingReport& report) {
  std::string html = "<h2>Data quality</h2>\n";
  const training::TrainingStatistics& statistics = report.statistics;
  html += checksTable(statistics.all.tests, statistics.all.practice);
  training::Reasons excluded;
  int changed = 0;
  for (const TraineeStatistics& trainee : statistics.trainees) {
    for (const auto& [reason, count] : trainee.excluded) excluded[reason] += count;
    changed += trainee.changed_results;
  }
  if (!excluded.empty()) html += elementOf("p", "Left out, with the reason: " + reasonsWords(excluded) + ".") + "\n";
  html += elementOf("p", changed == 0 ? "Every stored result is the one that its trials give."
                                      : fmt::format("{} stored results are not what their trials give: the record was "
                                                    "changed, or written by another version.",
                                                    changed)) +
          "\n";
  if (!report.of_class) html += sessionsTable(statistics.trainees.front());
  std::vector<Cells> protocols;
  for (const training::ProtocolRow& row : report.record.protocols) {
    protocols.push_back({row.id, fmt::format("{}", row.version), row.sha256});
  }
  if (!protocols.empty()) html += tableOf("words", {"protocol", "version", "SHA-256 of its settings"}, protocols);
  return html;
}

std::string foldedHtml(const std::string& heading, const std::string& html) {
  return "<details>" + elementOf("summary", heading) + html + "</details>\n";
}

}  // namespace palpate::app

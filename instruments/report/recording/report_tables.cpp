#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "palpate/base/language.h"
#include "palpate/body/places.h"
#include "report/page/study_page.h"
#include "report/recording/report_html.h"

namespace palpate::app {

namespace {

using study::counted;
using study::percent;
using study::rounded;
using trace::Measured;

/// More rows would not be read.
constexpr std::size_t kMaxRows = 60;

std::string fingerName(const RecordingReport& report, std::size_t finger) { return report.facts.fingers[finger].name; }

std::string quietLine(const std::string& words) { return fmt::format("<p class=\"quiet\">{}</p>\n", words); }

std::string moreContacts(std::uint64_t all, std::size_t shown) {
  if (all <= shown) return {};
  const std::string more = counted(static_cast<double>(all - shown));
  return quietLine(
      all <= trace::kMaxListed
          ? trf("{} more contacts are not shown here; --from and --to choose a part, --json lists all.", more)
          : trf("{} more contacts are not shown here; --from and --to choose a part, --json lists the first {}.", more,
                counted(trace::kMaxListed)));
}

std::string phaseTimes(const RecordingReport& report) {
  std::vector<Cells> rows;
  for (std::size_t f = 0; f < report.statistics.fingers.size(); ++f) {
    const trace::FingerStatistics& finger = report.statistics.fingers[f];
    std::uint64_t all = 0;
    for (const std::uint64_t ticks : finger.phase_ticks) all += ticks;
    if (all == 0) continue;
    for (const trace::Phase phase : {trace::Phase::search, trace::Phase::palpation, trace::Phase::away}) {
      const auto i = static_cast<std::size_t>(phase);
      rows.push_back({fmt::format("{}: {}", fingerName(report, f), phaseWord(phase)),
                      counted(static_cast<double>(finger.phases[i])),
                      formatFixed(report.statistics.seconds(finger.phase_ticks[i]), 2),
                      percent(static_cast<double>(finger.phase_ticks[i]) / static_cast<double>(all))});
    }
  }
  return rows.empty() ? "" : tableOf("numbers", {"", tr("times"), tr("total (s)"), tr("share of its time")}, rows);
}

/// The longest ones, in the order of time.
std::string longestPhases(const RecordingReport& report) {
  constexpr std::size_t kMaxPhases = 20;
  std::vector<trace::PhaseSpan> spans = report.statistics.phases;
  std::erase_if(spans, [](const trace::PhaseSpan& span) { return span.phase == trace::Phase::away; });
  const std::size_t all = spans.size();
  std::stable_sort(spans.begin(), spans.end(), [](const auto& a, const auto& b) { return a.ticks() > b.ticks(); });
  if (spans.size() > kMaxPhases) spans.erase(spans.begin() + kMaxPhases, spans.end());
  std::stable_sort(spans.begin(), spans.end(),
                   [](const auto& a, const auto& b) { return a.first_tick < b.first_tick; });
  std::vector<Cells> rows;
  for (const trace::PhaseSpan& span : spans) {
    rows.push_back({fingerName(report, span.finger), std::string(phaseWord(span.phase)),
                    formatFixed(report.secondsAt(span.first_tick), 2),
                    formatFixed(report.statistics.seconds(span.ticks()), 2)});
  }
  if (rows.empty()) return {};
  return paragraphHtml(all > kMaxPhases ? trf("The {} longest phases on the skin of {}:", kMaxPhases,
                                              counted(static_cast<double>(all)))
                                        : std::string(tr("All phases on the skin:"))) +
         tableOf("numbers", {tr("finger"), tr("phase"), tr("begin (s)"), tr("length (s)")}, rows);
}

std::string bitsTable(const RecordingReport& report, const std::vector<StatusLine>& lines) {
  std::vector<Cells> rows;
  for (const StatusLine& line : lines) {
    rows.push_back({fingerName(report, line.finger), line.name, std::string(line.meaning),
                    counted(static_cast<double>(line.tally.times)),
                    formatFixed(report.statistics.seconds(line.tally.ticks), 3),
                    formatFixed(report.secondsAt(line.tally.first_tick), 3)});
  }
  return tableOf("words",
                 {tr("finger"), tr("what"), tr("which means"), tr("times"), tr("total (s)"), tr("first at (s)")}, rows);
}

}  // namespace

std::string sizesTable(const RecordingReport& report) {
  struct Quantity {
    Measured measured;
    const char* name;
    int decimals;
  };
  constexpr std::array kQuantities = {Quantity{Measured::force, toTranslate("force (N)"), 2},
                                      Quantity{Measured::depth, toTranslate("depth (mm)"), 2},
                                      Quantity{Measured::proxy_speed, toTranslate("speed over the skin (mm/s)"), 1},
                                      Quantity{Measured::tip_speed, toTranslate("speed of the tip (mm/s)"), 1}};
  std::vector<Cells> rows;
  for (std::size_t f = 0; f < report.statistics.fingers.size(); ++f) {
    for (const auto& [measured, name, decimals] : kQuantities) {
      const trace::FixedHistogram& histogram = report.statistics.fingers[f].of(measured);
      if (histogram.count() == 0) continue;
      rows.push_back({fmt::format("{}: {}", fingerName(report, f), tr(name)), formatFixed(histogram.mean(), decimals),
                      formatFixed(histogram.quantile(0.5), decimals), formatFixed(histogram.quantile(0.95), decimals),
                      formatFixed(histogram.greatest(), decimals)});
    }
  }
  if (rows.empty()) return {};
  return paragraphHtml(tr("While in contact:")) +
         tableOf("numbers", {"", tr("mean"), tr("median"), tr("95 % are below"), tr("largest")}, rows);
}

std::string phasesSection(const RecordingReport& report) {
  const std::string times = phaseTimes(report);
  return times.empty() ? times : headingHtml(tr("Search and palpation")) + times + longestPhases(report);
}

std::string contactsSection(const RecordingReport& report) {
  std::string html = headingHtml(tr("Contacts"));
  if (report.statistics.contact_count == 0) return html + paragraphHtml(tr("No finger touched the skin."));
  std::vector<trace::Contact> contacts = report.statistics.contacts;
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const auto& a, const auto& b) { return a.first_tick < b.first_tick; });
  if (contacts.size() > kMaxRows) contacts.erase(contacts.begin() + kMaxRows, contacts.end());
  const bool has_names = !report.body.landmarks.empty();
  std::vector<Cells> rows;
  for (const trace::Contact& contact : contacts) {
    const Vec3& place = contact.peak_place;
    rows.push_back(
        {fingerName(report, contact.finger), formatFixed(report.secondsAt(contact.first_tick), 3),
         formatFixed(report.statistics.seconds(contact.ticks()), 3), formatFixed(contact.peak_force_n, 2),
         formatFixed(contact.mean_force_n, 2), formatFixed(contact.peak_depth_mm, 2), formatFixed(contact.path_mm, 1),
         fmt::format("{}, {}, {}", formatFixed(place.x(), 1), formatFixed(place.y(), 1), formatFixed(place.z(), 1))});
    if (has_names) rows.back().push_back(body::describePlace(report.body.landmarks, place));
  }
  Cells head = {tr("finger"),
                tr("begin (s)"),
                tr("length (s)"),
                tr("peak force (N)"),
                tr("mean force (N)"),
                tr("peak depth (mm)"),
                tr("path on the skin (mm)"),
                tr("place of the peak force: x, y, z (mm)")};
  if (has_names) head.emplace_back(tr("which is"));
  html += tableOf("numbers", head, rows);
  return html + moreContacts(report.statistics.contact_count, rows.size());
}

std::string safetySection(const RecordingReport& report) {
  std::string html = headingHtml(tr("Safety"));
  html += paragraphHtml(trf("Emergency stops: {}.", emergencyStops(report)));
  const std::vector<StatusLine> safety = safetyLines(report);
  html += safety.empty() ? paragraphHtml(tr("The safety limits never had to act."))
                         : paragraphHtml(tr("Actions of the safety limits:")) + bitsTable(report, safety);
  const std::vector<StatusLine> contact = contactLines(report);
  if (!contact.empty()) html += paragraphHtml(tr("What the contact reported:")) + bitsTable(report, contact);
  return html;
}

std::string servoSection(const RecordingReport& report) {
  const trace::RecordedTicks& ticks = report.statistics.ticks;
  if (ticks.recorded == 0) return {};
  std::vector<Cells> rows = {{tr("ticks expected, first to last"), counted(static_cast<double>(ticks.expected()))},
                             {tr("recorded"), counted(static_cast<double>(ticks.recorded))},
                             {tr("missing"), fmt::format("{} ({})", counted(static_cast<double>(ticks.missing())),
                                                         percent(static_cast<double>(ticks.missing()) /
                                                                 static_cast<double>(ticks.expected())))},
                             {tr("gaps"), counted(static_cast<double>(ticks.gaps))}};
  if (ticks.gaps > 0) {
    rows.push_back({tr("longest gap"),
                    trf("{} ms, at {:.3f} s", rounded(1000.0 * report.statistics.seconds(ticks.longest_gap.missing), 3),
                        report.secondsAt(ticks.longest_gap.after_tick))});
  }
  rows.push_back({tr("samples dropped on their way to the file, in the whole recording"),
                  counted(static_cast<double>(report.facts.dropped))});
  if (ticks.out_of_order > 0) {
    rows.push_back({tr("ticks out of order, left out here"), counted(static_cast<double>(ticks.out_of_order))});
  }
  return headingHtml(tr("The loop and its record")) + tableOf("numbers", {}, rows) +
         quietLine(tr("A missing tick is one that the loop did not reach in time, or whose sample was dropped."));
}

std::string eventsSection(const RecordingReport& report) {
  if (report.events.empty()) return {};
  std::vector<Cells> rows;
  for (const trace::RecordingEvent& event : report.events) {
    if (rows.size() == kMaxRows) break;
    const bool known = event.finger && *event.finger < report.facts.fingers.size();
    rows.push_back({formatFixed(report.secondsAt(event.tick), 3), known ? fingerName(report, *event.finger) : "",
                    event.kind, event.text});
  }
  std::string html = headingHtml(tr("Events and marks")) +
                     tableOf("words", {tr("at (s)"), tr("finger"), tr("kind"), tr("text")}, rows);
  if (report.events.size() > rows.size()) {
    html += quietLine(trf("{} more are not shown here; --json lists all.",
                          counted(static_cast<double>(report.events.size() - rows.size()))));
  }
  return html;
}

}  // namespace palpate::app

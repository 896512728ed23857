// Every text that is not ours passes escaped() once, on its way into an element; nothing else makes markup. Own.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/palpate/session/report_figures.h"
#include "apps/palpate/session/session_report.h"
#include "study/page/study_page.h"
#include "study/report/report_html.h"

namespace palpate::app {

namespace {

using study::counted;
using study::percent;
using study::rounded;
using trace::Measured;

/// Screen and paper, light; system fonts only, nothing from elsewhere.
constexpr std::string_view kPageStyle = R"css(
:root { color-scheme: light; --ink: #222; --quiet: #5d6470; --line: #dfe3e8; --wash: #f5f7f9; --accent: #0072b2; }
* { box-sizing: border-box; }
body { margin: 0; color: var(--ink); background: #fff;
  font: 16px/1.5 system-ui, "Segoe UI", "Helvetica Neue", "DejaVu Sans", sans-serif; }
main { max-width: 66rem; margin: 0 auto; padding: 2.5rem 1.5rem 4rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 0.3rem; overflow-wrap: anywhere; }
h2 { font-size: 1.3rem; margin: 2.5rem 0 0.6rem; padding-top: 1.2rem; border-top: 1px solid var(--line); }
p { max-width: 50rem; }
.quiet { color: var(--quiet); }
.summary { margin: 1.2rem 0; padding: 0.9rem 1.2rem 0.9rem 2.2rem; background: var(--wash);
  border-left: 4px solid var(--accent); border-radius: 0 6px 6px 0; }
.summary li { margin: 0.4rem 0; overflow-wrap: anywhere; }
figure { margin: 1.2rem 0; }
figure img { display: block; max-width: 100%; height: auto; margin: 0 auto; }
figcaption { color: var(--quiet); font-size: 0.9rem; margin: 0.4rem auto 0; max-width: 50rem; }
.wide { overflow-x: auto; margin: 0.6rem 0 1.2rem; }
table { border-collapse: collapse; font-size: 0.9rem; line-height: 1.35; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: 0.3rem 0.8rem 0.3rem 0; border-bottom: 1px solid var(--line); }
th { font-weight: 600; vertical-align: bottom; }
.numbers th + th, .numbers td + td { text-align: right; padding-left: 0.8rem; padding-right: 0; }
.facts th { width: 9rem; }
.facts td, .words td { white-space: pre-wrap; overflow-wrap: anywhere; }
dt { font-weight: 600; margin-top: 0.6rem; }
dd { margin: 0 0 0 1.2rem; max-width: 48rem; }
@media print {
  @page { margin: 16mm; }
  body { font-size: 10pt; }
  main { max-width: none; padding: 0; }
  figure, tr, .summary li, dt, dd { break-inside: avoid; }
  h2, dt { break-after: avoid; }
  .wide { overflow: visible; }
  table { font-size: 8.5pt; }
}
)css";

/// More rows are no table that anybody reads.
constexpr std::size_t kMostRows = 60;

std::string escaped(std::string_view text) {
  std::string html;
  for (const char letter : readableText(text)) {
    switch (letter) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += letter;
    }
  }
  return html;
}

std::string elementOf(std::string_view tag, std::string_view text) {
  return fmt::format("<{0}>{1}</{0}>", tag, escaped(text));
}

using Cells = std::vector<std::string>;

std::string rowOf(std::string_view tag, const Cells& cells) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) html += elementOf(tag, cell);
  return html + "</tr>\n";
}

/// `kind`: numbers (all columns but the first stand right) or words.
std::string tableOf(std::string_view kind, const Cells& headings, const std::vector<Cells>& rows) {
  std::string html = fmt::format("<div class=\"wide\"><table class=\"{}\">", kind);
  if (!headings.empty()) html += "<thead>" + rowOf("th", headings) + "</thead>";
  html += "<tbody>\n";
  for (const Cells& row : rows) html += rowOf("td", row);
  return html + "</tbody></table></div>\n";
}

std::string more(std::uint64_t all, std::size_t shown, std::string_view things) {
  if (all <= shown) return {};
  return fmt::format(
      "<p class=\"quiet\">{} more {} are not shown here; --from and --to choose a part, --json lists {}.</p>\n",
      counted(static_cast<double>(all - shown)), things,
      all <= trace::kMostListed ? "all" : fmt::format("the first {}", counted(trace::kMostListed)));
}

std::string fingerName(const SessionReport& report, std::size_t finger) { return report.facts.fingers[finger].name; }

// ---- facts

std::string factRow(std::string_view name, std::string_view value) {
  return value.empty() ? std::string() : fmt::format("<tr>{}{}</tr>\n", elementOf("th", name), elementOf("td", value));
}

/// 2026-11-21T18:45:00Z -> 2026-11-21 18:45:00 UTC
std::string momentWords(std::string moment) {
  const bool common = moment.size() == 20 && moment[10] == 'T' && moment[19] == 'Z';
  return common ? moment.substr(0, 10) + " " + moment.substr(11, 8) + " UTC" : moment;
}

std::string lengthWords(const SessionReport& report) {
  const trace::RecordedTicks& ticks = report.statistics.ticks;
  std::string text = durationWords(report.facts.seconds());
  if (!report.whole && ticks.recorded > 0) {
    text += fmt::format("; this report is of {:.2f} s to {:.2f} s", report.secondsAt(ticks.first),
                        report.secondsAt(ticks.last + 1));
  }
  return text + fmt::format("; {} ticks a second", rounded(report.statistics.ticks_per_s, 4));
}

std::string bodyWords(const SessionReport& report) {
  std::vector<std::string> names;
  for (const std::string& body : report.bodies) {
    if (std::find(names.begin(), names.end(), body) == names.end()) names.push_back(body);
  }
  std::string words;
  for (const std::string& name : names) words += (words.empty() ? "" : ", ") + name;
  if (report.statistics.world_changes > 0) {
    words += fmt::format("; changed {} times (body, stiffness or settings)", report.statistics.world_changes);
  }
  return words;
}

std::string factsTable(const SessionReport& report) {
  const trace::SessionFacts& facts = report.facts;
  std::string html = "<div class=\"wide\"><table class=\"facts\"><tbody>\n";
  html += factRow("Begun", momentWords(facts.header.started_utc));
  html += factRow("Ended", facts.ended_by.empty() ? "no end: it is being written, or its program was killed"
                                                  : momentWords(facts.ended_utc) + ", by: " + facts.ended_by);
  html += factRow("Length", lengthWords(report));
  for (const trace::SessionFinger& finger : facts.fingers) {
    const bool scripted = finger.device == finger.name;  // a script is named like its finger
    html += factRow("Finger", scripted ? finger.name : finger.name + ", held by " + finger.device);
  }
  html += factRow("Body", bodyWords(report));
  html += factRow("Notes", facts.header.notes);
  html += factRow("Tags", facts.header.tags);
  html += factRow("Recorded by", facts.header.software + " on " + facts.header.machine);
  html += factRow("File", report.file.string());
  return html + "</tbody></table></div>\n";
}

// ---- pictures

/// Of SVG and PNG the smaller one: curves are small as SVG, surfaces as PNG.
std::string pictureData(const figures::Figure& figure) {
  constexpr double kPixels = 1.6;  // for a CSS pixel: sharp on screens and on paper
  const std::string png = figures::pngOf(figure, kPixels);
  const std::string svg = figures::svgOf(figure);
  return svg.size() <= png.size() ? "data:image/svg+xml;base64," + study::base64(svg)
                                  : "data:image/png;base64," + study::base64(png);
}

std::string picturesHtml(const std::vector<ReportPicture>& pictures, const Progress& progress) {
  std::string html;
  for (const ReportPicture& picture : pictures) {
    palpate::report(progress, "drawing " + picture.id, 0.0);
    if (!picture.heading.empty()) html += elementOf("h2", picture.heading) + "\n";
    html +=
        fmt::format("<figure id=\"{}\"><img alt=\"{}\" src=\"{}\" />{}</figure>\n", picture.id,
                    escaped(picture.caption), pictureData(picture.figure), elementOf("figcaption", picture.caption));
  }
  return html;
}

// ---- numbers

std::string sizesTable(const SessionReport& report) {
  struct Quantity {
    Measured measured;
    std::string_view name;
    int decimals;
  };
  constexpr std::array kQuantities = {Quantity{Measured::force, "force (N)", 2},
                                      Quantity{Measured::depth, "depth (mm)", 2},
                                      Quantity{Measured::proxy_speed, "speed over the skin (mm/s)", 1},
                                      Quantity{Measured::tip_speed, "speed of the tip (mm/s)", 1}};
  std::vector<Cells> rows;
  for (std::size_t f = 0; f < report.statistics.fingers.size(); ++f) {
    for (const auto& [measured, name, decimals] : kQuantities) {
      const trace::FixedHistogram& histogram = report.statistics.fingers[f].of(measured);
      if (histogram.count() == 0) continue;
      rows.push_back({fmt::format("{}: {}", fingerName(report, f), name), fixedWords(histogram.mean(), decimals),
                      fixedWords(histogram.quantile(0.5), decimals), fixedWords(histogram.quantile(0.95), decimals),
                      fixedWords(histogram.greatest(), decimals)});
    }
  }
  if (rows.empty()) return {};
  return "<p>While in contact:</p>\n" + tableOf("numbers", {"", "mean", "median", "95 % are below", "largest"}, rows);
}

std::string phasesTable(const SessionReport& report) {
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
                      fmt::format("{:.2f}", report.statistics.seconds(finger.phase_ticks[i])),
                      percent(static_cast<double>(finger.phase_ticks[i]) / static_cast<double>(all))});
    }
  }
  return rows.empty() ? "" : tableOf("numbers", {"", "times", "in all (s)", "share of its time"}, rows);
}

/// The longest ones, in the order of time.
std::string longestPhases(const SessionReport& report) {
  constexpr std::size_t kMostPhases = 20;
  std::vector<trace::PhaseSpan> spans = report.statistics.phases;
  std::erase_if(spans, [](const trace::PhaseSpan& span) { return span.phase == trace::Phase::away; });
  const std::size_t all = spans.size();
  std::stable_sort(spans.begin(), spans.end(), [](const auto& a, const auto& b) { return a.ticks() > b.ticks(); });
  if (spans.size() > kMostPhases) spans.erase(spans.begin() + kMostPhases, spans.end());
  std::stable_sort(spans.begin(), spans.end(),
                   [](const auto& a, const auto& b) { return a.first_tick < b.first_tick; });
  std::vector<Cells> rows;
  for (const trace::PhaseSpan& span : spans) {
    rows.push_back({fingerName(report, span.finger), std::string(phaseWord(span.phase)),
                    fmt::format("{:.2f}", report.secondsAt(span.first_tick)),
                    fmt::format("{:.2f}", report.statistics.seconds(span.ticks()))});
  }
  if (rows.empty()) return {};
  return elementOf("p", all > kMostPhases ? fmt::format("The {} longest phases on the skin of {}:", kMostPhases,
                                                        counted(static_cast<double>(all)))
                                          : std::string("All phases on the skin:")) +
         "\n" + tableOf("numbers", {"finger", "phase", "begin (s)", "length (s)"}, rows);
}

std::string contactsTable(const SessionReport& report) {
  std::string html = "<h2>Contacts</h2>\n";
  if (report.statistics.contact_count == 0) return html + "<p>No finger touched the skin.</p>\n";
  std::vector<trace::Contact> contacts = report.statistics.contacts;
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const auto& a, const auto& b) { return a.first_tick < b.first_tick; });
  if (contacts.size() > kMostRows) contacts.erase(contacts.begin() + kMostRows, contacts.end());
  std::vector<Cells> rows;
  for (const trace::Contact& contact : contacts) {
    const Vec3& place = contact.peak_place;
    rows.push_back(
        {fingerName(report, contact.finger), fmt::format("{:.3f}", report.secondsAt(contact.first_tick)),
         fmt::format("{:.3f}", report.statistics.seconds(contact.ticks())), fixedWords(contact.peak_force_n, 2),
         fixedWords(contact.mean_force_n, 2), fixedWords(contact.peak_depth_mm, 2), fixedWords(contact.path_mm, 1),
         fmt::format("{}, {}, {}", fixedWords(place.x(), 1), fixedWords(place.y(), 1), fixedWords(place.z(), 1))});
  }
  html += tableOf("numbers",
                  {"finger", "begin (s)", "length (s)", "peak force (N)", "mean force (N)", "peak depth (mm)",
                   "path on the skin (mm)", "place of the peak force: x, y, z (mm)"},
                  rows);
  return html + more(report.statistics.contact_count, rows.size(), "contacts");
}

std::string bitsTable(const SessionReport& report, const std::vector<StatusLine>& lines) {
  std::vector<Cells> rows;
  for (const StatusLine& line : lines) {
    rows.push_back({fingerName(report, line.finger), line.name, std::string(line.meaning),
                    counted(static_cast<double>(line.tally.times)),
                    fmt::format("{:.3f}", report.statistics.seconds(line.tally.ticks)),
                    fmt::format("{:.3f}", report.secondsAt(line.tally.first_tick))});
  }
  return tableOf("words", {"finger", "what", "which means", "times", "in all (s)", "first at (s)"}, rows);
}

std::string safetySection(const SessionReport& report) {
  std::string html = "<h2>Safety</h2>\n";
  html += elementOf("p", fmt::format("Emergency stops: {}.", emergencyStops(report))) + "\n";
  const std::vector<StatusLine> safety = safetyLines(report);
  html += safety.empty() ? "<p>The safety limits never had to act.</p>\n"
                         : "<p>What the safety limits did:</p>\n" + bitsTable(report, safety);
  const std::vector<StatusLine> contact = contactLines(report);
  if (!contact.empty()) html += "<p>What the contact told of itself:</p>\n" + bitsTable(report, contact);
  return html;
}

std::string servoSection(const SessionReport& report) {
  const trace::RecordedTicks& ticks = report.statistics.ticks;
  if (ticks.recorded == 0) return {};
  std::vector<Cells> rows = {
      {"ticks expected, first to last", counted(static_cast<double>(ticks.expected()))},
      {"recorded", counted(static_cast<double>(ticks.recorded))},
      {"missing", fmt::format("{} ({})", counted(static_cast<double>(ticks.missing())),
                              percent(static_cast<double>(ticks.missing()) / static_cast<double>(ticks.expected())))},
      {"gaps", counted(static_cast<double>(ticks.gaps))}};
  if (ticks.gaps > 0) {
    rows.push_back(
        {"longest gap",
         fmt::format("{} ms, at {:.3f} s", rounded(1000.0 * report.statistics.seconds(ticks.longest_gap.missing), 3),
                     report.secondsAt(ticks.longest_gap.after_tick))});
  }
  rows.push_back({"samples that found no room on their way to the file, in the whole recording",
                  counted(static_cast<double>(report.facts.dropped))});
  if (ticks.out_of_order > 0) {
    rows.push_back({"ticks out of order, left out here", counted(static_cast<double>(ticks.out_of_order))});
  }
  return "<h2>The loop and its record</h2>\n" + tableOf("numbers", {}, rows) +
         "<p class=\"quiet\">A missing tick is one that the loop did not reach in time, or whose sample was "
         "dropped.</p>\n";
}

std::string eventsSection(const SessionReport& report) {
  if (report.events.empty()) return {};
  std::vector<Cells> rows;
  for (const trace::SessionEvent& event : report.events) {
    if (rows.size() == kMostRows) break;
    const bool known = event.finger && *event.finger < report.facts.fingers.size();
    rows.push_back({fmt::format("{:.3f}", report.secondsAt(event.tick)), known ? fingerName(report, *event.finger) : "",
                    event.kind, event.text});
  }
  std::string html = "<h2>Events and marks</h2>\n" + tableOf("words", {"at (s)", "finger", "kind", "text"}, rows);
  if (report.events.size() > rows.size()) {
    html += fmt::format("<p class=\"quiet\">{} more are not shown here; --json lists all.</p>\n",
                        counted(static_cast<double>(report.events.size() - rows.size())));
  }
  return html;
}

// ---- the body

std::string bodySection(const SessionReport& report, const Progress& progress) {
  std::string html = picturesHtml(bodyPictures(report), progress);
  if (!report.body.why_not.empty()) {
    html += elementOf("p", report.body.why_not +
                               " So the map above is one of places only; --folder says where the "
                               "files of the body lie now.") +
            "\n";
  }
  for (const std::string& note : report.body.notes) html += elementOf("p", note) + "\n";
  if (!report.body.surface) return html;
  const trace::TouchedSurface& surface = *report.body.surface;
  const double share = surface.dorsal_mm2 > 0.0 ? surface.touched_dorsal_mm2 / surface.dorsal_mm2 : 0.0;
  html += tableOf("numbers", {},
                  {{"touched skin (mm²)", counted(surface.touched_mm2)},
                   {"the back (mm²)", counted(surface.dorsal_mm2)},
                   {"touched of the back (mm²)", counted(surface.touched_dorsal_mm2)},
                   {"share of the back that was touched", percent(share)}});
  if (surface.astray_ticks > 0 || report.statistics.places_left_out > 0) {
    html += elementOf("p", fmt::format("{} s of touch lie on no place of this skin and are left out.",
                                       rounded(report.statistics.seconds(surface.astray_ticks +
                                                                         report.statistics.places_left_out)))) +
            "\n";
  }
  return html;
}

// ---- definitions

std::string definitionsSection(const SessionReport& report) {
  std::string reach;
  for (std::size_t f = 0; f < report.body.reach_mm.size() && f < report.facts.fingers.size(); ++f) {
    reach +=
        fmt::format("{}{} {} mm", reach.empty() ? "" : ", ", fingerName(report, f), rounded(report.body.reach_mm[f]));
  }
  if (!reach.empty()) reach = " Here: " + reach + ".";
  const std::vector<std::pair<std::string, std::string>> definitions = {
      {"Force, depth",
       "The size of the force that the contact computed for the finger (the device may have been sent less: see "
       "Safety), "
       "and how deep the tip was under the skin at rest."},
      {"Speed",
       fmt::format(
           "The way of the last {} ms over that time: of the finger's place on the skin, and of the tip that the "
           "device held.",
           1000.0 * trace::kSpeedWindowS)},
      {"Contact",
       fmt::format(
           "A stretch of time in which the finger touches the skin; breaks up to {} ms do not end it. Means are "
           "over the ticks that touch. Its path is measured in steps of {} mm, so that trembling goes nowhere.",
           1000.0 * trace::kJoinedGapS, trace::kPathStepMm)},
      {"Search and palpation",
       fmt::format(
           "On the skin, a finger that presses with {} N or more and moves at {} mm/s or less palpates; one that "
           "is lighter or faster searches. A phase begins where this has held for {} s. These limits are this "
           "program's own; no norm has any.",
           trace::kLightForceN, trace::kDwellSpeedMmPerS, trace::kLeastPhaseS)},
      {"Touched skin",
       fmt::format(
           "All skin within the radius of the finger around the places where it was (at least {} mm), facing the "
           "same way. The back is the skin that leans less than 60 degrees from straight backwards.",
           trace::kLeastReachMm) +
           reach},
      {"Places",
       "Millimetres in the body's frame: x to the patient's right seen from behind, y to the head, z out of the back."},
      {"Limits",
       "All of it is what the program computed and what the device reported. It measures no skill and diagnoses "
       "nothing; "
       "Palpate is not a medical device."}};
  std::string html = "<h2>What the words mean</h2>\n<dl>\n";
  for (const auto& [word, meaning] : definitions) html += elementOf("dt", word) + elementOf("dd", meaning) + "\n";
  return html + "</dl>\n";
}

std::string pageHead(const SessionReport& report) {
  const std::string name = "Session " + report.file.filename().string();
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\" />\n{}\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n{}\n<style>{}</style>\n</head>\n"
      "<body>\n<main>\n{}\n",
      kReportMark, elementOf("title", name), kPageStyle, elementOf("h1", name));
  html += "<ul class=\"summary\">\n";
  for (const std::string& sentence : reportSentences(report)) html += elementOf("li", sentence) + "\n";
  return html + "</ul>\n";
}

}  // namespace

std::string reportPage(const SessionReport& report, const Progress& progress) {
  std::string html = pageHead(report) + factsTable(report);
  html += picturesHtml(coursePictures(report), progress);
  html += sizesTable(report);
  const std::string phases = phasesTable(report);
  if (!phases.empty()) html += "<h2>Search and palpation</h2>\n" + phases + longestPhases(report);
  html += bodySection(report, progress);
  html += contactsTable(report);
  html += safetySection(report) + servoSection(report) + eventsSection(report) + definitionsSection(report);
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace palpate::app

// The page from its summary to its definitions; its tables are in report_tables.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "palpate/base/language.h"
#include "report/page/study_page.h"
#include "report/recording/report_figures.h"
#include "report/recording/report_html.h"

namespace palpate::app {

namespace {

using study::counted;
using study::percent;
using study::rounded;

// ---- facts

/// 2026-11-21T18:45:00Z -> 2026-11-21 18:45:00 UTC
std::string formatTimestamp(std::string moment) {
  const bool common = moment.size() == 20 && moment[10] == 'T' && moment[19] == 'Z';
  return common ? moment.substr(0, 10) + " " + moment.substr(11, 8) + " UTC" : moment;
}

std::string describeLength(const RecordingReport& report) {
  const trace::RecordedTicks& ticks = report.statistics.ticks;
  std::string text = formatDuration(report.facts.seconds());
  if (!report.whole && ticks.recorded > 0) {
    text += trf("; this report is of {:.2f} s to {:.2f} s", report.secondsAt(ticks.first),
                report.secondsAt(ticks.last + 1));
  }
  return text + trf("; {} ticks a second", rounded(report.statistics.ticks_per_s, 4));
}

std::string describeBodies(const RecordingReport& report) {
  std::vector<std::string> names;
  for (const std::string& body : report.bodies) {
    if (std::find(names.begin(), names.end(), body) == names.end()) names.push_back(body);
  }
  std::string words;
  for (const std::string& name : names) words += (words.empty() ? "" : ", ") + name;
  if (report.statistics.world_changes > 0) {
    words += fmt::format(
        fmt::runtime(trn("; changed {} time (body, stiffness or settings)",
                         "; changed {} times (body, stiffness or settings)", report.statistics.world_changes)),
        report.statistics.world_changes);
  }
  return words;
}

std::string factsTable(const RecordingReport& report) {
  const trace::RecordingFacts& facts = report.facts;
  std::string html = "<div class=\"wide\"><table class=\"facts\"><tbody>\n";
  html += factRow(tr("Begun"), formatTimestamp(facts.header.started_utc));
  html += factRow(tr("Ended"), facts.ended_by.empty()
                                   ? tr("no end: it is being written, or its program was killed")
                                   : trf("{}, by: {}", formatTimestamp(facts.ended_utc), facts.ended_by));
  html += factRow(tr("Length"), describeLength(report));
  for (const trace::RecordingFinger& finger : facts.fingers) {
    const bool scripted = finger.device == finger.name;  // a script is named like its finger
    html += factRow(tr("Finger"), scripted ? finger.name : trf("{}, held by {}", finger.name, finger.device));
  }
  html += factRow(tr("Body"), describeBodies(report));
  html += factRow(tr("Tissue"), report.body.tissue);
  for (const std::string& unsafe : report.unsafe) html += factRow(tr("Safety"), unsafe);
  html += factRow(tr("Notes"), facts.header.notes);
  html += factRow(tr("Tags"), facts.header.tags);
  html += factRow(tr("Recorded by"), trf("{} on {}", facts.header.software, facts.header.machine));
  html += factRow(tr("File"), report.file.string());
  return html + "</tbody></table></div>\n";
}

// ---- pictures

std::string picturesHtml(const std::vector<ReportPicture>& pictures, const Progress& progress) {
  std::string html;
  for (const ReportPicture& picture : pictures) {
    palpate::report(progress, "drawing " + picture.id, 0.0);
    if (!picture.heading.empty()) html += headingHtml(picture.heading);
    html += figureHtml(picture.id, picture.figure, picture.caption, picture.caption);
  }
  return html;
}

// ---- the body

std::string bodySection(const RecordingReport& report, const Progress& progress) {
  std::string html = picturesHtml(bodyPictures(report), progress);
  if (!report.body.why_not.empty()) {
    html += paragraphHtml(report.body.why_not + " " +
                          tr("So the map above shows places only; name the folder of the body's files with --folder."));
  }
  for (const std::string& note : report.body.notes) html += paragraphHtml(note);
  if (!report.body.surface) return html;
  const trace::TouchedSurface& surface = *report.body.surface;
  const double share = surface.dorsal_mm2 > 0.0 ? surface.touched_dorsal_mm2 / surface.dorsal_mm2 : 0.0;
  html += tableOf("numbers", {},
                  {{tr("touched skin (mm²)"), counted(surface.touched_mm2)},
                   {tr("the back (mm²)"), counted(surface.dorsal_mm2)},
                   {tr("touched of the back (mm²)"), counted(surface.touched_dorsal_mm2)},
                   {tr("share of the back that was touched"), percent(share)}});
  if (surface.astray_ticks > 0 || report.statistics.places_left_out > 0) {
    html += paragraphHtml(
        trf("{} s of touch are not on this skin and are left out.",
            rounded(report.statistics.seconds(surface.astray_ticks + report.statistics.places_left_out))));
  }
  return html;
}

// ---- definitions

std::string definitionsSection(const RecordingReport& report) {
  std::string reach;
  for (std::size_t f = 0; f < report.body.reach_mm.size() && f < report.facts.fingers.size(); ++f) {
    reach += fmt::format("{}{} {} mm", reach.empty() ? "" : ", ", report.facts.fingers[f].name,
                         rounded(report.body.reach_mm[f]));
  }
  if (!reach.empty()) reach = " " + trf("Here: {}.", reach);
  const std::vector<std::pair<std::string, std::string>> definitions = {
      {tr("Force, depth"),
       tr("The size of the force that the contact computed for the finger (the device may have been sent less: see "
          "Safety), and how deep the tip was under the skin at rest.")},
      {tr("Speed"), trf("The distance moved in the last {} ms, divided by that time: by the finger's place on the "
                        "skin, and by the tip that the device held.",
                        1000.0 * trace::kSpeedWindowS)},
      {tr("Contact"),
       trf("A stretch of time in which the finger touches the skin; breaks up to {} ms do not end it. Means are "
           "over the ticks that touch. Its path is measured in steps of {} mm, so that trembling goes nowhere.",
           1000.0 * trace::kJoinedGapS, trace::kPathStepMm)},
      {tr("Search and palpation"),
       trf("On the skin, a finger that presses with {} N or more and moves at {} mm/s or less palpates; one that is "
           "lighter or faster searches. A phase begins where this has held for {} s. These limits are this program's "
           "own; no standard defines any.",
           trace::kLightForceN, trace::kDwellSpeedMmPerS, trace::kMinPhaseS)},
      {tr("Touched skin"),
       trf("All skin within the radius of the finger around the places where it was (at least {} mm), facing the "
           "same way. The back is the skin that leans less than 60 degrees from straight backwards.",
           trace::kMinReachMm) +
           reach},
      {tr("Places"),
       tr("Millimetres in the body's frame: x to the patient's right seen from behind, y to the head, z out of the "
          "back.")},
      {tr("Limits"), tr("All values are what the program computed and the device reported. They do not measure skill "
                        "or diagnose anything; Palpate is not a medical device.")}};
  return definitionsHtml(definitions);
}

std::string pageHead(const RecordingReport& report) {
  const std::string name = trf("Recording {}", report.file.filename().string());
  return pageBegin(name) + summaryHtml(reportSentences(report));
}

}  // namespace

std::string reportPage(const RecordingReport& report, const Progress& progress) {
  std::string html = pageHead(report) + factsTable(report);
  html += picturesHtml(coursePictures(report), progress);
  html += sizesTable(report);
  html += phasesSection(report);
  html += bodySection(report, progress);
  html += contactsSection(report);
  html += safetySection(report) + servoSection(report) + eventsSection(report) + definitionsSection(report);
  return html + std::string(kPageEnd);
}

}  // namespace palpate::app

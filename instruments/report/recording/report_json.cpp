#include <array>

#include "cli/kit/json.h"
#include "cli/recording/recording_text.h"
#include "palpate/base/json.h"
#include "palpate/body/places.h"
#include "report/recording/recording_report.h"

namespace palpate::app {

namespace {

// For machines, in every language; in the order of Phase and of Measured.
constexpr std::array<const char*, trace::kPhases> kPhaseKeys = {"away", "search", "palpation"};
constexpr std::array<const char*, trace::kMeasured> kMeasuredKeys = {"force_n", "depth_mm", "proxy_speed_mm_per_s",
                                                                     "tip_speed_mm_per_s"};

Json distributionJson(const trace::FixedHistogram& histogram) {
  Json json = {{"mean", histogram.mean()},         {"median", histogram.quantile(0.5)},
               {"p95", histogram.quantile(0.95)},  {"max", histogram.greatest()},
               {"ticks", histogram.count()},       {"bin_width", histogram.binWidth()},
               {"beyond_bins", histogram.beyond()}};
  Json bins = Json::array();  // up to the last one that is not empty
  std::size_t last = histogram.bins().size();
  while (last > 0 && histogram.bins()[last - 1] == 0) --last;
  for (std::size_t bin = 0; bin < last; ++bin) bins.push_back(histogram.bins()[bin]);
  json["bins"] = std::move(bins);
  return json;
}

Json seriesJson(const RecordingReport& report, const trace::TickSeries& series) {
  const std::vector<trace::SeriesBucket>& buckets = series.buckets();
  Json json = {
      {"from_s", report.secondsAt(series.firstTick())},
      {"step_s", report.statistics.seconds(series.ticksPerBucket())},
      {"ticks", listJson(buckets, [](const trace::SeriesBucket& bucket) { return bucket.ticks; })},
      {"touching_ticks", listJson(buckets, [](const trace::SeriesBucket& bucket) { return bucket.touching; })}};
  for (std::size_t i = 0; i < trace::kMeasured; ++i) {
    const auto course = [&](const auto& value_of) {
      return listJson(buckets, [&](const trace::SeriesBucket& bucket) {
        return bucket.values[i].count > 0 ? Json(value_of(bucket.values[i])) : Json(nullptr);
      });
    };
    json[kMeasuredKeys[i]] = {{"least", course([](const trace::Extremes& value) { return value.least; })},
                              {"mean", course([](const trace::Extremes& value) { return value.mean(); })},
                              {"greatest", course([](const trace::Extremes& value) { return value.greatest; })}};
  }
  return json;
}

Json bitsJson(const RecordingReport& report, const std::vector<StatusLine>& lines, std::size_t finger) {
  Json json = Json::array();
  for (const StatusLine& line : lines) {
    if (line.finger != finger) continue;
    json.push_back({{"name", line.name},
                    {"ticks", line.tally.ticks},
                    {"times", line.tally.times},
                    {"first_s", report.secondsAt(line.tally.first_tick)}});
  }
  return json;
}

Json fingerReportJson(const RecordingReport& report, std::size_t f) {
  const trace::FingerStatistics& finger = report.statistics.fingers[f];
  const auto seconds = [&](std::uint64_t ticks) { return report.statistics.seconds(ticks); };
  Json json = {{"name", report.facts.fingers[f].name},
               {"device", report.facts.fingers[f].device},
               {"ticks", finger.ticks},
               {"touching_ticks", finger.touching},
               {"touching_s", seconds(finger.touching)},
               {"slipping_ticks", finger.slipping},
               {"contacts", finger.contacts},
               {"longest_contact_s", seconds(finger.longest_contact_ticks)},
               {"path_mm", finger.path_mm}};
  for (std::size_t i = 0; i < trace::kMeasured; ++i) json[kMeasuredKeys[i]] = distributionJson(finger.in_contact[i]);
  for (std::size_t i = 0; i < trace::kPhases; ++i) {
    json["phases"][kPhaseKeys[i]] = {{"times", finger.phases[i]}, {"seconds", seconds(finger.phase_ticks[i])}};
  }
  json["interventions"] = bitsJson(report, safetyLines(report), f);
  json["contact_status"] = bitsJson(report, contactLines(report), f);
  json["series"] = seriesJson(report, finger.series);
  return json;
}

Json contactsJson(const RecordingReport& report) {
  return listJson(report.statistics.contacts, [&](const trace::Contact& contact) {
    Json json = {{"finger", contact.finger},
                 {"begin_s", report.secondsAt(contact.first_tick)},
                 {"seconds", report.statistics.seconds(contact.ticks())},
                 {"touching_ticks", contact.touching},
                 {"peak_force_n", contact.peak_force_n},
                 {"mean_force_n", contact.mean_force_n},
                 {"peak_depth_mm", contact.peak_depth_mm},
                 {"path_mm", contact.path_mm},
                 {"peak_place_mm", vectorJson(contact.peak_place)}};
    const std::string where = body::describePlace(report.body.landmarks, contact.peak_place);
    if (!where.empty()) json["peak_where"] = where;
    return json;
  });
}

Json phasesJson(const RecordingReport& report) {
  return listJson(report.statistics.phases, [&](const trace::PhaseSpan& span) {
    return Json{{"finger", span.finger},
                {"phase", kPhaseKeys[static_cast<std::size_t>(span.phase)]},
                {"begin_s", report.secondsAt(span.first_tick)},
                {"seconds", report.statistics.seconds(span.ticks())}};
  });
}

Json ticksJson(const RecordingReport& report) {
  const trace::RecordedTicks& ticks = report.statistics.ticks;
  return {{"expected", ticks.expected()},
          {"recorded", ticks.recorded},
          {"missing", ticks.missing()},
          {"gaps", ticks.gaps},
          {"longest_gap_s", report.statistics.seconds(ticks.longest_gap.missing)},
          {"longest_gap_at_s", ticks.gaps == 0 ? Json(nullptr) : Json(report.secondsAt(ticks.longest_gap.after_tick))},
          {"dropped_samples", report.facts.dropped}};
}

Json coverageJson(const RecordingReport& report) {
  const ReportBody& body = report.body;
  Json json = {{"body", body.name},
               {"tissue", body.tissue},
               {"why_not", body.why_not},
               {"notes", body.notes},
               {"reach_mm", body.reach_mm}};
  if (!body.surface) return json;
  json["touched_mm2"] = body.surface->touched_mm2;
  json["back_mm2"] = body.surface->dorsal_mm2;
  json["touched_back_mm2"] = body.surface->touched_dorsal_mm2;
  json["touched_back_share"] =
      body.surface->dorsal_mm2 > 0.0 ? body.surface->touched_dorsal_mm2 / body.surface->dorsal_mm2 : 0.0;
  return json;
}

}  // namespace

Json reportJson(const RecordingReport& report) {
  const trace::RecordingStatistics& statistics = report.statistics;
  Json json = {{"file", report.file.string()}, {"session", factsJson(report.facts)}};
  json["from_s"] = report.secondsAt(statistics.ticks.first);
  json["seconds"] = statistics.seconds(statistics.ticks.expected());
  json["sentences"] = reportSentences(report);
  json["ticks"] = ticksJson(report);
  json["unsafe_stiffness"] = report.unsafe;
  json["emergency_stops"] = emergencyStops(report);
  json["fingers"] = Json::array();
  for (std::size_t f = 0; f < statistics.fingers.size(); ++f) json["fingers"].push_back(fingerReportJson(report, f));
  json["contact_count"] = statistics.contact_count;
  json["contacts"] = contactsJson(report);
  json["phase_count"] = statistics.phase_count;
  json["phases"] = phasesJson(report);
  json["coverage"] = coverageJson(report);
  json["worlds"] = Json::array();
  for (std::size_t i = 0; i < statistics.worlds.size(); ++i) {
    json["worlds"].push_back({{"at_s", report.secondsAt(statistics.worlds[i].tick)},
                              {"world", statistics.worlds[i].world},
                              {"body", report.bodies[i]}});
  }
  json["world_changes"] = statistics.world_changes;
  json["events"] = listJson(report.events, [&](const trace::RecordingEvent& event) {
    return Json{{"at_s", report.secondsAt(event.tick)},
                {"finger", orNull(event.finger)},
                {"kind", event.kind},
                {"text", event.text}};
  });
  json["rules"] = {{"speed_window_s", trace::kSpeedWindowS},
                   {"joined_gap_s", trace::kJoinedGapS},
                   {"path_step_mm", trace::kPathStepMm},
                   {"light_force_n", trace::kLightForceN},
                   {"dwell_speed_mm_per_s", trace::kDwellSpeedMmPerS},
                   {"least_phase_s", trace::kMinPhaseS},
                   {"back_normal_z", trace::kDorsalNormalZ}};
  return json;
}

}  // namespace palpate::app

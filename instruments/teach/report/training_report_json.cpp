// Every number of the report, by names that stay.

#include "palpate/base/json.h"
#include "palpate/training/psychometric.h"
#include "teach/report/training_report.h"

namespace palpate::app {

namespace {

Json countsJson(const training::Reasons& counts) {
  Json json = Json::object();
  for (const auto& [reason, count] : counts) json[reason] = count;
  return json;
}

Json spreadJson(const training::Spread& spread) {
  if (spread.count == 0) return nullptr;
  return {{"count", spread.count},      {"mean", spread.mean},
          {"least", spread.least},      {"lower_quartile", spread.lower_quartile},
          {"median", spread.median},    {"upper_quartile", spread.upper_quartile},
          {"greatest", spread.greatest}};
}

Json histogramJson(const training::Histogram& histogram) {
  return {{"box_width", histogram.width}, {"counts", histogram.counts}};
}

/// Answers at `place`, which has members of its own.
Json boxJson(Json place, const training::AnswerBox& box) {
  const training::ShareInterval interval = box.right.interval();
  place.update({{"trials", box.right.whole},
                {"correct", box.right.part},
                {"share", box.right.share()},
                {"low", interval.low},
                {"high", interval.high},
                {"chance", box.chance},
                {"corrected", box.corrected()}});
  return place;
}

Json levelsJson(const std::vector<training::AnswerBox>& levels) {
  Json json = Json::array();
  for (const training::AnswerBox& level : levels) json.push_back(boxJson({{"change", level.middle}}, level));
  return json;
}

Json boxesJson(const std::vector<training::AnswerBox>& boxes) {
  Json json = Json::array();
  for (const training::AnswerBox& box : boxes) {
    json.push_back(boxJson({{"from", box.from}, {"to", box.to}, {"middle", box.middle}}, box));
    json.back()["expected"] = box.expected;
  }
  return json;
}

Json sitesJson(const std::vector<training::SiteFelt>& sites) {
  Json json = Json::array();
  for (const training::SiteFelt& site : sites) {
    json.push_back({{"site", site.site},
                    {"trials", site.trials},
                    {"felt", site.felt},
                    {"presses_per_trial", site.presses},
                    {"dwell_s_per_trial", site.dwell_s},
                    {"peak_force_n", site.peak_force_n},
                    {"greatest_force_n", site.greatest_force_n},
                    {"deepest_mm", site.deepest_mm}});
  }
  return json;
}

Json answersJson(const training::SiteAnswers& answers) {
  Json rows = Json::array();
  for (int truth = 1; truth <= answers.sites; ++truth) {
    Json row = Json::array();
    for (int answer = 1; answer <= answers.sites; ++answer) row.push_back(answers.at(truth, answer));
    row.push_back(answers.at(truth, 0));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json countsJson(const training::TrialStatistics& trials) {
  Json json;
  for (const training::TrialCount& each : training::trialCounts()) json[each.name] = trials.*each.count;
  return json;
}

Json trialsJson(const training::TrialStatistics& trials) {
  Json json = countsJson(trials);
  if (trials.shown == 0) return json;
  json["levels"] = levelsJson(trials.levels);
  json["boxes"] = boxesJson(trials.boxes);
  json["sites"] = sitesJson(trials.felt);
  json["answers"] = answersJson(trials.answers);
  json["wrong"] = {{"beside", trials.wrong.beside},
                   {"other_side", trials.wrong.other_side},
                   {"elsewhere", trials.wrong.elsewhere},
                   {"none", trials.wrong.none}};
  for (const training::TrialMeasure& each : training::trialMeasures()) {
    json[each.name] = spreadJson(trials.*each.spread);
    if (each.histogram != nullptr) json[each.histogram_name] = histogramJson(trials.*each.histogram);
  }
  return json;
}

Json summaryJson(const training::ThresholdSummary& summary) {
  return {{"median", summary.median},
          {"low", summary.low},
          {"high", summary.high},
          {"mean_ln", summary.mean_ln},
          {"sd_ln", summary.sd_ln}};
}

Json pointJson(const training::ThresholdPoint& point) {
  Json json = {{"block", point.block},
               {"kind", wordFor(point.kind)},
               {"nth", point.nth},
               {"start_ms", point.start_ms},
               {"method", wordFor(point.method)},
               {"change_meaning", wordFor(point.meaning)},
               {"protocol", point.protocol_id},
               {"protocol_version", point.protocol_version},
               {"device", point.device},
               {"choices", point.choices},
               {"finished", point.finished},
               {"verdict", wordFor(point.verdict)},
               {"mastered_change", point.level ? Json(*point.level) : Json(nullptr)},
               {"trials", countsJson(point.trials)},
               {"seconds", spreadJson(point.trials.seconds)},
               {"places_felt", spreadJson(point.trials.places_felt)},
               {"threshold", nullptr}};
  if (!point.threshold) return json;
  json["threshold"] = summaryJson(*point.threshold);
  json["attention"] = {{"easy", point.attention.easy},
                       {"easy_missed", point.attention.easy_missed},
                       {"evidence", point.attention.evidence},
                       {"warned", point.attention.warned()}};
  json["slope"] = point.slope;
  json["lapse"] = point.lapse;
  json["stored"] = {{"median", point.stored}, {"low", point.stored_low}, {"high", point.stored_high}};
  return json;
}

Json comparedJson(const training::TraineeStatistics& trainee) {
  if (!trainee.compared) return nullptr;
  const training::TestsCompared& compared = *trainee.compared;
  Json json = {{"before", trainee.points[compared.before].block}, {"now", trainee.points[compared.now].block}};
  json["why_not"] = compared.why_not ? Json(*compared.why_not) : Json(nullptr);
  if (compared.why_not) return json;
  json["ratio"] = compared.change.ratio;
  json["low"] = compared.change.low;
  json["high"] = compared.change.high;
  json["clear"] = compared.change.clear;
  return json;
}

Json sessionQualityJson(const training::SessionQuality& session) {
  return {
      {"id", session.row.id},         {"kind", wordFor(session.row.kind)},      {"start_ms", session.row.start_ms},
      {"end_ms", session.row.end_ms}, {"app_version", session.row.app_version}, {"device", session.row.device},
      {"file", session.row.file},     {"file_sha256", session.row.file_sha256}, {"events", countsJson(session.events)}};
}

Json learningJson(const training::TraineeStatistics& trainee) {
  if (!trainee.learning) return nullptr;
  const auto place = [](const training::CurvePoint& point) {
    return Json{{"session", point.session}, {"median", point.median}, {"low", point.low}, {"high", point.high}};
  };
  const training::LearningFit& fit = trainee.learning->fit;
  Json json = {{"first_block", trainee.points[trainee.curve[trainee.learning->first].point].block},
               {"start", place(fit.start)},
               {"end", place(fit.end)},
               {"pace_sessions", fit.pace_sessions},
               {"curve", Json::array()}};
  for (const training::CurvePoint& point : fit.curve) json["curve"].push_back(place(point));
  return json;
}

Json traineeJson(const training::TraineeStatistics& trainee, bool whole) {
  Json json = {{"trainee", shortPseudonym(trainee.id)}};
  json["points"] = Json::array();
  for (const training::ThresholdPoint& point : trainee.points) json["points"].push_back(pointJson(point));
  json["tests"] = whole ? trialsJson(trainee.tests) : countsJson(trainee.tests);
  json["practice"] = whole ? trialsJson(trainee.practice) : countsJson(trainee.practice);
  json["compared"] = comparedJson(trainee);
  json["excluded"] = countsJson(trainee.excluded);
  json["changed_results"] = trainee.changed_results;
  if (!whole) return json;
  json["curve"] = Json::array();
  for (const training::FilteredPoint& point : trainee.curve) {
    Json filtered = summaryJson(point.filtered);
    filtered["block"] = trainee.points[point.point].block;
    json["curve"].push_back(std::move(filtered));
  }
  json["learning"] = learningJson(trainee);
  json["sittings"] = Json::array();
  for (const training::SessionQuality& session : trainee.sessions)
    json["sittings"].push_back(sessionQualityJson(session));
  json["fits"] = Json::array();
  for (const training::ThresholdPoint& point : trainee.points) {
    if (!point.threshold || !training::isTest(point.kind)) continue;
    const training::FittedCurve curve =
        training::fittedCurve(training::computePosterior(point), training::curveChanges());
    json["fits"].push_back({{"block", point.block},
                            {"changes", curve.changes},
                            {"mean", curve.mean},
                            {"low", curve.low},
                            {"high", curve.high},
                            {"answers", boxesJson(point.trials.boxes)}});
  }
  return json;
}

Json groupJson(const training::GroupEstimate& group) {
  if (group.people < 2) return nullptr;
  return {{"people", group.people},
          {"mean", group.mean},
          {"low", group.low},
          {"high", group.high},
          {"sd", group.sd},
          {"mean_ln", group.mean_ln},
          {"error_of_mean_ln", group.error_of_mean_ln},
          {"sd_ln", group.sd_ln}};
}

Json occasionsJson(const std::vector<training::Occasion>& occasions, bool with_group) {
  Json json = Json::array();
  for (const training::Occasion& occasion : occasions) {
    json.push_back(
        {{"kind", wordFor(occasion.kind)}, {"nth", occasion.nth}, {"medians", spreadJson(occasion.medians)}});
    if (!with_group) continue;
    json.back()["group"] = groupJson(occasion.group);
    json.back()["verdicts"] = countsJson(occasion.verdicts);
  }
  return json;
}

Json classJson(const training::ClassStatistics& all) {
  Json json = {{"occasions", occasionsJson(all.occasions, true)},
               {"tests", trialsJson(all.tests)},
               {"practice", trialsJson(all.practice)},
               {"collapsed", boxesJson(all.collapsed)},
               {"change", nullptr}};
  if (!all.change) return json;
  json["change"] = {{"trainees", all.change->trainees},
                    {"clearly_better", all.change->clearly_better},
                    {"clearly_worse", all.change->clearly_worse}};
  if (all.change->group.people >= 2) {
    json["change"]["factor"] = all.change->group.factor;
    json["change"]["low"] = all.change->group.low;
    json["change"]["high"] = all.change->group.high;
    json["change"]["sd_ln"] = all.change->group.sd_ln;
  }
  return json;
}

}  // namespace

Json trainingReportJson(const TrainingReport& report) {
  Json json = {{"report", "training"},
               {"of", report.of_class ? "class" : "trainee"},
               {"records", report.file.filename().string()},
               {"class", report.class_words},
               {"threshold_definition", training::kThresholdDefinition},
               {"sentences", trainingSentences(report)}};
  json["trainees"] = Json::array();
  for (const training::TraineeStatistics& trainee : report.statistics.trainees) {
    json["trainees"].push_back(traineeJson(trainee, !report.of_class));
  }
  if (report.of_class) {
    json["all"] = classJson(report.statistics.all);
  } else {
    json["others"] = occasionsJson(report.others, false);
  }
  if (!report.lumps.empty()) json["lumps"] = lumpGroupsJson(report);
  json["protocols"] = Json::array();
  for (const training::ProtocolRow& row : report.record.protocols) {
    json["protocols"].push_back({{"id", row.id}, {"version", row.version}, {"sha256", row.sha256}});
  }
  return json;
}

}  // namespace palpate::app

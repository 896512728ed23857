// Every number of the report, by names that stay.

#include "cli/kit/json.h"
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
Json answersAt(Json place, const training::AnswerBox& box) {
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

Json levelJson(const training::AnswerBox& level) { return answersAt({{"change", level.middle}}, level); }

Json boxJson(const training::AnswerBox& box) {
  Json json = answersAt({{"from", box.from}, {"to", box.to}, {"middle", box.middle}}, box);
  json["expected"] = box.expected;
  return json;
}

Json siteJson(const training::SiteFelt& site) {
  return {{"site", site.site},
          {"trials", site.trials},
          {"felt", site.felt},
          {"presses_per_trial", site.presses},
          {"dwell_s_per_trial", site.dwell_s},
          {"peak_force_n", site.peak_force_n},
          {"greatest_force_n", site.greatest_force_n},
          {"deepest_mm", site.deepest_mm}};
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

Json tallyJson(const training::TrialStatistics& trials) {
  Json json;
  for (const training::TrialCount& each : training::trialCounts()) json[each.name] = trials.*each.count;
  return json;
}

Json trialsJson(const training::TrialStatistics& trials) {
  Json json = tallyJson(trials);
  if (trials.shown == 0) return json;
  json["levels"] = listJson(trials.levels, levelJson);
  json["boxes"] = listJson(trials.boxes, boxJson);
  json["sites"] = listJson(trials.felt, siteJson);
  json["answers"] = answersJson(trials.answers);
  const training::WrongAnswers& wrong = trials.wrong;
  json["wrong"] = {
      {"beside", wrong.beside}, {"other_side", wrong.other_side}, {"elsewhere", wrong.elsewhere}, {"none", wrong.none}};
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
               {"mastered_change", orNull(point.level)},
               {"trials", tallyJson(point.trials)},
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
  Json json = {{"before", trainee.points[compared.before].block},
               {"now", trainee.points[compared.now].block},
               {"why_not", orNull(compared.why_not)}};
  if (compared.why_not) return json;
  const training::ThresholdChange& change = compared.change;
  json.update({{"ratio", change.ratio}, {"low", change.low}, {"high", change.high}, {"clear", change.clear}});
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
  return {{"first_block", trainee.points[trainee.curve[trainee.learning->first].point].block},
          {"start", place(fit.start)},
          {"end", place(fit.end)},
          {"pace_sessions", fit.pace_sessions},
          {"curve", listJson(fit.curve, place)}};
}

Json fitJson(const training::ThresholdPoint& point) {
  const training::FittedCurve curve =
      training::fittedCurve(training::computePosterior(point), training::curveChanges());
  return {{"block", point.block}, {"changes", curve.changes}, {"mean", curve.mean},
          {"low", curve.low},     {"high", curve.high},       {"answers", listJson(point.trials.boxes, boxJson)}};
}

Json traineeJson(const training::TraineeStatistics& trainee, bool whole) {
  const auto trials = whole ? &trialsJson : &tallyJson;
  Json json = {{"trainee", shortPseudonym(trainee.id)},
               {"points", listJson(trainee.points, pointJson)},
               {"tests", trials(trainee.tests)},
               {"practice", trials(trainee.practice)},
               {"compared", comparedJson(trainee)},
               {"excluded", countsJson(trainee.excluded)},
               {"changed_results", trainee.changed_results}};
  if (!whole) return json;
  json["curve"] = listJson(trainee.curve, [&](const training::FilteredPoint& point) {
    Json filtered = summaryJson(point.filtered);
    filtered["block"] = trainee.points[point.point].block;
    return filtered;
  });
  json["learning"] = learningJson(trainee);
  json["sittings"] = listJson(trainee.sessions, sessionQualityJson);
  json["fits"] = Json::array();
  for (const training::ThresholdPoint& point : trainee.points) {
    if (point.threshold && training::isTest(point.kind)) json["fits"].push_back(fitJson(point));
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

Json occasionJson(const training::Occasion& occasion) {
  return {{"kind", wordFor(occasion.kind)}, {"nth", occasion.nth}, {"medians", spreadJson(occasion.medians)}};
}

Json classOccasionJson(const training::Occasion& occasion) {
  Json json = occasionJson(occasion);
  json["group"] = groupJson(occasion.group);
  json["verdicts"] = countsJson(occasion.verdicts);
  return json;
}

Json classJson(const training::ClassStatistics& all) {
  Json json = {{"occasions", listJson(all.occasions, classOccasionJson)},
               {"tests", trialsJson(all.tests)},
               {"practice", trialsJson(all.practice)},
               {"collapsed", listJson(all.collapsed, boxJson)},
               {"change", nullptr}};
  if (!all.change) return json;
  json["change"] = {{"trainees", all.change->trainees},
                    {"clearly_better", all.change->clearly_better},
                    {"clearly_worse", all.change->clearly_worse}};
  const training::GroupChange& group = all.change->group;
  if (group.people < 2) return json;
  json["change"].update({{"factor", group.factor}, {"low", group.low}, {"high", group.high}, {"sd_ln", group.sd_ln}});
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
  json["trainees"] = listJson(report.statistics.trainees, [&](const training::TraineeStatistics& trainee) {
    return traineeJson(trainee, !report.of_class);
  });
  if (report.of_class) {
    json["all"] = classJson(report.statistics.all);
  } else {
    json["others"] = listJson(report.others, occasionJson);
  }
  if (!report.lumps.empty()) json["lumps"] = lumpGroupsJson(report);
  json["protocols"] = listJson(report.record.protocols, [](const training::ProtocolRow& row) {
    return Json{{"id", row.id}, {"version", row.version}, {"sha256", row.sha256}};
  });
  return json;
}

}  // namespace palpate::app

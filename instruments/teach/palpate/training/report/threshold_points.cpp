#include "palpate/training/report/threshold_points.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "palpate/base/language.h"
#include "palpate/base/order_statistics.h"
#include "palpate/training/psychometric.h"

namespace palpate::training {

namespace {

constexpr double kMinDrawn = 0.03;
constexpr int kDrawnChanges = 49;
/// Share of a band left out on each side.
constexpr double kTail = 0.025;

/// A protocol's settings for judging a block's answers; the built-in ones where the record has lost it.
struct BlockRules {
  int choices = 12;
  double felt_ms = 300.0;
  Prior prior;
};

BlockRules findBlockRules(const TrainingRecord& record, const BlockRow& block, SessionKind kind) {
  static const Protocol built_in = builtInProtocol();
  const Protocol* known = findProtocol(record, block.protocol_id, block.protocol_version);
  const Protocol& protocol = known != nullptr ? *known : built_in;
  const SessionSettings& settings = settingsOf(protocol, kind);
  return {.choices = protocol.sites.empty() ? settings.block.choices : static_cast<int>(protocol.sites.size()),
          .felt_ms = 1000.0 * protocol.exploration.dwell_s,
          .prior = settings.block.prior};
}

std::vector<Answer> countedAnswers(const BlockRecord& block, int choices) {
  std::vector<Answer> answers;
  for (const TrialRow& trial : block.trials) {
    if (!countsForResults(trial)) continue;
    answers.push_back(
        {.change = trial.change, .correct = trial.correct, .choices = std::min(trial.sites_felt, choices)});
  }
  return answers;
}

bool hasThreshold(Method method) { return method != Method::mastery; }

ThresholdPoint makeThresholdPoint(const TrainingRecord& record, const SessionRecord& session,
                                  const BlockRecord& block) {
  const BlockRules rules = findBlockRules(record, block.row, session.row.kind);
  ThresholdPoint point{.block = block.row.id,
                       .kind = session.row.kind,
                       .start_ms = block.trials.front().start_ms,
                       .method = block.row.method,
                       .meaning = block.row.change_meaning,
                       .protocol_id = block.row.protocol_id,
                       .protocol_version = block.row.protocol_version,
                       .device = session.row.device,
                       .choices = rules.choices,
                       .finished = block.row.finished,
                       .verdict = block.row.verdict,
                       .level = block.row.mastered_change,
                       .trials = trialStatistics(chosenTrials(record, block)),
                       .threshold = std::nullopt,
                       .stored = block.row.threshold,
                       .stored_low = block.row.threshold_low,
                       .stored_high = block.row.threshold_high,
                       .answers = countedAnswers(block, rules.choices),
                       .prior = rules.prior};
  if (!hasThreshold(point.method) || point.answers.size() < static_cast<std::size_t>(kMinShownAnswers)) {
    return point;
  }
  const Posterior posterior = computePosterior(point);
  point.threshold = posterior.summary();
  const std::size_t slopes = posterior.slopes().size();
  const std::size_t lapses = posterior.lapses().size();
  for (std::size_t i = 0; i < posterior.weights().size(); ++i) {
    point.slope += posterior.weights()[i] * posterior.slopes()[i / lapses % slopes];
    point.lapse += posterior.weights()[i] * posterior.lapses()[i % lapses];
  }
  point.attention = checkAttention(point.answers, point.choices, point.threshold->median, point.slope);
  return point;
}

}  // namespace

bool isTest(SessionKind kind) {
  return kind == SessionKind::pre_test || kind == SessionKind::post_test || kind == SessionKind::exam ||
         kind == SessionKind::retention;
}

std::vector<ChosenTrial> chosenTrials(const TrainingRecord& record, const BlockRecord& block) {
  const BlockRules rules =
      findBlockRules(record, block.row, SessionKind::practice);  // places and dwell are a protocol's
  std::vector<ChosenTrial> chosen;
  for (const TrialRow& trial : block.trials) {
    chosen.push_back({.row = &trial, .choices = rules.choices, .felt_ms = rules.felt_ms});
  }
  return chosen;
}

std::vector<ThresholdPoint> thresholdPoints(const TrainingRecord& record, const TraineeRecord& trainee) {
  std::vector<ThresholdPoint> points;
  for (const SessionRecord& session : trainee.sessions) {
    if (session.row.kind == SessionKind::free || hidesLumps(session.row.kind)) continue;
    for (const BlockRecord& block : session.blocks) {
      if (!block.trials.empty()) points.push_back(makeThresholdPoint(record, session, block));
    }
  }
  std::ranges::stable_sort(points, {}, &ThresholdPoint::start_ms);
  std::map<SessionKind, int> seen;
  for (ThresholdPoint& point : points) point.nth = ++seen[point.kind];
  return points;
}

Posterior computePosterior(const ThresholdPoint& point) {
  Posterior posterior(point.choices, point.prior);
  for (const Answer& answer : point.answers) posterior.add(answer);
  return posterior;
}

std::vector<double> curveChanges() {
  std::vector<double> changes;
  for (int i = 0; i < kDrawnChanges; ++i) {
    changes.push_back(kMinDrawn * std::pow(1.0 / kMinDrawn, static_cast<double>(i) / (kDrawnChanges - 1)));
  }
  return changes;
}

FittedCurve fittedCurve(const Posterior& posterior, const std::vector<double>& changes) {
  FittedCurve curve{.changes = changes, .mean = {}, .low = {}, .high = {}};
  const std::size_t slopes = posterior.slopes().size();
  const std::size_t lapses = posterior.lapses().size();
  std::vector<WeighedValue> weighed(posterior.weights().size());
  for (const double change : changes) {
    double mean = 0.0;
    for (std::size_t i = 0; i < weighed.size(); ++i) {
      const Psychometric function{.threshold = std::exp(posterior.lnThresholds()[i / lapses / slopes]),
                                  .slope = posterior.slopes()[i / lapses % slopes],
                                  .lapse = posterior.lapses()[i % lapses],
                                  .guess = 1.0 / posterior.choices()};
      weighed[i] = {probabilityCorrect(function, change), posterior.weights()[i]};
      mean += weighed[i].value * weighed[i].weight;
    }
    std::sort(weighed.begin(), weighed.end());
    curve.mean.push_back(mean);
    curve.low.push_back(weighedQuantile(weighed, kTail));
    curve.high.push_back(weighedQuantile(weighed, 1.0 - kTail));
  }
  return curve;
}

bool measuresThreshold(const ThresholdPoint& point) {
  return point.threshold.has_value() && isTest(point.kind) && point.kind != SessionKind::exam;
}

std::optional<std::string> notComparable(const ThresholdPoint& a, const ThresholdPoint& b) {
  if (a.meaning != b.meaning) return toTranslate("one is a change of compliance, the other of stiffness");
  if (a.choices != b.choices) return toTranslate("they asked about different numbers of places");
  if (a.device != b.device) return toTranslate("they were felt with different devices");
  if (isTest(a.kind) != isTest(b.kind)) return toTranslate("one is practice, the other a test");
  if (a.protocol_id != b.protocol_id || a.protocol_version != b.protocol_version)
    return toTranslate("they follow different protocols");
  if (a.attention.warned() || b.attention.warned())
    return toTranslate("answers in a row were like guesses where changes were easy to feel (inattention)");
  return std::nullopt;
}

}  // namespace palpate::training

#include "palpate/training/report/training_statistics.h"

#include <algorithm>
#include <cmath>

#include "palpate/training/psychometric.h"

namespace palpate::training {

namespace {

/// Boxes of the collapsed answers over change / threshold, even on a logarithmic scale.
constexpr BoxScale kCollapsed{.from = 0.25, .to = 8.0, .boxes = 10};
/// A stored result that differs by more is not that of the trials: the rest is rounding in other programs.
constexpr double kSameThreshold = 1e-6;

using ChosenTrials = std::vector<ChosenTrial>;

/// Pointers into the record.
struct TestsAndPractice {
  ChosenTrials tests, practice;

  void add(const TestsAndPractice& more) {
    tests.insert(tests.end(), more.tests.begin(), more.tests.end());
    practice.insert(practice.end(), more.practice.begin(), more.practice.end());
  }
};

TestsAndPractice collectTrials(const TrainingRecord& record, const TraineeRecord& trainee) {
  TestsAndPractice all;
  for (const SessionRecord& session : trainee.sessions) {
    if (hidesLumps(session.row.kind)) continue;  // hides lumps: see lump_statistics.h
    for (const BlockRecord& block : session.blocks) {
      const ChosenTrials chosen = chosenTrials(record, block);
      ChosenTrials& into = isTest(session.row.kind) ? all.tests : all.practice;
      into.insert(into.end(), chosen.begin(), chosen.end());
    }
  }
  return all;
}

/// Whether one hand on one device felt both, with one meaning and number of places: practice and tests alike.
bool sameHand(const ThresholdPoint& a, const ThresholdPoint& b) {
  return a.meaning == b.meaning && a.choices == b.choices && a.device == b.device;
}

/// Blocks with a threshold, one after the other, felt with one hand on one device: places in the trainee's points.
std::vector<std::vector<std::size_t>> groupByHand(const std::vector<ThresholdPoint>& points) {
  std::vector<std::vector<std::size_t>> courses;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].threshold) continue;
    if (courses.empty() || !sameHand(points[courses.back().back()], points[i])) courses.emplace_back();
    courses.back().push_back(i);
  }
  return courses;
}

void addCurve(TraineeStatistics& trainee) {
  for (const std::vector<std::size_t>& course : groupByHand(trainee.points)) {
    std::vector<SessionAnswers> sessions;
    for (const std::size_t i : course) sessions.push_back({trainee.points[i].answers});
    const ThresholdPoint& first = trainee.points[course.front()];
    const std::size_t begin = trainee.curve.size();
    const std::vector<LearningPoint> filtered = filteredThresholds(sessions, first.choices, first.prior);
    for (std::size_t i = 0; i < course.size(); ++i) trainee.curve.push_back({course[i], filtered[i].threshold});
    trainee.learning.reset();  // the newest course alone
    if (auto fit = fitLearning(sessions, first.choices, first.prior)) trainee.learning = {begin, std::move(*fit)};
  }
}

std::optional<TestsCompared> testsCompared(const std::vector<ThresholdPoint>& points) {
  std::vector<std::size_t> tests;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (measuresThreshold(points[i])) tests.push_back(i);
  }
  if (tests.size() < 2) return std::nullopt;
  TestsCompared compared{.before = tests.front(), .now = tests.back()};
  compared.why_not = notComparable(points[compared.before], points[compared.now]);
  if (!compared.why_not) {
    compared.change = changeBetween(*points[compared.before].threshold, *points[compared.now].threshold);
  }
  return compared;
}

bool resultChanged(const ThresholdPoint& point) {
  return point.threshold && point.stored > 0.0 && std::abs(point.threshold->median - point.stored) > kSameThreshold;
}

TraineeStatistics traineeStatistics(const TrainingRecord& record, const TraineeRecord& trainee,
                                    TestsAndPractice& everybodys) {
  TraineeStatistics statistics{.id = trainee.row.id, .points = thresholdPoints(record, trainee)};
  const TestsAndPractice trials = collectTrials(record, trainee);
  statistics.tests = trialStatistics(trials.tests);
  statistics.practice = trialStatistics(trials.practice);
  everybodys.add(trials);
  for (const auto* group : {&trials.tests, &trials.practice}) {
    for (const ChosenTrial& trial : *group) {
      if (const std::string reason = exclusionReason(*trial.row); !reason.empty()) ++statistics.excluded[reason];
    }
  }
  statistics.compared = testsCompared(statistics.points);
  for (const SessionRecord& session : trainee.sessions) {
    SessionQuality quality{.row = session.row, .events = {}};
    for (const EventRow& event : session.events) ++quality.events[event.kind];
    statistics.sessions.push_back(std::move(quality));
  }
  statistics.changed_results = static_cast<int>(std::ranges::count_if(statistics.points, resultChanged));
  return statistics;
}

// ---- the class

using OccasionKey = std::pair<SessionKind, int>;

/// Points of all trainees, and their average place among a trainee's sessions.
struct OccasionPoints {
  std::vector<const ThresholdPoint*> points;
  double places = 0.0;
};

std::vector<Occasion> groupOccasions(const std::vector<TraineeStatistics>& trainees) {
  std::map<OccasionKey, OccasionPoints> by_key;
  for (const TraineeStatistics& trainee : trainees) {
    for (std::size_t i = 0; i < trainee.points.size(); ++i) {
      if (!trainee.points[i].threshold) continue;
      OccasionPoints& occasion = by_key[{trainee.points[i].kind, trainee.points[i].nth}];
      occasion.points.push_back(&trainee.points[i]);
      occasion.places += static_cast<double>(i);
    }
  }
  std::vector<std::pair<double, Occasion>> placed;
  for (const auto& [key, found] : by_key) {
    Occasion occasion{.kind = key.first, .nth = key.second};
    std::vector<double> medians;
    for (const ThresholdPoint* point : found.points) {
      medians.push_back(point->threshold->median);
      if (point->verdict != Verdict::none) ++occasion.verdicts[std::string(wordFor(point->verdict))];
    }
    occasion.medians = computeSpread(medians);
    placed.emplace_back(found.places / static_cast<double>(found.points.size()), std::move(occasion));
  }
  std::ranges::stable_sort(placed, {}, [](const auto& each) { return each.first; });
  std::vector<Occasion> occasions;
  for (auto& [place, occasion] : placed) occasions.push_back(std::move(occasion));
  return occasions;
}

/// Likelihoods of every block with a threshold; each is needed more than once.
using Likelihoods = std::map<const ThresholdPoint*, ThresholdLikelihood>;

Likelihoods computeLikelihoods(const std::vector<TraineeStatistics>& trainees) {
  Likelihoods all;
  for (const TraineeStatistics& trainee : trainees) {
    for (const ThresholdPoint& point : trainee.points) {
      if (point.threshold) all.emplace(&point, thresholdLikelihood(point.answers, point.choices));
    }
  }
  return all;
}

std::optional<ClassChange> classChange(const std::vector<TraineeStatistics>& trainees, const Likelihoods& known) {
  ClassChange change;
  std::vector<ThresholdLikelihood> changes;
  for (const TraineeStatistics& trainee : trainees) {
    if (!trainee.compared || trainee.compared->why_not) continue;
    changes.push_back(changeLikelihood(known.at(&trainee.points[trainee.compared->before]),
                                       known.at(&trainee.points[trainee.compared->now])));
    if (!trainee.compared->change.clear) continue;
    ++(trainee.compared->change.ratio < 1.0 ? change.clearly_better : change.clearly_worse);
  }
  change.trainees = static_cast<int>(changes.size());
  if (change.trainees == 0) return std::nullopt;
  change.group = groupChange(changes);
  return change;
}

void addGroups(TrainingStatistics& statistics) {
  const Likelihoods known = computeLikelihoods(statistics.trainees);
  for (Occasion& occasion : statistics.all.occasions) {
    std::vector<ThresholdLikelihood> members;
    for (const auto& trainee : statistics.trainees) {
      for (const ThresholdPoint& point : trainee.points) {
        if (point.threshold && point.kind == occasion.kind && point.nth == occasion.nth) {
          members.push_back(known.at(&point));
        }
      }
    }
    occasion.group = groupThreshold(members);
  }
  statistics.all.change = classChange(statistics.trainees, known);
}

std::vector<AnswerBox> collapsedAnswers(const std::vector<TraineeStatistics>& trainees) {
  std::vector<PlacedAnswer> answers;
  for (const TraineeStatistics& trainee : trainees) {
    for (const ThresholdPoint& point : trainee.points) {
      if (!point.threshold || !isTest(point.kind)) continue;
      const Psychometric fitted{.threshold = point.threshold->median,
                                .slope = point.slope,
                                .lapse = point.lapse,
                                .guess = 1.0 / point.choices};
      for (const Answer& answer : point.answers) {
        answers.push_back({.place = answer.change / point.threshold->median,
                           .correct = answer.correct,
                           .chance = 1.0 / answer.choices,
                           .expected = probabilityCorrect(fitted, answer.change)});
      }
    }
  }
  return answerBoxes(answers, kCollapsed);
}

}  // namespace

const ThresholdPoint* TraineeStatistics::latest() const {
  const ThresholdPoint* newest = nullptr;
  for (const ThresholdPoint& point : points) {
    if (!point.threshold) continue;
    if (newest == nullptr || measuresThreshold(point) || !measuresThreshold(*newest)) newest = &point;
  }
  return newest;
}

TrainingStatistics trainingStatistics(const TrainingRecord& record, const StatisticsRequest& request) {
  TrainingStatistics statistics;
  TestsAndPractice everybodys;
  for (const TraineeRecord& trainee : record.trainees) {
    statistics.trainees.push_back(traineeStatistics(record, trainee, everybodys));
    if (request.curves) addCurve(statistics.trainees.back());
  }
  statistics.all.tests = trialStatistics(everybodys.tests);
  statistics.all.practice = trialStatistics(everybodys.practice);
  statistics.all.occasions = groupOccasions(statistics.trainees);
  if (request.groups) addGroups(statistics);
  statistics.all.collapsed = collapsedAnswers(statistics.trainees);
  return statistics;
}

}  // namespace palpate::training

// Simulated trainees who learn: one over six sessions, ten before and after, 89 as in the published course.
#include <algorithm>
#include <cmath>

#include "palpate/base/random.h"
#include "palpate/training/block.h"
#include "palpate/training/psychometric.h"
#include "teach/study/training_parts.h"

namespace palpate::study {

using training::Answer;
using training::SessionAnswers;
using training::ThresholdLikelihood;
using training::ThresholdSummary;

namespace {

constexpr int kTrialsOfATest = 40;
constexpr double kBefore = 0.28;
constexpr double kAfter = 0.14;
/// SD of ln T over people, before and after: with a test's own 0.14 the published spread, 9.5 of 28 and 4.4 of 14 %.
constexpr double kSpread = 0.30;
constexpr std::size_t kPeopleOfExample = 89;
constexpr int kSessions = 6;

std::vector<Answer> simulateAnswers(double truth, int trials, std::uint64_t seed) {
  return askedTest(AskedBy::marginal_psi, usualTrainee(truth), trials, seed).answers;
}

/// A person of a group whose mean T is `mean`; `normal`: of how many spreads.
double personThreshold(double mean, double normal) {
  return mean * std::exp(kSpread * normal - 0.5 * kSpread * kSpread);
}

double truthOfSession(int session) { return kAfter + (kBefore - kAfter) * std::exp(-session / 1.5); }

struct MeanAndSd {
  double mean = 0.0;
  double sd = 0.0;
};

MeanAndSd meanAndSd(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  MeanAndSd found;
  for (const double value : values) found.mean += value / n;
  for (const double value : values) found.sd += (value - found.mean) * (value - found.mean) / (n - 1.0);
  found.sd = std::sqrt(found.sd);
  return found;
}

std::vector<SessionAnswers> simulateSessions(int trials, std::uint64_t seed) {
  std::vector<SessionAnswers> sessions;
  for (int session = 0; session < kSessions; ++session) {
    sessions.push_back({simulateAnswers(truthOfSession(session), trials, seed + static_cast<std::uint64_t>(session))});
  }
  return sessions;
}

/// Squared errors of ln T from the second session on.
struct LearningErrors {
  double separate = 0.0;
  double filtered = 0.0;
  double bias = 0.0;
};

LearningErrors learningErrors(const std::vector<SessionAnswers>& sessions) {
  const auto points = training::filteredThresholds(sessions);
  LearningErrors errors;
  for (std::size_t session = 1; session < sessions.size(); ++session) {
    const double truth = truthOfSession(static_cast<int>(session));
    const double filtered = std::log(points[session].threshold.median / truth);
    const double separate = std::log(posteriorAfter(sessions[session].answers).summary().median / truth);
    errors.filtered += filtered * filtered / (kSessions - 1);
    errors.separate += separate * separate / (kSessions - 1);
    errors.bias += filtered / (kSessions - 1);
  }
  return errors;
}

/// Share of the sessions' truths that the band of a fit holds.
double bandCoverage(const training::LearningFit& fit) {
  double held = 0.0;
  for (const training::CurvePoint& point : fit.curve) {
    const double truth = truthOfSession(static_cast<int>(point.session));
    if (point.session == std::floor(point.session) && point.low <= truth && truth <= point.high)
      held += 1.0 / kSessions;
  }
  return held;
}

/// Answers of a group before and after; `thresholds`: before, then after, of each person.
struct GroupRun {
  std::vector<std::vector<Answer>> before;
  std::vector<std::vector<Answer>> after;
};

GroupRun groupRun(const std::vector<double>& before, const std::vector<double>& after, std::uint64_t seed) {
  GroupRun run;
  run.before.resize(before.size());
  run.after.resize(after.size());
  parallelFor(before.size(), [&](std::size_t i) {
    run.before[i] = simulateAnswers(before[i], kTrialsOfATest, runSeed(seed, 1, i));
    run.after[i] = simulateAnswers(after[i], kTrialsOfATest, runSeed(seed, 2, i));
  });
  return run;
}

/// Simulates people drawn at random; who was good before need not be good after.
GroupRun drawnGroupRun(std::size_t people, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> before;
  std::vector<double> after;
  for (std::size_t i = 0; i < people; ++i) {
    before.push_back(personThreshold(kBefore, random.normal()));
    after.push_back(personThreshold(kAfter, random.normal()));
  }
  return groupRun(before, after, seed);
}

std::vector<double> posteriorMedians(const std::vector<std::vector<Answer>>& people) {
  std::vector<double> medians;
  for (const auto& answers : people) medians.push_back(posteriorAfter(answers).summary().median);
  return medians;
}

std::vector<ThresholdLikelihood> computeLikelihoods(const std::vector<std::vector<Answer>>& people) {
  std::vector<ThresholdLikelihood> all;
  for (const auto& answers : people) all.push_back(training::thresholdLikelihood(answers));
  return all;
}

/// The group's thresholds without the chance of who is in it: evenly over the distribution, in drawn order.
std::vector<double> evenGroup(double mean, std::uint64_t seed) {
  std::vector<double> thresholds;
  double sum = 0.0;
  for (std::size_t i = 0; i < kPeopleOfExample; ++i) {
    thresholds.push_back(
        personThreshold(mean, training::standardNormalQuantile((static_cast<double>(i) + 0.5) / kPeopleOfExample)));
    sum += thresholds.back();
  }
  for (double& threshold : thresholds) threshold *= mean * kPeopleOfExample / sum;
  Random random(seed);
  for (std::size_t i = thresholds.size(); i > 1; --i) std::swap(thresholds[i - 1], thresholds[random.below(i)]);
  return thresholds;
}

/// How often intervals of a group's mean hold it, its people drawn again.
void coverGroups(TrainingMeasurement& found, const Progress& progress) {
  std::size_t by_groups = 0;
  std::size_t by_medians = 0;
  const std::size_t groups = found.plan.groups;
  for (std::size_t group = 0; group < groups; ++group) {
    report(progress, "groups of 89", static_cast<double>(group) / static_cast<double>(groups));
    const std::uint64_t seed = runSeed(found.plan.seed, cellNumber(TrainingPart::groups, 0), group);
    const GroupRun run = drawnGroupRun(kPeopleOfExample, seed);
    for (const auto& [people, truth] : {std::pair(&run.before, kBefore), std::pair(&run.after, kAfter)}) {
      const auto fitted = training::groupThreshold(computeLikelihoods(*people));
      if (fitted.low <= truth && truth <= fitted.high) ++by_groups;
      const MeanAndSd told = meanAndSd(posteriorMedians(*people));
      const double reach = training::student95(kPeopleOfExample - 1) * told.sd / std::sqrt(kPeopleOfExample);
      if (std::abs(told.mean - truth) <= reach) ++by_medians;
    }
  }
  found.example.covered_by_groups = computeShare(by_groups, 2 * groups);
  found.example.covered_by_medians = computeShare(by_medians, 2 * groups);
}

}  // namespace

void measurePower(TrainingMeasurement& found, const Progress& progress) {
  const std::vector<int> sizes = {6, 7, 8, 10};
  constexpr std::size_t kMaxPeople = 10;
  std::vector<std::size_t> seen(sizes.size(), 0);
  for (std::size_t repeat = 0; repeat < found.plan.repeats; ++repeat) {
    report(progress, "power", static_cast<double>(repeat) / static_cast<double>(found.plan.repeats));
    const std::uint64_t seed = runSeed(found.plan.seed, cellNumber(TrainingPart::power, 0), repeat);
    const GroupRun run = drawnGroupRun(kMaxPeople, seed);
    const std::vector<double> told_before = posteriorMedians(run.before);
    const std::vector<double> told_after = posteriorMedians(run.after);
    for (std::size_t s = 0; s < sizes.size(); ++s) {
      std::vector<double> gains;
      for (std::size_t i = 0; i < static_cast<std::size_t>(sizes[s]); ++i) {
        gains.push_back(std::log(told_before[i] / told_after[i]));
      }
      const MeanAndSd gain = meanAndSd(gains);
      if (gain.mean > training::student95(sizes[s] - 1) * gain.sd / std::sqrt(sizes[s])) ++seen[s];
    }
  }
  for (std::size_t s = 0; s < sizes.size(); ++s)
    found.power.push_back({sizes[s], computeShare(seen[s], found.plan.repeats)});
}

void measureLearning(TrainingMeasurement& found, const Progress& progress) {
  const std::size_t people = found.plan.people;
  std::size_t cell = 0;
  for (const int trials : {20, 30, 40}) {
    report(progress, "learning", static_cast<double>(cell) / 3.0);
    std::vector<LearningErrors> each(people);
    std::vector<double> held(people, -1.0);
    parallelFor(people, [&](std::size_t i) {
      const auto sessions =
          simulateSessions(trials, runSeed(found.plan.seed, cellNumber(TrainingPart::learning, cell), i));
      each[i] = learningErrors(sessions);
      if (trials == kTrialsOfATest && i < 100) held[i] = bandCoverage(*training::fitLearning(sessions));
    });
    LearningRow row{.trials = trials};
    const auto n = static_cast<double>(people);
    for (const LearningErrors& errors : each) {
      row.separate_error += errors.separate / n;
      row.filtered_error += errors.filtered / n;
      row.filtered_bias += errors.bias / n;
    }
    row.separate_error = std::sqrt(row.separate_error);
    row.filtered_error = std::sqrt(row.filtered_error);
    found.learning.push_back(row);
    std::erase(held, -1.0);
    if (held.size() > 1) found.band_coverage = meanAndSd(held).mean;
    ++cell;
  }
}

void measureChanges(TrainingMeasurement& found, const Progress& progress) {
  report(progress, "one person twice", 0.0);
  constexpr std::size_t kPeople = 1000;
  std::size_t cell = 0;
  for (const int trials : {20, 40}) {
    std::vector<int> alarmed(kPeople, 0);
    std::vector<int> seen(kPeople, 0);
    parallelFor(kPeople, [&](std::size_t i) {
      const std::uint64_t seed = runSeed(found.plan.seed, cellNumber(TrainingPart::changes, cell), i);
      const auto result = [&](double truth, std::uint64_t part) {
        return posteriorAfter(simulateAnswers(truth, trials, seed + part)).summary();
      };
      const double unchanged = i % 2 == 0 ? kBefore : kAfter;
      const auto change = [&](const ThresholdSummary& before, const ThresholdSummary& after) {
        return training::changeBetween(before, after);
      };
      alarmed[i] = change(result(unchanged, 1), result(unchanged, 2)).clear ? 1 : 0;
      const training::ThresholdChange learnt = change(result(kBefore, 3), result(kAfter, 4));
      seen[i] = learnt.clear && learnt.ratio < 1.0 ? 1 : 0;
    });
    const auto share = [](const std::vector<int>& which) {
      return computeShare(static_cast<std::size_t>(std::count(which.begin(), which.end(), 1)), which.size());
    };
    found.changes.push_back({trials, training::factorOfRealChange(trials, trials), share(alarmed), share(seen)});
    ++cell;
  }
}

void measureExample(TrainingMeasurement& found, const Progress& progress) {
  report(progress, "worked example", 0.0);
  const std::uint64_t seed = runSeed(found.plan.seed, cellNumber(TrainingPart::example, 0), 0);
  WorkedExample& example = found.example;
  const GroupRun run = groupRun(evenGroup(kBefore, seed), evenGroup(kAfter, seed + 1), seed);
  example.before = posteriorMedians(run.before);
  example.after = posteriorMedians(run.after);
  const MeanAndSd before = meanAndSd(example.before);
  const MeanAndSd after = meanAndSd(example.after);
  example.mean_before = before.mean;
  example.sd_before = before.sd;
  example.mean_after = after.mean;
  example.sd_after = after.sd;
  const auto told_before = computeLikelihoods(run.before);
  const auto told_after = computeLikelihoods(run.after);
  example.group_before = training::groupThreshold(told_before);
  example.group_after = training::groupThreshold(told_after);
  std::vector<ThresholdLikelihood> changes;
  for (std::size_t i = 0; i < told_before.size(); ++i)
    changes.push_back(changeLikelihood(told_before[i], told_after[i]));
  example.change = training::groupChange(changes);
  std::sort(example.before.begin(), example.before.end());
  std::sort(example.after.begin(), example.after.end());

  const auto sessions = simulateSessions(kTrialsOfATest, seed + 2);
  for (int session = 0; session < kSessions; ++session) found.learner.truth.push_back(truthOfSession(session));
  found.learner.points = training::filteredThresholds(sessions);
  found.learner.fit = training::fitLearning(sessions);
  if (found.plan.groups > 0) coverGroups(found, progress);
}

}  // namespace palpate::study

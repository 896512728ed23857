#include "teach/study/training_measurement.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "palpate/base/random.h"
#include "palpate/training/block.h"
#include "palpate/training/marginal_psi.h"
#include "teach/study/training_parts.h"

namespace palpate::study {

using training::Block;
using training::BlockResult;
using training::BlockSettings;
using training::Posterior;
using training::Psychometric;
using training::ThresholdSummary;

namespace {

/// Trials of a test.
constexpr int kTestTrials = 40;
/// Where the interval of a test's user ends: SD of ln T that trials are counted until.
constexpr double kWantedError = 0.15;
/// Reversals whose mean is reported without a posterior.
constexpr std::size_t kReportedReversals = 6;

/// Result of one run of the main table.
struct RecoveryRun {
  ThresholdSummary reported;
  std::vector<double> error_ln;  ///< after each trial
  AskedTest test;                ///< the first 40 trials
};

RecoveryRun recoveryRun(AskedBy method, double truth, int longest, std::uint64_t seed) {
  RecoveryRun run;
  run.test = askedTest(method, usualTrainee(truth), longest, seed);
  Posterior posterior;
  for (int i = 0; i < longest; ++i) {
    posterior.add(run.test.answers[static_cast<std::size_t>(i)]);
    const ThresholdSummary now = posterior.summary();
    if (i + 1 == kTestTrials) run.reported = now;
    run.error_ln.push_back(std::log(now.median / truth));
  }
  return run;
}

/// The first trial from which on the rms error stays below the wanted one; 0: none.
int trialsTo(const std::vector<double>& rms) {
  std::size_t from = rms.size();
  while (from > 0 && rms[from - 1] <= kWantedError) --from;
  return from == rms.size() ? 0 : static_cast<int>(from) + 1;
}

MethodRow methodRow(const TrainingMeasurement& found, AskedBy method, std::size_t runs, int longest) {
  MethodRow row{.method = method};
  std::vector<double> squares(static_cast<std::size_t>(longest), 0.0);
  for (std::size_t t = 0; t < found.truths.size(); ++t) {
    const double truth = found.truths[t];
    const std::uint64_t cell = cellNumber(TrainingPart::recovery, 10 * static_cast<std::size_t>(method) + t);
    std::vector<RecoveryRun> each(runs);
    parallelFor(
        runs, [&](std::size_t i) { each[i] = recoveryRun(method, truth, longest, runSeed(found.plan.seed, cell, i)); });
    std::vector<ThresholdSummary> reported;
    std::vector<double> rms(squares.size(), 0.0);
    for (const RecoveryRun& run : each) {
      reported.push_back(run.reported);
      for (std::size_t i = 0; i < rms.size(); ++i) rms[i] += run.error_ln[i] * run.error_ln[i];
    }
    for (std::size_t i = 0; i < rms.size(); ++i) {
      squares[i] += rms[i] / static_cast<double>(runs * found.truths.size());
      rms[i] = std::sqrt(rms[i] / static_cast<double>(runs));
    }
    row.cells.push_back(summariseCell(truth, reported));
    const int trials = trialsTo(rms);
    row.least_to_15 = t == 0 ? trials : std::min(row.least_to_15, trials);
    row.most_to_15 = t == 0 ? trials : (trials == 0 || row.most_to_15 == 0 ? 0 : std::max(row.most_to_15, trials));
  }
  for (const double square : squares) row.error_ln.push_back(std::sqrt(square));
  return row;
}

/// One way to read a run without a posterior: 0 where it has none.
struct PlainReading {
  double value = 0.0;
  double sd_of_mean = 0.0;
};

PlainReading reversalMean(const std::vector<double>& reversals) {
  if (reversals.size() < kReportedReversals) return {};
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = reversals.size() - kReportedReversals; i < reversals.size(); ++i) {
    sum += reversals[i];
    squares += reversals[i] * reversals[i];
  }
  const auto n = static_cast<double>(kReportedReversals);
  const double mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean) / (n - 1.0))};
}

/// The change at which a trainee is right so often.
double changeRight(const Psychometric& trainee, double share) {
  const double felt = (share - trainee.guess) / (1.0 - trainee.guess - trainee.lapse);
  return trainee.threshold * std::pow(-std::log2(1.0 - felt), 1.0 / trainee.slope);
}

template <class Read>
ReadingRow readingRow(const TrainingMeasurement& found, const std::string& name, AskedBy method, std::size_t runs,
                      const Read& read) {
  ReadingRow row{.name = name, .least_ratio = 1e9, .told = 0.0};
  std::size_t covered = 0;
  std::size_t told = 0;
  for (std::size_t t = 0; t < found.truths.size(); ++t) {
    const Psychometric trainee = usualTrainee(found.truths[t]);
    const double aim = changeRight(trainee, std::sqrt(0.5));
    const std::uint64_t cell = cellNumber(TrainingPart::recovery, 500 + 10 * static_cast<std::size_t>(method) + t);
    std::vector<PlainReading> each(runs);
    parallelFor(runs, [&](std::size_t i) {
      each[i] = read(askedTest(method, trainee, kTestTrials, runSeed(found.plan.seed, cell, i)));
    });
    double sum = 0.0;
    double sum_ln = 0.0;
    double squares = 0.0;
    double n = 0.0;
    for (const PlainReading& reading : each) {
      if (!(reading.value > 0.0)) continue;
      const double ln = std::log(reading.value / trainee.threshold);
      sum += reading.value / trainee.threshold;
      sum_ln += ln;
      squares += ln * ln;
      n += 1.0;
      ++told;
      if (std::abs(reading.value - aim) <= 1.96 * reading.sd_of_mean) ++covered;
    }
    if (n < 2.0) continue;
    row.least_ratio = std::min(row.least_ratio, sum / n);
    row.most_ratio = std::max(row.most_ratio, sum / n);
    row.sd_ln = std::max(row.sd_ln, std::sqrt(std::max(0.0, squares / n - sum_ln * sum_ln / (n * n))));
  }
  row.told = computeShare(told, runs * found.truths.size());
  row.coverage = computeShare(covered, told);
  return row;
}

/// Thresholds that blocks of these settings report of a trainee.
RecoveryCell blockCell(const BlockSettings& settings, const Psychometric& trainee, std::size_t runs, std::uint64_t seed,
                       std::uint64_t cell) {
  std::vector<ThresholdSummary> reported(runs);
  std::vector<double> trials(runs);
  parallelFor(runs, [&](std::size_t i) {
    const std::uint64_t run = runSeed(seed, cell, i);
    Block block(settings, run);
    Random random(run ^ 0x2c1b3c6dull);
    while (!block.finished()) {
      const bool right = random.uniform() < probabilityCorrect(trainee, block.next().change);
      block.answer({.answer = 1, .correct = right, .visited = settings.choices});
    }
    const BlockResult result = block.result();
    reported[i] = result.threshold;
    trials[i] = result.trials;
  });
  return summariseCell(trainee.threshold, reported, trials);
}

void timeNextLevel(TrainingMeasurement& found) {
  const std::vector<double> levels = training::adaptiveLevels(training::ChangeMeaning::compliance);
  std::vector<double> us;
  for (std::uint64_t run = 0; run < 50; ++run) {
    Posterior posterior;
    const training::MarginalPsi psi(levels, posterior);
    Random random(run);
    for (int i = 0; i < kTestTrials; ++i) {
      const std::clock_t start = std::clock();
      const double change = levels[psi.best(posterior)];
      us.push_back(1e6 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
      posterior.add({change, random.uniform() < probabilityCorrect(usualTrainee(0.14), change), 12});
    }
  }
  std::sort(us.begin(), us.end());
  found.next_level_us_p50 = us[us.size() / 2];
  found.next_level_us_p99 = us[us.size() * 99 / 100];
}

}  // namespace

double computeShare(std::size_t some, std::size_t all) {
  return all > 0 ? static_cast<double>(some) / static_cast<double>(all) : 0.0;
}

std::uint64_t cellNumber(TrainingPart part, std::size_t cell) { return static_cast<std::uint64_t>(part) * 1000 + cell; }

RecoveryCell summariseCell(double truth, const std::vector<ThresholdSummary>& reported,
                           const std::vector<double>& trials) {
  RecoveryCell cell{.truth = truth, .mean_trials = trials.empty() ? kTestTrials : 0.0};
  const auto runs = static_cast<double>(reported.size());
  double mean_ln = 0.0;
  double squares = 0.0;
  std::size_t held = 0;
  for (const ThresholdSummary& one : reported) {
    const double ln = std::log(one.median / truth);
    cell.bias_points += 100.0 * (one.median - truth) / runs;
    mean_ln += ln / runs;
    squares += ln * ln / runs;
    if (one.low <= truth && truth <= one.high) ++held;
  }
  cell.coverage = computeShare(held, reported.size());
  cell.sd_ln = std::sqrt(std::max(0.0, squares - mean_ln * mean_ln));
  for (const double one : trials) cell.mean_trials += one / runs;
  cell.trials_90 = cell.mean_trials;
  if (!trials.empty()) {
    std::vector<double> sorted = trials;
    std::sort(sorted.begin(), sorted.end());
    cell.trials_90 = sorted[static_cast<std::size_t>(0.9 * (runs - 1.0))];
  }
  return cell;
}

void measureRecovery(TrainingMeasurement& found, const Progress& progress) {
  const TrainingPlan& plan = found.plan;
  using enum AskedBy;
  std::vector<AskedBy> methods = {marginal_psi, two_down};
  if (plan.all) methods.insert(methods.end(), {marginal_psi_vhb, quest, joint_psi, three_down, weighted, constant});
  for (const AskedBy method : methods) {
    report(progress, nameOf(method), 0.0);
    found.methods.push_back(
        methodRow(found, method, method == marginal_psi ? plan.runs : plan.beside_runs, plan.longest));
  }
  report(progress, "readings without a posterior", 0.0);
  found.readings.push_back(readingRow(found, "2-down-1-up, mean of 6 reversals", two_down, plan.beside_runs,
                                      [](const AskedTest& test) { return reversalMean(test.reversals); }));
  found.readings.push_back(readingRow(found, "mastery 3 of 4, until the first level that fails", mastery,
                                      plan.beside_runs,
                                      [](const AskedTest& test) { return PlainReading{test.first_failed}; }));
  found.readings.push_back(readingRow(found, "mastery 3 of 4, up and down, smallest mastered", mastery,
                                      plan.beside_runs,
                                      [](const AskedTest& test) { return PlainReading{test.level}; }));
  for (std::size_t i = 1; i < found.readings.size(); ++i) found.readings[i].coverage = 0.0;  // levels have no interval
}

void measureRobustness(TrainingMeasurement& found, const Progress& progress) {
  struct Outside {
    std::string name;
    double slope;
    double lapse;
    int easy;
  };
  const std::vector<Outside> all = {{"lapse rate 0", 1.8, 0.0, 0},
                                    {"lapse rate 6 %", 1.8, 0.06, 0},
                                    {"slope 1.2", 1.2, 0.02, 0},
                                    {"slope 2.7", 2.7, 0.02, 0},
                                    {"4 of 40 at the top level", 1.8, 0.02, 4},
                                    {"the same, lapse rate 6 %", 1.8, 0.06, 4}};
  std::size_t cell = 0;
  for (const auto method : {training::Method::marginal_psi, training::Method::two_down_one_up}) {
    for (const Outside& outside : all) {
      report(progress, "robustness", static_cast<double>(cell) / 36.0);
      NamedCells row{method == training::Method::marginal_psi ? outside.name : outside.name + ", 2-down-1-up", {}};
      for (const double truth : {0.07, 0.14, 0.28}) {
        const BlockSettings settings{.method = method, .easy = outside.easy};
        row.cells.push_back(blockCell(settings, {truth, outside.slope, outside.lapse, 1.0 / 12.0},
                                      found.plan.robust_runs, found.plan.seed,
                                      cellNumber(TrainingPart::robust, cell++)));
      }
      found.robust.push_back(std::move(row));
    }
  }
}

void measureStopRules(TrainingMeasurement& found, const Progress& progress) {
  std::size_t cell = 0;
  for (const double half_width : {0.40, 0.35, 0.30}) {
    report(progress, "stop rules", static_cast<double>(cell) / 9.0);
    NamedCells row{half_width == 0.40 ? "0.40" : half_width == 0.35 ? "0.35" : "0.30", {}};
    for (const double truth : {0.07, 0.14, 0.28}) {
      row.cells.push_back(blockCell({.stop = {.least = 20, .most = 60, .half_width = half_width}}, usualTrainee(truth),
                                    found.plan.robust_runs, found.plan.seed,
                                    cellNumber(TrainingPart::stop_rules, cell++)));
    }
    found.stop_rules.push_back(std::move(row));
  }
}

void measureTwoIntervals(TrainingMeasurement& found, const Progress& progress) {
  report(progress, "two intervals", 0.0);
  found.two_intervals.name = "two intervals, 200 trials";
  std::size_t cell = 0;
  for (const double truth : {0.07, 0.14, 0.28}) {
    found.two_intervals.cells.push_back(blockCell({.choices = 2, .stop = {200, 200}}, usualTrainee(truth, 2),
                                                  found.plan.two_runs, found.plan.seed,
                                                  cellNumber(TrainingPart::two_intervals, cell++)));
  }
}

TrainingPlan trainingPlan(bool quick, std::optional<std::size_t> runs) {
  TrainingPlan plan;
  if (quick) {
    plan = {.runs = 600,
            .beside_runs = 100,
            .robust_runs = 0,
            .two_runs = 0,
            .repeats = 0,
            .people = 0,
            .groups = 0,
            .longest = kTestTrials,
            .all = false};
  }
  if (runs) plan.runs = plan.beside_runs = *runs;
  return plan;
}

TrainingMeasurement measureTraining(const TrainingPlan& plan, const Progress& progress) {
  TrainingMeasurement found{.plan = plan, .truths = {0.07, 0.14, 0.28}};
  if (plan.all) found.truths.push_back(0.40);
  measureRecovery(found, progress);
  if (plan.robust_runs > 0) {
    measureRobustness(found, progress);
    measureStopRules(found, progress);
  }
  if (plan.two_runs > 0) measureTwoIntervals(found, progress);
  measureLeftOut(found, progress);
  measureExam(found, progress);
  if (plan.repeats > 0) measurePower(found, progress);
  if (plan.people > 0) {
    measureLearning(found, progress);
    measureChanges(found, progress);
  }
  measureExample(found, progress);
  timeNextLevel(found);
  return found;
}

}  // namespace palpate::study

// Examinations of simulated trainees, and tests of those who leave places out.
#include <algorithm>

#include "palpate/base/random.h"
#include "palpate/training/block.h"
#include "teach/study/training_parts.h"

namespace palpate::study {

using training::Block;
using training::Psychometric;
using training::Verdict;

namespace {

constexpr int kPlaces = 12;
/// An examination's pass mark until examiners have set one.
constexpr double kPassMark = 0.20;

struct LeftOutRun {
  training::ThresholdSummary corrected;
  training::ThresholdSummary naive;
  int usable = 0;
};

/// The same hand, asked twice: by a test that knows which places were felt, and by one that takes every trial as it is.
LeftOutRun leftOutRun(double truth, int searched, std::uint64_t seed) {
  const double ratio = training::idealSlope(searched) / training::idealSlope(kPlaces);
  const Psychometric among{.threshold = truth * training::thresholdFactor(searched, kPlaces),
                           .slope = 1.8 * ratio,
                           .lapse = 0.02,
                           .guess = 1.0 / searched};
  LeftOutRun run;
  for (const bool knows : {true, false}) {
    Block block({}, seed);
    Random random(seed ^ 0x7feb352dull);
    while (!block.finished()) {
      const bool felt = random.below(kPlaces) < static_cast<std::uint64_t>(searched);
      const bool right = felt && random.uniform() < probabilityCorrect(among, block.next().change);
      block.answer(
          {.answer = 1, .correct = right, .visited = knows ? searched : kPlaces, .target_visited = felt || !knows});
    }
    if (knows) run.usable = block.result().trials;
    (knows ? run.corrected : run.naive) = block.result().threshold;
  }
  return run;
}

struct ExamRun {
  Verdict verdict = Verdict::none;
  int trials = 0;
};

ExamRun examRun(const training::StopRule& stop, double truth, std::uint64_t seed) {
  Block block({.stop = stop}, seed);
  Random random(seed ^ 0x846ca68bull);
  while (!block.finished()) {
    const bool right = random.uniform() < probabilityCorrect(usualTrainee(truth), block.next().change);
    block.answer({.answer = 1, .correct = right});
  }
  return {block.result().verdict, block.result().trials};
}

}  // namespace

void measureLeftOut(TrainingMeasurement& found, const Progress& progress) {
  constexpr double kTruth = 0.28;
  const std::size_t runs = found.plan.all ? found.plan.runs : std::min<std::size_t>(found.plan.runs, 200);
  for (const int searched : {12, 8, 6}) {
    report(progress, "places left out", (12 - searched) / 7.0);
    std::vector<LeftOutRun> each(runs);
    const std::uint64_t cell = cellNumber(TrainingPart::exploration, static_cast<std::size_t>(searched));
    parallelFor(runs,
                [&](std::size_t i) { each[i] = leftOutRun(kTruth, searched, runSeed(found.plan.seed, cell, i)); });
    std::vector<training::ThresholdSummary> corrected;
    std::vector<training::ThresholdSummary> naive;
    double usable = 0.0;
    for (const LeftOutRun& run : each) {
      corrected.push_back(run.corrected);
      naive.push_back(run.naive);
      usable += run.usable / static_cast<double>(runs);
    }
    found.exploration.push_back({searched, summariseCell(kTruth, corrected), summariseCell(kTruth, naive), usable});
  }
}

void measureExam(TrainingMeasurement& found, const Progress& progress) {
  const std::vector<double> truths =
      found.plan.all ? std::vector{0.14, 0.17, 0.20, 0.235, 0.28} : std::vector{0.14, 0.28};
  const std::size_t runs = found.plan.all ? found.plan.runs : std::min<std::size_t>(found.plan.runs, 200);
  const training::StopRule fixed{.least = 40, .most = 40, .mark = kPassMark, .sure = 0.5};
  const training::StopRule sequential{.least = 10, .most = 60, .mark = kPassMark};
  for (std::size_t t = 0; t < truths.size(); ++t) {
    report(progress, "examination", static_cast<double>(t) / static_cast<double>(truths.size()));
    std::vector<ExamRun> at_once(runs);
    std::vector<ExamRun> in_turn(runs);
    const std::uint64_t cell = cellNumber(TrainingPart::exam, t);
    parallelFor(runs, [&](std::size_t i) {
      const std::uint64_t seed = runSeed(found.plan.seed, cell, i);
      at_once[i] = examRun(fixed, truths[t], seed);
      in_turn[i] = examRun(sequential, truths[t], seed + 1);
    });
    const auto share = [&](const std::vector<ExamRun>& exams, Verdict verdict) {
      const auto such =
          std::count_if(exams.begin(), exams.end(), [&](const ExamRun& run) { return run.verdict == verdict; });
      return computeShare(static_cast<std::size_t>(such), exams.size());
    };
    ExamRow row{.truth = truths[t],
                .fixed_pass = share(at_once, Verdict::pass),
                .pass = share(in_turn, Verdict::pass),
                .not_yet = share(in_turn, Verdict::not_yet),
                .repeat = share(in_turn, Verdict::repeat)};
    for (const ExamRun& run : in_turn) row.mean_trials += run.trials / static_cast<double>(runs);
    found.exam.push_back(row);
  }
}

}  // namespace palpate::study

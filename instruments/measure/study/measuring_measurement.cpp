#include "measure/study/measuring_measurement.h"

#include <atomic>
#include <functional>
#include <span>

#include "measure/study/corrupted_pairs.h"
#include "palpate/base/background.h"
#include "palpate/base/random.h"
#include "palpate/base/stopwatch.h"
#include "palpate/measure/field/field_fit.h"
#include "palpate/measure/synthesis/synthetic_pair.h"

namespace palpate::study {

namespace {

using measure::SyntheticCase;
using measure::TailFamily;

/// Numbers of streams: the pairs of one are not those of another.
enum class Stream : std::uint64_t { good = 1, corrupted, drifted, half_space, windowed, lopsided, timed, outside };

std::uint64_t streamSeed(std::uint64_t seed, Stream stream, std::size_t i) {
  Random random(seed * 0x2545f4914f6cdd1dull + static_cast<std::uint64_t>(stream) * 1000003u + i);
  return random.bits();
}

/// `work(i)` for every i below `count`, on two threads where there are two; the caller's reports the progress.
void shareOut(std::size_t count, const Progress& progress, std::string_view stage,
              const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  const auto run_pieces = [&](bool tells) {
    for (std::size_t i = next++; i < count; i = next++) {
      if (tells) report(progress, stage, static_cast<double>(i) / static_cast<double>(count));
      work(i);
    }
  };
  if (processors() < 2) return run_pieces(true);
  Background beside([&] { run_pieces(false); });
  try {
    run_pieces(true);
  } catch (...) {
    next = count;  // the other ends after its piece
    throw;
  }
  beside.join();
}

JudgedPair judgeRendered(const SyntheticCase& made) {
  const measure::SyntheticPair pair = measure::renderPair(made);
  return judgePair(made, pair.truth, measure::measurePair(pair.before, pair.after));
}

std::vector<JudgedPair> measureGood(const MeasuringPlan& plan, const Progress& progress) {
  std::vector<JudgedPair> judged(plan.cases);
  shareOut(plan.cases, progress, "good pairs", [&](std::size_t i) {
    const bool large = plan.large_every > 0 && i % plan.large_every == plan.large_every - 1;
    judged[i] = judgeRendered(measure::drawCase(streamSeed(plan.seed, Stream::good, i),
                                                {.megapixels = large ? plan.timed_megapixels : plan.megapixels,
                                                 .family = i % 2 == 0 ? TailFamily::compact : TailFamily::long_tail}));
  });
  return judged;
}

std::vector<JudgedCorrupted> measureCorrupted(const MeasuringPlan& plan, const Progress& progress) {
  std::vector<JudgedCorrupted> judged(corruptedKinds().size() * plan.corrupted_each);
  shareOut(judged.size(), progress, "corrupted pairs", [&](std::size_t i) {
    const std::size_t kind = i / plan.corrupted_each;
    const CorruptedPair pair = corruptedPair(kind, streamSeed(plan.seed, Stream::corrupted, i), plan.megapixels);
    judged[i] = {kind, judgePair(pair.made, pair.truth, measure::measurePair(pair.before, pair.after, pair.settings))};
  });
  return judged;
}

/// Settings that a set of pairs without pixels shares.
struct ExactKind {
  std::string name;
  Stream stream;
  std::vector<TailFamily> families = {TailFamily::compact, TailFamily::long_tail};  ///< by turns
  double drift_mm = 0.3;
  double told_drift_mm = 0.4;
  double asymmetry = 0.0;
};

ExactPairs measureExact(const MeasuringPlan& plan, const ExactKind& kind, const Progress& progress) {
  ExactPairs exact{kind.name, std::vector<JudgedPair>(plan.exact_each)};
  shareOut(plan.exact_each, progress, kind.name, [&](std::size_t i) {
    SyntheticCase made = measure::drawCase(
        streamSeed(plan.seed, kind.stream, i),
        {.megapixels = plan.megapixels, .family = kind.families[i % kind.families.size()], .drift_mm = kind.drift_mm});
    made.press.asymmetry = kind.asymmetry;
    const measure::SyntheticTruth truth = measure::computeTruth(made);
    exact.pairs[i] =
        judgePair(made, truth, measure::measureDots(exactDots(made, truth), {.drift_mm = kind.told_drift_mm}));
  });
  return exact;
}

/// From the bytes of two files to findings.
double timeLarge(const MeasuringPlan& plan, const Progress& progress) {
  report(progress, "a large pair", 0.0);
  const SyntheticCase made =
      measure::drawCase(streamSeed(plan.seed, Stream::timed, 0), {.megapixels = plan.timed_megapixels});
  std::vector<std::vector<std::uint8_t>> files;
  for (const measure::Moment moment : {measure::Moment::before, measure::Moment::after}) {
    files.push_back(measure::jpegBytes(measure::renderPicture(made, moment), made.look.jpeg_quality));
  }
  report(progress, "a large pair", 0.8);
  const auto start = Clock::now();
  const measure::Photograph before = measure::decodePhotograph(std::as_bytes(std::span(files[0])), "before.jpg");
  const measure::Photograph after = measure::decodePhotograph(std::as_bytes(std::span(files[1])), "after.jpg");
  measure::measurePair(before, after);
  return secondsSince(start);
}

/// A hundred fits, to the dots of ten presses by turns.
double timeFits(const MeasuringPlan& plan) {
  std::vector<std::vector<measure::FieldDatum>> data;
  for (std::size_t i = 0; i < 10; ++i) {
    const SyntheticCase made = measure::drawCase(streamSeed(plan.seed, Stream::timed, i), {.megapixels = 0.5});
    Random random(i);
    std::vector<measure::FieldDatum> dots;
    for (const measure::TrueDot& dot : measure::computeTruth(made).dots) {
      const Vec2 noise = 0.1 * random.normal2();
      dots.push_back(
          {dot.skin_mm, dot.moved_mm + noise, {dot.skin_mm.x(), -dot.skin_mm.y()}, Mat2(Vec2(1.0, -1.0).asDiagonal())});
    }
    data.push_back(std::move(dots));
  }
  const measure::DriftPrior prior = measure::makeDriftPrior(0.4);
  const auto start = Clock::now();
  for (std::size_t i = 0; i < 100; ++i) measure::fitField(data[i % data.size()], prior);
  return secondsSince(start);
}

}  // namespace

MeasuringPlan measuringPlan(bool quick) {
  if (!quick) return {};
  return {.cases = 8, .megapixels = 1.0, .large_every = 0, .corrupted_each = 1, .exact_each = 8};
}

ExactPairs measureOutside(OutsideFamily family, std::uint64_t seed, std::size_t count, const Progress& progress) {
  const OutsideFields fields(family, seed, progress);
  ExactPairs exact{std::string(nameOf(family)), std::vector<JudgedPair>(count)};
  shareOut(count, progress, exact.name, [&](std::size_t i) {
    const SyntheticCase made = fields.makeCase(streamSeed(seed, Stream::outside, i), i);
    const measure::SyntheticTruth truth = measure::computeTruth(made);
    exact.pairs[i] = judgePair(made, truth, measure::measureDots(exactDots(made, truth)));
  });
  return exact;
}

MeasuringMeasurement measureMeasuring(const MeasuringPlan& plan, const Progress& progress) {
  const measure::OneThread one_thread;
  MeasuringMeasurement found;
  found.plan = plan;
  found.good = measureGood(plan, progress);
  found.corrupted = measureCorrupted(plan, progress);
  found.drifted = measureExact(plan, {.name = "drift of 1.5 mm", .stream = Stream::drifted, .drift_mm = 1.5}, progress);
  found.breathing = measureExact(
      plan, {.name = "drift of 1.5 mm, told", .stream = Stream::drifted, .drift_mm = 1.5, .told_drift_mm = 1.5},
      progress);
  found.half_space = measureExact(
      plan, {.name = "half space", .stream = Stream::half_space, .families = {TailFamily::half_space}}, progress);
  found.windowed = measureExact(
      plan, {.name = "windowed half space", .stream = Stream::windowed, .families = {TailFamily::windowed_half_space}},
      progress);
  found.lopsided =
      measureExact(plan, {.name = "20 % stronger behind", .stream = Stream::lopsided, .asymmetry = 0.2}, progress);
  found.large_s = timeLarge(plan, progress);
  found.hundred_fits_s = timeFits(plan);
  return found;
}

}  // namespace palpate::study

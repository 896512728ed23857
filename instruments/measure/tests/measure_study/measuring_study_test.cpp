// The study of measuring: its arithmetic on pairs made by hand, its sentences, and a small cut of the measurement
// itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "measure/study/corrupted_pairs.h"
#include "measure/study/measuring_measurement.h"
#include "measure/study/measuring_numbers.h"
#include "measure/study/outside_fields.h"
#include "measure/study/outside_study.h"
#include "palpate/base/error.h"
#include "report/tests/report/says.h"

namespace palpate::study {

namespace {

using measure::TailFamily;

/// Accepted, its half axes off by so many percent with an sd of 2 %.
JudgedPair pairOff(double percent, TailFamily family = TailFamily::compact) {
  JudgedPair pair;
  pair.family = family;
  pair.true_ratio = 1.4;
  pair.accepted = pair.fitted = true;
  pair.at_2_mm = {{percent, 2.0}, {-0.5 * percent, 2.0}};
  pair.at_4_mm = {{0.5 * percent, 2.0}, {0.1, 2.0}};
  pair.found_before = pair.found_after = pair.in_order = 1.0;
  pair.matched = 100;
  pair.peak_stated = true;
  return pair;
}

JudgedPair refusedAs(const std::string& code) {
  JudgedPair pair;
  pair.refusals = {code};
  return pair;
}

/// Where everything is as it should be.
MeasuringMeasurement someMeasuring() {
  MeasuringMeasurement found;
  for (int i = 0; i < 10; ++i) {
    found.good.push_back(pairOff(1.0, TailFamily::compact));
    found.good.push_back(pairOff(3.0, TailFamily::long_tail));
  }
  for (std::size_t kind = 0; kind < corruptedKinds().size(); ++kind) {
    found.corrupted.push_back(
        {kind, corruptedKinds()[kind].fate == Fate::refused ? refusedAs("misfit") : pairOff(2.0)});
  }
  found.drifted.pairs.assign(10, refusedAs("moved"));
  for (ExactPairs* set : {&found.breathing, &found.half_space, &found.windowed, &found.lopsided}) {
    set->pairs.assign(10, pairOff(2.0));
  }
  found.large_s = 1.0;
  found.hundred_fits_s = 0.1;
  return found;
}

double numberNamed(const MeasuringMeasurement& found, const std::string& name) {
  for (const auto& [key, value] : measuringPairs(found)) {
    if (key == name) return value;
  }
  return std::nan("");
}

/// Painted and measured once for all tests.
const MeasuringMeasurement& smallMeasuring() {
  static const MeasuringMeasurement found = measureMeasuring(
      {.seed = 5, .cases = 6, .large_every = 0, .corrupted_each = 0, .exact_each = 6, .timed_megapixels = 1.0}, {});
  return found;
}

}  // namespace

TEST(MeasuringNumbers, AreOfTheWorseAxisOfAcceptedPairs) {
  JudgedPair wild = pairOff(50.0);
  wild.accepted = false;
  const SetNumbers set = numbersOf({pairOff(1.0), pairOff(-3.0), pairOff(5.0), wild});
  EXPECT_EQ(set.pairs, 4u);
  EXPECT_EQ(set.accepted, 3u);
  EXPECT_DOUBLE_EQ(set.axis2_percent.median, 3.0);
  EXPECT_DOUBLE_EQ(set.worst_axis_percent, 5.0);
  EXPECT_DOUBLE_EQ(set.worst_axis_sds, 2.5);
  EXPECT_NEAR(set.within_2_sd, 2.0 / 3.0, 1e-12);
}

TEST(MeasuringNumbers, RoundEllipsesHaveNoDirectionToJudge) {
  JudgedPair round = pairOff(1.0);
  round.true_ratio = 1.05;
  round.direction_error_deg = 40.0;
  JudgedPair directed = pairOff(1.0);
  directed.direction_error_deg = 1.0;
  EXPECT_DOUBLE_EQ(numbersOf({round, directed}).direction_deg.p95, 1.0);
}

TEST(MeasuringNumbers, CountBadPairsAndWhatBecameOfThem) {
  MeasuringMeasurement found = someMeasuring();
  EXPECT_DOUBLE_EQ(numberNamed(found, "bad_pairs"), 12.0);
  EXPECT_DOUBLE_EQ(numberNamed(found, "bad_pairs_rejected"), 12.0);
  EXPECT_DOUBLE_EQ(numberNamed(found, "worst_axis_percent"), 3.0);
  found.corrupted[0].judged = pairOff(1.0);
  EXPECT_DOUBLE_EQ(numberNamed(found, "bad_pairs_rejected"), 11.0);
  found.corrupted[12].judged = pairOff(30.0);  // hard, accepted and wrong
  EXPECT_DOUBLE_EQ(numberNamed(found, "worst_axis_percent"), 30.0);
  EXPECT_DOUBLE_EQ(numberNamed(found, "drift_1_5_rejected_share"), 1.0);
}

TEST(MeasuringNumbers, HaveTheNamesThatProgramsKnow) {
  const MeasuringMeasurement found = someMeasuring();
  for (const char* name : {"accepted_share", "axis2_p95_percent", "axis2_compact_p95_percent", "axis4_p95_percent",
                           "ratio_p95", "direction_p95_deg", "contact_p95_mm", "worst_axis_percent",
                           "within_2_sd_share", "bad_pairs", "bad_pairs_rejected", "seconds_12_mp"}) {
    EXPECT_FALSE(std::isnan(numberNamed(found, name))) << name;
  }
}

TEST(MeasuringFindings, SayThatBarsAreMetOnlyWhereTheyAre) {
  MeasuringMeasurement found = someMeasuring();
  EXPECT_TRUE(says(measuringFindings(found), "All 23 bars are met by 20 drawn pairs"));
  found.large_s = 2.5;
  EXPECT_TRUE(says(measuringFindings(found), "NOT: a pair of 12 megapixels, one core (2.50 s, asked for <= 2 s)"));
}

TEST(MeasuringFindings, SayWhatIsLetThroughAndWhatIsWrong) {
  MeasuringMeasurement found = someMeasuring();
  EXPECT_TRUE(says(measuringFindings(found), "Of 12 pairs that something is wrong with 12 are refused. Of pairs that"));
  EXPECT_TRUE(says(measuringFindings(found), "none is accepted and wrong"));
  found.corrupted[1].judged = pairOff(1.0);
  EXPECT_TRUE(says(measuringFindings(found), "LET THROUGH: another person"));
  found.corrupted[13].judged = pairOff(30.0);
  EXPECT_TRUE(says(measuringFindings(found), "ACCEPTED AND WRONG: 40 dots missing"));
}

TEST(MeasuringFindings, CallAnSdHonestOnlyWhereItIs) {
  MeasuringMeasurement found = someMeasuring();
  EXPECT_TRUE(says(measuringFindings(found), "is honest"));
  found.good[0] = pairOff(9.0);  // 4.5 sd
  EXPECT_TRUE(says(measuringFindings(found), "TOO SMALL"));
  found = someMeasuring();
  for (JudgedPair& pair : found.good) pair = pairOff(5.0);
  EXPECT_TRUE(says(measuringFindings(found), "TOO SMALL"));
}

TEST(MeasuringFindings, SayWhetherADriftIsNoticed) {
  MeasuringMeasurement found = someMeasuring();
  EXPECT_TRUE(says(measuringFindings(found), "is noticed (100 %"));
  found.drifted.pairs.assign(10, pairOff(20.0));
  EXPECT_TRUE(says(measuringFindings(found), "is often NOT noticed"));
}

TEST(CorruptedPairs, AreCorruptedAsTheirNamesSay) {
  for (std::size_t kind = 0; kind < corruptedKinds().size(); ++kind) {
    if (corruptedKinds()[kind].name == "black and white") {
      const CorruptedPair pair = corruptedPair(kind, 3, 0.5);
      EXPECT_EQ(pair.before.rgb[3000], pair.before.rgb[3001]);
    } else if (corruptedKinds()[kind].name == "pictures swapped") {
      const CorruptedPair pair = corruptedPair(kind, 3, 0.5);
      EXPECT_GT(pair.before.taken_at_s.value_or(0.0), pair.after.taken_at_s.value_or(0.0));
    } else if (corruptedKinds()[kind].name == "40 dots missing") {
      const CorruptedPair pair = corruptedPair(kind, 3, 0.5);
      EXPECT_EQ(static_cast<int>(pair.truth.dots.size()), pair.made.marks.columns * pair.made.marks.rows - 40);
    }
  }
}

TEST(ExactDots, LieAtTheTruthWithTheirNoise) {
  const measure::SyntheticCase made = measure::drawCase(9);
  const measure::SyntheticTruth truth = computeTruth(made);
  const measure::DotPair pair = exactDots(made, truth, 0.1);
  ASSERT_EQ(pair.before.size(), truth.dots.size());
  EXPECT_LT(pair.after.size(), pair.before.size()) << "the hand hides some";
  double squares = 0.0;
  for (std::size_t i = 0; i < truth.dots.size(); ++i) {
    squares += (pair.before[i].place_px - truth.dots[i].before_px).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares / (2.0 * static_cast<double>(truth.dots.size()))) / truth.px_per_mm, 0.1, 0.015);
}

TEST(JudgedPairs, OfATruthThatIsMeasuredExactlyAreRight) {
  // Nothing moved but the skin, marks as the stencil has them, seen without noise.
  measure::SyntheticCase made = measure::drawCase(11, {.family = TailFamily::compact, .drift_mm = 0.0});
  made.marks.jitter_mm = 0.0;
  made.camera.tilt_rad = 0.0;
  made.press.dent_mm = 0.0;
  const measure::SyntheticTruth truth = computeTruth(made);
  const JudgedPair judged = judgePair(made, truth, measure::measureDots(exactDots(made, truth, 0.0)));
  EXPECT_TRUE(judged.accepted) << judged.reason;
  EXPECT_LT(judged.at_2_mm.worsePercent(), 1.5);
  EXPECT_LT(judged.contact_error_mm, 1.0);
  EXPECT_LT(judged.drag_error_deg, 1.0);
  EXPECT_EQ(judged.wrong_matches, 0u);
  EXPECT_EQ(judged.found_before, 1.0);
}

TEST(MeasuringStudy, ASmallCutComesNearTheBars) {
  const SetNumbers good = numbersOf(smallMeasuring().good);
  EXPECT_GE(good.accepted, 4u);
  EXPECT_LT(good.axis2_percent.median, 5.0);
  EXPECT_LT(good.worst_axis_percent, 20.0);
  EXPECT_LT(numbersOf(ofFamily(smallMeasuring().good, TailFamily::compact)).worst_axis_percent, 6.0);
  EXPECT_LT(good.ratio.median, 0.04);
  EXPECT_LT(good.contact_mm.p95, 4.0);
  EXPECT_GE(refusedAsMoved(smallMeasuring().drifted.pairs), 0.7);
  const DotNumbers dots = dotNumbers(smallMeasuring().good);
  EXPECT_GT(dots.found_mean, 0.95);
  EXPECT_LT(dots.wrong_per_1000, 5.0);
}

TEST(MeasuringStudy, IsTheSameEveryTime) {
  const MeasuringPlan plan{.seed = 8,
                           .cases = 2,
                           .megapixels = 0.5,
                           .large_every = 0,
                           .corrupted_each = 0,
                           .exact_each = 3,
                           .timed_megapixels = 0.5};
  const MeasuringMeasurement first = measureMeasuring(plan, {});
  const MeasuringMeasurement again = measureMeasuring(plan, {});
  for (std::size_t i = 0; i < first.good.size(); ++i) {
    EXPECT_EQ(first.good[i].seed, again.good[i].seed);
    EXPECT_EQ(first.good[i].at_2_mm.major.percent, again.good[i].at_2_mm.major.percent);
  }
  for (std::size_t i = 0; i < first.half_space.pairs.size(); ++i) {
    EXPECT_EQ(first.half_space.pairs[i].direction_error_deg, again.half_space.pairs[i].direction_error_deg);
  }
  EXPECT_NE(first.good[0].seed, first.good[1].seed);
  EXPECT_NE(first.good[0].seed, smallMeasuring().good[0].seed) << "another seed, other pairs";
}

TEST(OutsideFields, SharesCountWhatIsStatedAndWhatHolds) {
  std::vector<JudgedPair> pairs = {pairOff(1.0), pairOff(9.0), refusedAs("unsure")};
  pairs[0].peak = {30.0, 10.0};
  pairs[1].peak_stated = false;
  pairs[1].warnings = {"no_peak"};
  const OutsideNumbers n = outsideNumbers(pairs);
  EXPECT_EQ(n.accepted, 2u);
  EXPECT_EQ(n.peaks, 1u) << "one is not stated";
  EXPECT_DOUBLE_EQ(n.axes_within_2sd, 0.5) << "9 % with an sd of 2 %";
  EXPECT_DOUBLE_EQ(n.peak_within_2sd, 0.0) << "30 % with an sd of 10 %";
  EXPECT_DOUBLE_EQ(n.warned_share, 0.5);
  EXPECT_DOUBLE_EQ(n.missed_warned_share, 1.0) << "the one that is off is warned of";
  EXPECT_DOUBLE_EQ(outsideNumbers({}).peak_within_2sd, 1.0);
}

TEST(OutsideFields, EveryFamilyHasItsPeakAtTheContactAndAContour) {
  for (const OutsideFamily family : {OutsideFamily::boussinesq, OutsideFamily::exponential, OutsideFamily::irregular}) {
    SCOPED_TRACE(nameOf(family));
    EXPECT_EQ(parseOutsideFamily(nameOf(family)), family);
    const OutsideFields fields(family, 3, {});
    const measure::SyntheticCase made = fields.makeCase(11, 0);
    EXPECT_NEAR(made.press.given(Vec2::Zero()).norm(), made.press.peak_mm, 1e-9);
    const measure::SyntheticTruth truth = measure::computeTruth(made);
    EXPECT_GT(truth.at_2_mm.half_minor_mm.value, truth.at_4_mm.half_minor_mm.value);
    EXPECT_GT(truth.at_4_mm.half_minor_mm.value, 5.0);
  }
  EXPECT_THROW(parseOutsideFamily("rubber"), Error);
}

TEST(OutsideFields, TheSdOfAnExponentialHolds) {
  const ExactPairs found = measureOutside(OutsideFamily::exponential, 4, 8, {});
  const OutsideNumbers n = outsideNumbers(found.pairs);
  EXPECT_GE(n.accepted, 5u);
  EXPECT_GE(n.axes_within_2sd, 0.8);
  EXPECT_GE(n.peak_within_2sd, 0.8);
}

}  // namespace palpate::study

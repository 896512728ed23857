// The pipeline from marks to a verdict: presses that must pass, and corrupted ones, each refused for its own reason.
#include "palpate/measure/measurement.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "measure/tests/measure/drawn_dots.h"
#include "palpate/base/error.h"
#include "palpate/measure/field_report.h"
#include "palpate/measure/skin_chart.h"
#include "palpate/measure/synthesis/synthetic_pair.h"

namespace palpate::measure {
namespace {

TEST(Measurement, OfAPressOnATiltedSheetIsItsEllipse) {
  const DrawnSheet sheet{.tilt_deg = 15.0};
  const Measurement m = measureDots(drawnDots(sheet, drag(18.0, 95.0, 70.0, 60.0), 0.1));
  ASSERT_TRUE(m.accepted()) << (m.findings.empty() ? "no fit" : m.findings.front().text);
  EXPECT_EQ(m.matched, 120u);
  EXPECT_NEAR(m.fit->at_2_mm.half_major_mm.value, 95.0, 2.0);
  EXPECT_NEAR(m.fit->at_2_mm.half_minor_mm.value, 70.0, 2.0);
  EXPECT_NEAR(m.fit->at_2_mm.direction_deg.value, 60.0, 2.0);
  EXPECT_NEAR(m.fit->drag_deg.value, 90.0, 1.5);
  EXPECT_LT((m.chart->pictureAt(m.fit->field.contact_mm) - seen(sheet, {0.0, 0.0})).norm() / sheet.px_per_mm, 1.0);
  ASSERT_TRUE(m.contour);
  EXPECT_NEAR(m.contour->half_chord_mm, 95.0, 4.0);
}

std::string textOf(const std::vector<Finding>& findings, const std::string& code) {
  const auto found =
      std::find_if(findings.begin(), findings.end(), [&](const Finding& finding) { return finding.code == code; });
  return found == findings.end() ? "" : found->text;
}

TEST(Measurement, ItsVerdictNamesTheLimitThatHoldsAndACircleOnlyWhereThereIsOne) {
  Measurement m = measureDots(drawnDots({}, drag(18.0, 95.0, 70.0, 60.0), 0.1));
  ASSERT_TRUE(m.fit);
  KeyEllipse& key = m.fit->at_2_mm;
  key.half_major_mm.sd = 0.065 * key.half_major_mm.value;
  EXPECT_NE(textOf(judgeFit(m, 0), "imprecise").find("6.5 %"), std::string::npos);
  EXPECT_TRUE(textOf(judgeFit(m, 0), "unsure").empty());
  key.half_major_mm.sd = 0.084 * key.half_major_mm.value;
  EXPECT_NE(textOf(judgeFit(m, 0), "unsure").find("8.4 % only (the limit is 8 %)"), std::string::npos);
  key.direction_deg.sd = 20.0;
  key.major_over_minor.value = 1.57;
  EXPECT_NE(textOf(judgeFit(m, 0), "direction_unsure").find("1.57"), std::string::npos);
  EXPECT_EQ(textOf(judgeFit(m, 0), "direction_unsure").find("circle"), std::string::npos);
  key.major_over_minor.value = 1.04;
  EXPECT_NE(textOf(judgeFit(m, 0), "direction_unsure").find("nearly a circle"), std::string::npos);
}

TEST(Measurement, ReadsTheHeadWhereItIsSaidToBe) {
  const DotPair pair = drawnDots({}, drag(18.0, 95.0, 70.0, 60.0));
  const Measurement m = measureDots(pair, {.head = HeadTowards::left});
  ASSERT_TRUE(m.fit);
  // Turned by a quarter clockwise, 60 degrees are -30.
  EXPECT_NEAR(m.fit->at_2_mm.direction_deg.value, -30.0, 1.0);
  EXPECT_NEAR(m.fit->drag_deg.value, 0.0, 1.0);
}

TEST(Measurement, ReportsDotsUnderTheHandAndDoesNotGuessThem) {
  DotPair pair = drawnDots({}, drag(18.0, 80.0, 70.0, 0.0), 0.05);
  for (const std::size_t hidden : {34u, 24u, 14u, 4u}) pair.after.erase(pair.after.begin() + hidden);
  const Measurement m = measureDots(pair);
  EXPECT_TRUE(m.accepted());
  EXPECT_EQ(m.matched, 116u);
  EXPECT_EQ(std::count_if(m.dots.begin(), m.dots.end(), [](const MeasuredDot& d) { return !d.after_px; }), 4);
}

TEST(Measurement, DoesNotGoByADotThatIsHalfCovered) {
  DotPair pair = drawnDots({}, drag(18.0, 80.0, 70.0, 0.0), 0.05);
  pair.after[33].area_px *= 0.5;  // and its middle is no longer where its ink is
  pair.after[33].place_px.x() += 3.0;
  EXPECT_EQ(measureDots(pair).matched, 119u);
}

TEST(Measurement, RefusesFewDots) {
  const Measurement m = measureDots(drawnDots({.columns = 5, .rows = 5}, drag(15.0, 60.0, 50.0, 0.0)));
  EXPECT_TRUE(says(m.findings, "few_dots"));
  EXPECT_FALSE(m.accepted());
  EXPECT_FALSE(measureDots({}).accepted());
}

TEST(Measurement, RefusesWhatWasNotPressed) {
  const Measurement m = measureDots(drawnDots({}, atRest, 0.05));
  EXPECT_TRUE(says(m.findings, "not_pressed"));
  EXPECT_FALSE(m.accepted());
}

TEST(Measurement, RefusesABodyThatMoved) {
  const auto press = drag(15.0, 80.0, 60.0, 0.0);
  const auto with_shift = [&](const Vec2& p) { return Vec2(press(p) + Vec2(1.5, 1.0)); };
  const Measurement m = measureDots(drawnDots({}, with_shift, 0.05));
  EXPECT_TRUE(says(m.findings, "moved"));
  EXPECT_FALSE(m.accepted());
  EXPECT_FALSE(says(measureDots(drawnDots({}, with_shift, 0.05), {.drift_mm = 1.5}).findings, "moved"));
}

TEST(Measurement, RefusesAnEllipseThatLeavesTheDotsUnlessThatIsAllowed) {
  const DotPair pair = drawnDots({.columns = 9, .rows = 9}, drag(20.0, 260.0, 200.0, 0.0));
  EXPECT_TRUE(says(measureDots(pair).findings, "leaves_dots"));
  EXPECT_FALSE(says(measureDots(pair, {.partial = true}).findings, "leaves_dots"));
}

TEST(Measurement, MindsNoMissingDotsAtTheContactButAContactBesideTheDots) {
  DotPair pair = drawnDots({.columns = 11}, drag(15.0, 80.0, 60.0, 0.0, {4.0, 4.0}), 0.05);
  for (const std::size_t missing : {71u, 60u}) {
    pair.before.erase(pair.before.begin() + missing);
    pair.after.erase(pair.after.begin() + missing);
  }
  EXPECT_TRUE(measureDots(pair).accepted());
  const Measurement beside =
      measureDots(drawnDots({}, drag(25.0, 80.0, 60.0, 0.0, {0.0, 185.0}), 0.05), {.partial = true});
  EXPECT_TRUE(says(beside.findings, "contact_outside"));
}

TEST(Measurement, RefusesIrregularMarks) {
  const Measurement m = measureDots(drawnDots({}, drag(15.0, 80.0, 60.0, 0.0), 2.8));
  EXPECT_TRUE(says(m.findings, "irregular")) << m.grid.irregularity << " " << m.grid.dots.size();
}

TEST(Measurement, RefusesAGridThatLiesAslant) {
  EXPECT_TRUE(says(measureDots(drawnDots({.roll_deg = 42.0}, drag(15.0, 80.0, 60.0, 0.0))).findings, "roll"));
}

TEST(Measurement, RefusesAFirstPictureThatHidesWhatTheSecondShows) {
  DotPair pair = drawnDots({}, drag(15.0, 80.0, 60.0, 0.0), 0.05);
  for (const std::size_t hidden : {55u, 45u, 35u, 25u, 15u}) pair.before.erase(pair.before.begin() + hidden);
  EXPECT_TRUE(says(measureDots(pair).findings, "swapped"));
}

TEST(Measurement, RefusesThousandsOfMarksAtOnce) {
  const DotPair pair = drawnDots({.columns = 40, .rows = 40}, atRest);
  const Measurement m = measureDots(pair);
  EXPECT_TRUE(says(m.findings, "many_marks"));
  EXPECT_FALSE(m.accepted());
}

TEST(Measurement, WarnsOfAContactThatWasMarkedElsewhere) {
  const DrawnSheet sheet;
  const DotPair pair = drawnDots(sheet, drag(15.0, 80.0, 60.0, 0.0), 0.05);
  EXPECT_FALSE(says(measureDots(pair, {.contact_px = seen(sheet, {0.5, 0.5})}).findings, "contact_differs"));
  const Measurement far = measureDots(pair, {.contact_px = seen(sheet, {0.0, 15.0})});
  EXPECT_TRUE(says(far.findings, "contact_differs"));
  EXPECT_TRUE(far.accepted()) << "axes and direction are right all the same";
}

TEST(Measurement, RefusesSettingsThatMeanNothing) {
  EXPECT_THROW(measureDots({}, {.spacing_mm = 0.0}), Error);
  EXPECT_THROW(measureDots({}, {.drift_mm = std::nan("")}), Error);
  EXPECT_THROW(measureDots({}, {.contact_px = Vec2(std::nan(""), 0.0)}), Error);
}

TEST(Measurement, OfAPaintedPairIsItsTruth) {
  const SyntheticPair pair = renderPair(drawCase(2));
  const Measurement m = measurePair(pair.before, pair.after);
  ASSERT_TRUE(m.fit);
  const KeyEllipse& truth = pair.truth.at_2_mm;
  EXPECT_NEAR(m.fit->at_2_mm.half_major_mm.value, truth.half_major_mm.value, 0.05 * truth.half_major_mm.value);
  EXPECT_NEAR(m.fit->at_2_mm.half_minor_mm.value, truth.half_minor_mm.value, 0.05 * truth.half_minor_mm.value);
  EXPECT_NEAR(m.fit->drag_deg.value, pair.truth.drag_deg, 3.0);
  std::size_t found = 0;
  for (const TrueDot& dot : pair.truth.dots) {
    found += static_cast<std::size_t>(std::any_of(m.dots.begin(), m.dots.end(), [&](const MeasuredDot& measured) {
      return (measured.before_px - dot.before_px).norm() < 0.5 * pair.truth.px_per_mm;
    }));
  }
  EXPECT_GE(found, pair.truth.dots.size() * 9 / 10);
  // Taken the wrong way round, the cameras' clocks say so.
  Photograph before = pair.before;
  Photograph after = pair.after;
  before.taken_at_s = 100.0;
  after.taken_at_s = 90.0;
  EXPECT_TRUE(says(measurePair(before, after).findings, "swapped"));
  after.width_px /= 2;
  after.height_px *= 2;
  EXPECT_THROW(measurePair(before, after), Error);
}

TEST(NullDrift, IsHowFarTheBodyMovedBetweenTwoPicturesAtRest) {
  SyntheticCase made = drawCase(3);
  made.null_motion = {.shift_mm = {1.0, 0.0, 0.0}};
  const std::optional<double> drift =
      nullDrift(renderPicture(made, Moment::before), renderPicture(made, Moment::again), {});
  ASSERT_TRUE(drift);
  EXPECT_NEAR(*drift, 1.0, 0.15);
}

}  // namespace
}  // namespace palpate::measure

// Larger arrays err less, at the order that theory has, and the page says so.
#include "dissertation/studies.h"

#include <gtest/gtest.h>

#include "dissertation/profile/array_quality.h"
#include "report/tests/report/page_numbers.h"
#include "report/tests/report/texts_apart.h"

namespace palpate::study {

namespace {

using tissue::TableLookup;

std::vector<ArrayQuality> doubledSizes(TableLookup lookup) {
  std::vector<ArrayQuality> sweep;
  for (const int entries : {33, 65, 129, 257, 513}) sweep.push_back(arrayQuality(entries, lookup, {}));
  return sweep;
}

}  // namespace

TEST(ArrayQuality, NearestErrsHalfAsMuchWithTwiceTheEntries) {
  const auto sweep = doubledSizes(TableLookup::nearest);
  EXPECT_NEAR(convergenceSlope(sweep), -1.0, 0.03);
  for (std::size_t i = 1; i < sweep.size(); ++i) EXPECT_LT(sweep[i].error_mm, sweep[i - 1].error_mm);
}

TEST(ArrayQuality, LinearErrsAQuarterAsMuchWithTwiceTheEntries) {
  EXPECT_NEAR(convergenceSlope(doubledSizes(TableLookup::linear)), -2.0, 0.03);
}

TEST(ArrayQuality, LinearErrorIsThatOfAChord) {
  // h^2 / 8 of the largest curvature, which the half Gaussian has under the finger: 2 * 1.96 pi.
  const double h = 1.0 / 512.0;
  const double chord_mm = 10.0 * h * h / 8.0 * 2.0 * 1.96 * 3.14159265358979;
  EXPECT_NEAR(arrayQuality(513, TableLookup::linear, {}).error_mm, chord_mm, 0.01 * chord_mm);
}

TEST(ArrayQuality, AStepOfTheNearestEntryTurnsFinerMeshesMore) {
  const SkinSection coarse{.spacing_mm = 10.0};
  const SkinSection fine{.spacing_mm = 0.5};
  EXPECT_GT(arrayQuality(130, TableLookup::nearest, fine).turn_deg,
            10.0 * arrayQuality(130, TableLookup::nearest, coarse).turn_deg);
  EXPECT_LT(arrayQuality(700, TableLookup::linear, fine).turn_deg, 0.1);
}

TEST(ProfileStudy, SaysWhatTheArraysErr) {
  const StudyPage page = studyProfile({.quick = true});
  EXPECT_NEAR(numberOf(page, "error_mm_nearest_20"), 0.56, 0.01);  // the reference's numbers
  EXPECT_NEAR(numberOf(page, "error_mm_nearest_130"), 0.083, 0.001);
  EXPECT_NEAR(numberOf(page, "error_mm_nearest_700"), 0.015, 0.001);
  EXPECT_NEAR(numberOf(page, "error_mm_linear_130"), 0.0009, 0.0001);
  for (const StudyFigure& figure : page.figures) expectTextsApart(figure.figure, figure.stem);
}

}  // namespace palpate::study

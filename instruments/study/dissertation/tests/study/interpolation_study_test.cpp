// Interpolations are exact where they must be, and a point left out is really left out.
#include "dissertation/studies.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dissertation/interpolation/interpolation_findings.h"
#include "dissertation/interpolation/left_out.h"
#include "report/tests/report/page_numbers.h"
#include "report/tests/report/texts_apart.h"

namespace palpate::study {

namespace {

using maps::ForceDirection;

// The tensor changes linearly over the plane, so that a plane foresees it exactly.
TensorSet linearSet() {
  TensorSet set = meanSet(ForceDirection::up);
  for (PlacedTensor& key : set) {
    key.tensor = {5.0 + 0.001 * key.place_mm.y(), 0.1 + 0.0002 * key.place_mm.y(), 0.0003 * key.place_mm.x()};
  }
  return set;
}

}  // namespace

TEST(LeftOut, SetsHoldFivePointsAndTwoMirrorImages) {
  EXPECT_EQ(meanSet(ForceDirection::down).size(), 7u);
  EXPECT_EQ(subjectSets(ForceDirection::up).size(), 5u);
  EXPECT_EQ(subjectSets(ForceDirection::down).size(), 3u);
  const TensorSet set = meanSet(ForceDirection::up);
  for (const PlacedTensor& image : set) {
    if (!image.mirrored) continue;
    const maps::Ellipse ellipse = maps::ellipseOf(image.tensor);
    const auto keys = maps::dissertationKeyPoints();
    EXPECT_NEAR(ellipse.half_major_mm, keys.at(static_cast<std::size_t>(image.point + 1)).ellipse.half_major_mm, 1e-9);
    EXPECT_NEAR(ellipse.direction_rad, keys.at(static_cast<std::size_t>(image.point + 1)).ellipse.direction_rad, 1e-9);
  }
}

TEST(LeftOut, GriAndThinPlateAreExactAtEveryKey) {
  const TensorSet set = meanSet(ForceDirection::up);
  for (const Interpolator interpolator : {Interpolator::gri, Interpolator::gri_mean, Interpolator::thin_plate}) {
    const auto field = fieldThrough(set, interpolator, 200.0);
    for (const PlacedTensor& key : set) EXPECT_LT(boundaryRmsMm((*field)(key.place_mm), key.tensor), 1e-6);
  }
}

TEST(LeftOut, APlaneForeseesWhatChangesLinearly) {
  EXPECT_LT(leftOutErrors({linearSet()}, Interpolator::plane, 200.0).rms_mm, 1e-6);
  EXPECT_LT(leftOutErrors({linearSet()}, Interpolator::thin_plate, 200.0).rms_mm, 1e-6);
  EXPECT_GT(leftOutErrors({linearSet()}, Interpolator::mean, 200.0).rms_mm, 1.0);
}

TEST(LeftOut, APointThatIsLeftOutDoesNotForetellItself) {
  // Nothing of P1's neighbours reaches it with 10 mm: the basic circle is predicted everywhere.
  const TensorSet set = meanSet(ForceDirection::up);
  const maps::LogTensor circle(std::log(150.0), 0.0, 0.0);
  double squares = 0.0;
  for (const PlacedTensor& key : set) {
    if (!key.mirrored) squares += std::pow(boundaryRmsMm(circle, key.tensor), 2.0) / 5.0;
  }
  const LeftOutErrors errors = leftOutErrors({set}, Interpolator::gri, 10.0);
  EXPECT_EQ(errors.predicted, 5);
  EXPECT_NEAR(errors.rms_mm, std::sqrt(squares), 1e-9);
}

TEST(LeftOut, DegreeTwoIsNotDeterminedByFiveKeys) {
  EXPECT_GT(leftOutErrors({meanSet(ForceDirection::up)}, Interpolator::quadratic, 200.0).undetermined, 0);
}

TEST(LeftOut, BoundariesOfCirclesDifferByTheirRadii) {
  EXPECT_NEAR(boundaryRmsMm({std::log(150.0), 0, 0}, {std::log(120.0), 0, 0}), 30.0, 1e-9);
}

TEST(InterpolationStudy, FindsTheRadiusOfFigure59AndDrawsReadableFigures) {
  const RadiusRange range = radiiOfFigure59();
  EXPECT_NEAR(range.from, 190.0, 1.0);  // the reference's 190 to 228
  EXPECT_NEAR(range.to, 228.0, 1.0);
  const StudyPage page = studyInterpolation({.quick = true});
  EXPECT_LT(numberOf(page, "left_out_gri_rms_mm"), numberOf(page, "left_out_mean_rms_mm"));
  for (const StudyFigure& figure : page.figures) expectTextsApart(figure.figure, figure.stem);
}

}  // namespace palpate::study

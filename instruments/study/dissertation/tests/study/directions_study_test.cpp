// A tensor knows that an axis has no sense; numbers do not.
#include "dissertation/studies.h"

#include <gtest/gtest.h>

#include "dissertation/directions/axis_means.h"
#include "dissertation/directions/direction_fields.h"
#include "lab/measured/back_map.h"
#include "palpate/base/random.h"
#include "report/tests/report/page_numbers.h"
#include "report/tests/report/texts_apart.h"

namespace palpate::study {

namespace {

maps::MeasuredEllipse rowAt(double direction_deg, double major_cm = 36.0, double minor_cm = 26.0) {
  maps::MeasuredEllipse row;
  row.major_cm = major_cm;
  row.minor_cm = minor_cm;
  row.direction_deg = direction_deg;
  return row;
}

}  // namespace

TEST(AxisMeans, TensorAndDoubleAngleAreBlindToHalfTurns) {
  Random random(7);
  for (int round = 0; round < 50; ++round) {
    auto rows = scatteredRows({.true_deg = random.uniform(0.0, 180.0), .spread_deg = 25.0}, random.bits());
    const double tensor = meanAxisDeg(rows, AxisMean::tensor);
    const double doubled = meanAxisDeg(rows, AxisMean::double_angle);
    for (auto& row : rows) row.direction_deg += 180.0 * static_cast<double>(random.below(3));
    EXPECT_LT(axisDifferenceDeg(meanAxisDeg(rows, AxisMean::tensor), tensor), 1e-9);
    EXPECT_LT(axisDifferenceDeg(meanAxisDeg(rows, AxisMean::double_angle), doubled), 1e-9);
  }
}

TEST(AxisMeans, NumbersPointAcrossWhereAxesLieAroundZero) {
  const std::vector rows{rowAt(170.0), rowAt(10.0)};
  EXPECT_DOUBLE_EQ(meanAxisDeg(rows, AxisMean::degrees), 90.0);
  EXPECT_LT(axisDifferenceDeg(meanAxisDeg(rows, AxisMean::tensor), 0.0), 1e-9);
}

TEST(AxisMeans, ANearCircleHasHardlyAVoiceInTheTensor) {
  const std::vector rows{rowAt(90.0), rowAt(30.0, 30.0, 29.9)};
  EXPECT_LT(axisDifferenceDeg(meanAxisDeg(rows, AxisMean::tensor), 90.0), 1.0);
  EXPECT_NEAR(meanAxisDeg(rows, AxisMean::double_angle), 60.0, 1e-9);
}

TEST(AxisMeans, TurningEveryAxisTurnsTheTensorMeanAsMuch) {
  auto rows = scatteredRows({.true_deg = 40.0, .spread_deg = 20.0}, 3);
  const double before = meanAxisDeg(rows, AxisMean::tensor);
  for (auto& row : rows) row.direction_deg += 77.0;
  EXPECT_LT(axisDifferenceDeg(meanAxisDeg(rows, AxisMean::tensor), before + 77.0), 1e-9);
}

TEST(AxisMeans, ErrorsVanishWithTheSpread) {
  for (const double error : meanErrorsDeg({.true_deg = 60.0, .spread_deg = 0.0, .trials = 3})) {
    EXPECT_LT(error, 1e-6);
  }
}

TEST(AxisMeans, TheDifferenceOfAxesIsAtMostARightAngle) {
  EXPECT_DOUBLE_EQ(axisDifferenceDeg(179.0, 1.0), 2.0);
  EXPECT_DOUBLE_EQ(axisDifferenceDeg(0.0, 90.0), 90.0);
  EXPECT_DOUBLE_EQ(axisDifferenceDeg(-10.0, 350.0), 0.0);
}

TEST(DirectionFields, TensorsKeepTheMirrorSymmetryOfTheBack) {
  const auto keys = maps::dissertationKeyPoints();
  const auto places = placesOnBack(30.0);
  EXPECT_LT(compareFields(keys, maps::DirectionBlend::tensor, places).mirror_deg, 1e-6);
  EXPECT_LT(compareFields(keys, maps::DirectionBlend::tensor, places).most_deg, 1e-9);
  EXPECT_GT(compareFields(keys, maps::DirectionBlend::raw_degrees, places).mirror_deg, 30.0);
}

TEST(DirectionFields, BoundariesDifferByTheAxesAcrossEachOther) {
  EXPECT_NEAR(boundaryDifferenceMm({100.0, 0.8, 0.0}, {100.0, 0.8, 1.5707963267948966}), 20.0, 1e-9);
}

TEST(DirectionsStudy, ReportsWhatAppendixCGives) {
  const StudyPage page = studyDirections({.quick = true});
  EXPECT_NEAR(numberOf(page, "p5_up_printed_deg"), 121.0, 1e-9);
  EXPECT_NEAR(numberOf(page, "p5_up_tensor_deg"), 132.0, 0.1);
  EXPECT_GT(numberOf(page, "field_max_deg_up"), 30.0);
  for (const StudyFigure& figure : page.figures) expectTextsApart(figure.figure, figure.stem);
}

}  // namespace palpate::study

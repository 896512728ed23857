// The physics of the studies that must hold at any size, on their small plans.
#include <gtest/gtest.h>

#include "dissertation/assignment/assignment_measurement.h"
#include "dissertation/hdb/hdb_measurement.h"
#include "dissertation/tables/rendering_rates.h"
#include "dissertation/threshold/threshold_measurement.h"
#include "palpate/hdb/haptic_box.h"

namespace palpate::study {

TEST(HdbStudy, LargerBoxesRenderMoreAndLetFewerStrokesThrough) {
  const HdbMeasurement found = measureHdbSizes(hdbPlan(true), {});
  for (std::size_t i = 0; i < found.sizes.size(); ++i) {
    const HdbSizeRow& row = found.sizes[i];
    EXPECT_GE(row.bsp_triangles, row.exact_triangles);
    EXPECT_GE(row.octree_triangles, row.exact_triangles);
    if (i == 0) continue;
    EXPECT_GE(row.exact_triangles, found.sizes[i - 1].exact_triangles);
  }
  for (const PunctureRow& row : found.leads) {
    EXPECT_TRUE(row.lead() >= 0.5 || row.punctured == 1.0) << row.edge_mm;
    EXPECT_TRUE(row.lead() < 2.9 || row.punctured == 0.0) << row.edge_mm;
  }
  for (const PunctureRow& row : found.recommended) EXPECT_EQ(row.punctured, 0.0) << row.edge_mm;
  for (const PunctureRow& row : found.fine_recommended) EXPECT_EQ(row.punctured, 0.0) << row.edge_mm;
  for (const MarginRow& row : found.margins) {
    EXPECT_TRUE(row.share < 1.0 || row.punctured == 0.0) << row.depth_mm;
  }
  EXPECT_EQ(found.else_if_punctured, 1.0);
}

TEST(HdbStudy, TheRuleAndItsSafeSpeedAreInverse) {
  const double edge = hdb::leastHdbEdge(500.0, 0.010, 8.0);
  EXPECT_DOUBLE_EQ(edge, 2.0 * (5.0 + 8.0));
  EXPECT_DOUBLE_EQ(safeSpeed(edge, 0.010, 8.0), 500.0);
  EXPECT_EQ(safeSpeed(10.0, 0.010, 8.0), 0.0);
}

TEST(AssignmentStudy, EachCaseKeepsEveryTriangleInItsOwnWay) {
  using hdb::Assignment;
  const AssignmentMeasurement found = measureAssignments(assignmentPlan(true), {});
  for (const AssignmentRow& row : found.rows) {
    EXPECT_EQ(row.missed, 0.0);
    EXPECT_GE(row.rendered, row.wanted) << "leaves hold what the box meets, and more";
    if (row.assignment == Assignment::Cut) {
      EXPECT_NEAR(row.overlap, 1.0, 1e-9) << "cut leaves do not overlap";
      EXPECT_GT(row.stored, 1.0);
    } else if (row.assignment == Assignment::BothSides) {
      EXPECT_GT(row.stored, 1.0);
    } else {
      EXPECT_EQ(row.stored, 1.0);
    }
  }
  EXPECT_LT(found.cut_area_error, 1e-9);
  EXPECT_GT(found.lost_two_of_three.front(), found.lost_two_of_three.back()) << "smaller leaves lose more";
}

TEST(ThresholdStudy, LargerLeavesAreFewerAndRenderMore) {
  const ThresholdMeasurement found = measureThresholds(thresholdPlan(true), {});
  for (const std::size_t model : found.plan.sizes) {
    for (const auto tree : {hdb::TreeKind::Bsp, hdb::TreeKind::Octree}) {
      const auto rows = rowsOf(found, model, tree);
      ASSERT_EQ(rows.size(), found.plan.thresholds.size());
      for (std::size_t i = 1; i < rows.size(); ++i) {
        EXPECT_LE(rows[i].leaves, rows[i - 1].leaves);
        EXPECT_GE(rows[i].rendered, rows[i - 1].rendered);
      }
      EXPECT_EQ(rows.back().leaves, 1u) << "everything fits into one leaf";
      EXPECT_EQ(rows.back().rendered, static_cast<double>(model));
      EXPECT_EQ(rowAt(rows, 1000).threshold, 1024u);
    }
  }
}

TEST(TablesStudy, RendersAboutWhatWasPrintedAndEachStepAddsItsTime) {
  const RatesMeasurement found = measureRates(ratesPlan(true), {});
  EXPECT_TRUE(found.renderer.empty() != found.no_renderer.empty());
  const double scale = static_cast<double>(found.plan.partitioned) / 41582.0;
  const auto printed = printedNumbers().table_3_2.touched;
  ASSERT_EQ(found.bsp.touched.size(), printed.size());
  for (std::size_t i = 0; i < printed.size(); ++i) {
    const FrameRow& row = found.bsp.touched[i];
    EXPECT_NEAR(row.triangles, scale * printed[i].triangles, 0.2 * scale * printed[i].triangles + 300.0);
    EXPECT_EQ(row.draw_us.has_value(), !found.renderer.empty());
    EXPECT_GT(row.touchedMicroseconds(), row.untouchedMicroseconds());
    EXPECT_GT(row.untouchedMicroseconds(), row.draw_us.value_or(0.0));
  }
  EXPECT_LT(found.tick_us, found.bsp.touched.front().touchedMicroseconds());
}

}  // namespace palpate::study

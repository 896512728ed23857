#include "lab/runs/deform_run.h"

#include <gtest/gtest.h>

#include "support/counted.h"

namespace palpate::bench {

TEST(DeformRun, MeasuresWhatItSays) {
  const DeformFigures figures =
      measureDeform({.triangles = 41582, .half_major_mm = 100.0, .drag_mm = 5.0, .seconds = 0.02});
  EXPECT_EQ(figures.triangles, 41582u);
  // The ellipse's share of the sheet is 3732 vertices; slopes and the tilt of the contacts make it more.
  EXPECT_GT(figures.ours.vertices, 3500.0);
  EXPECT_LT(figures.ours.vertices, 6000.0);
  EXPECT_GT(figures.ours.ns_per_vertex, figures.region_ns_per_vertex);
  EXPECT_GT(figures.region_ns_per_vertex, 0.0);
  EXPECT_GT(figures.ratio_to_copy_floor, 1.0);
  EXPECT_NEAR(figures.ours.us_per_frame, 1e-3 * figures.ours.ns_per_vertex * figures.ours.vertices, 1e-6);
  EXPECT_LE(figures.ours.us_per_frame, figures.ours.apply_us.max);
  support::expectNone(figures.allocations);
}

TEST(DeformRun, TimesTheLiteralDeformationInTheSameRun) {
  const DeformRun run{.triangles = 8163, .fingers = 2, .seconds = 0.1};
  const DeformFigures figures = measureDeform(run);
  ASSERT_TRUE(figures.literal);
  // Its regions are pedal curves, a little wider, without a test of facing.
  EXPECT_GT(figures.literal->vertices, 0.9 * figures.ours.vertices);
  EXPECT_LT(figures.literal->vertices, 1.2 * figures.ours.vertices);
  EXPECT_GT(*figures.speedup_over_literal, 1.0);
}

TEST(DeformRun, NamesTheSurfaceByItsHash) {
  const auto hash = [](double depth_mm) {
    return measureDeform({.triangles = 8163, .depth_mm = depth_mm, .literal = false, .seconds = 0.0}).ours.hash;
  };
  EXPECT_EQ(hash(8.0), hash(8.0));
  EXPECT_NE(hash(8.0), hash(8.001));
}

}  // namespace palpate::bench

#include "bench/deform_run.h"

#include <gtest/gtest.h>

namespace palpate::bench {

TEST(DeformRun, MeasuresWhatItSays) {
  const DeformFigures figures =
      measureDeform({.triangles = 41582, .half_major_mm = 100.0, .drag_mm = 5.0, .seconds = 0.02});
  EXPECT_EQ(figures.triangles, 41582u);
  // The ellipse's share of the sheet is 3732 vertices; slopes and the tilt of the contacts make it more.
  EXPECT_GT(figures.vertices, 3500.0);
  EXPECT_LT(figures.vertices, 6000.0);
  EXPECT_GT(figures.ns_per_vertex, figures.region_ns_per_vertex);
  EXPECT_GT(figures.region_ns_per_vertex, 0.0);
  EXPECT_GT(figures.ratio_to_copy_floor, 1.0);
  if (figures.allocations) {
    EXPECT_EQ(*figures.allocations, 0u);
  }
}

}  // namespace palpate::bench

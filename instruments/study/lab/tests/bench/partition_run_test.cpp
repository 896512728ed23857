#include "lab/runs/partition_run.h"

#include <gtest/gtest.h>

#include "lab/workloads/workload_meshes.h"
#include "palpate/base/error.h"
#include "support/counted.h"
#include "support/mesh_zoo.h"

namespace palpate::bench {

TEST(PartitionRun, MeasuresAFingerThatSlides) {
  PartitionRun run;
  run.ticks = 500;
  const PartitionFigures f = measurePartition(lab::backMesh(8163), run);
  EXPECT_EQ(f.triangles, 8163u);
  EXPECT_NEAR(f.edge_mm, 100.0, 1e-9);  // a quarter of 400 mm
  EXPECT_GT(f.mean_triangles, 100.0);
  EXPECT_GE(f.mean_rendered, f.mean_triangles);
  EXPECT_GT(f.hdb_query_us.p50, 0.0);
  EXPECT_GE(f.hybrid_refreshes, 1u);
  EXPECT_LT(f.hybrid_refreshes, 100u);    // of 500 ticks
  EXPECT_GT(f.bytes_per_triangle, 52.0);  // an index and a box of six doubles at least
  EXPECT_LT(f.bytes_per_triangle, 130.0);
  support::expectNone(f.allocations);
  EXPECT_EQ(measurePartition(lab::backMesh(8163), run).hash, f.hash);
}

TEST(PartitionRun, RefusesAMeshWithoutTriangles) { EXPECT_THROW(measurePartition(zoo::empty(), {}), Error); }

}  // namespace palpate::bench

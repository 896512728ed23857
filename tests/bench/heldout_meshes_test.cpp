#include "bench/heldout_meshes.h"

#include <gtest/gtest.h>

#include "bench/surface_side.h"
#include "palpate/base/error.h"

namespace palpate::bench {
namespace {

TEST(HeldoutMeshes, AreOfTheKindTheyClaim) {
  for (const char* name : {"ring", "ball", "plate2mm", "plate_thick", "overlapping_balls"}) {
    EXPECT_EQ(SurfaceSide(heldoutMesh(name)).kind(), SurfaceKind::closed) << name;
  }
  for (const char* name : {"saddle", "cliffs", "terrain", "spikes", "slivers", "ridge", "tiny", "huge"}) {
    EXPECT_EQ(SurfaceSide(heldoutMesh(name)).kind(), SurfaceKind::height_field) << name;
  }
  EXPECT_EQ(SurfaceSide(heldoutMesh("touching_boxes")).kind(), SurfaceKind::open) << "one edge has four triangles";
  EXPECT_THROW(heldoutMesh("no such shape"), Error);
}

TEST(HeldoutMeshes, ClosedBodiesFaceOutwards) {
  EXPECT_NEAR(windingNumber(heldoutMesh("ring"), {50, 0, 0}), 1.0, 1e-9);
  EXPECT_NEAR(windingNumber(heldoutMesh("ring"), {0, 0, 0}), 0.0, 1e-9);
  EXPECT_NEAR(windingNumber(heldoutMesh("ball"), {1, 2, 3}), 1.0, 1e-9);
  EXPECT_NEAR(windingNumber(heldoutMesh("plate2mm"), {50, 50, 1}), 1.0, 1e-9);
  EXPECT_NEAR(windingNumber(heldoutMesh("overlapping_balls"), {0, 0, 0}), 2.0, 1e-9);
}

TEST(HeldoutMeshes, EveryListedNameCanBeMade) {
  for (const std::string& name : heldoutMeshNames()) EXPECT_GT(heldoutMesh(name).triangles.size(), 100u) << name;
}

}  // namespace
}  // namespace palpate::bench

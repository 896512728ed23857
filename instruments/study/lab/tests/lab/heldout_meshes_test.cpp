#include "lab/workloads/heldout_meshes.h"

#include <gtest/gtest.h>

#include "lab/judges/surface_side.h"
#include "palpate/base/error.h"

namespace palpate::lab {
namespace {

TEST(HeldoutMeshes, AreOfTheKindTheyClaim) {
  for (const char* name : {"ring", "ball", "plate2mm", "plate_thick", "overlapping_balls"}) {
    EXPECT_EQ(lab::SurfaceSide(lab::heldoutMesh(name)).kind(), lab::SurfaceKind::closed) << name;
  }
  for (const char* name : {"saddle", "cliffs", "terrain", "spikes", "slivers", "ridge", "tiny", "huge"}) {
    EXPECT_EQ(lab::SurfaceSide(lab::heldoutMesh(name)).kind(), lab::SurfaceKind::height_field) << name;
  }
  EXPECT_EQ(lab::SurfaceSide(lab::heldoutMesh("touching_boxes")).kind(), lab::SurfaceKind::open)
      << "one edge has four triangles";
  EXPECT_THROW(lab::heldoutMesh("no such shape"), Error);
}

TEST(HeldoutMeshes, ClosedBodiesFaceOutwards) {
  EXPECT_NEAR(lab::windingNumber(lab::heldoutMesh("ring"), {50, 0, 0}), 1.0, 1e-9);
  EXPECT_NEAR(lab::windingNumber(lab::heldoutMesh("ring"), {0, 0, 0}), 0.0, 1e-9);
  EXPECT_NEAR(lab::windingNumber(lab::heldoutMesh("ball"), {1, 2, 3}), 1.0, 1e-9);
  EXPECT_NEAR(lab::windingNumber(lab::heldoutMesh("plate2mm"), {50, 50, 1}), 1.0, 1e-9);
  EXPECT_NEAR(lab::windingNumber(lab::heldoutMesh("overlapping_balls"), {0, 0, 0}), 2.0, 1e-9);
}

TEST(HeldoutMeshes, EveryListedNameCanBeMade) {
  for (const std::string& name : lab::heldoutMeshNames())
    EXPECT_GT(lab::heldoutMesh(name).triangles.size(), 100u) << name;
}

}  // namespace
}  // namespace palpate::lab

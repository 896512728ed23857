// What the hunt's generators promise: bodies of every kind, the same for the same seed, sound where they say so.
#include "lab/workloads/hunted_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lab/workloads/hunted_shapes.h"
#include "palpate/base/error.h"
#include "palpate/mesh/repair.h"
#include "palpate/mesh/validate.h"
#include "palpate/mesh/winding.h"

namespace palpate::lab {
namespace {

TEST(HuntedShapes, AreClosedFaceOutwardsAndHardlyEverPierceThemselves) {
  std::size_t piercing = 0;
  for (const std::string& name : huntedShapeNames()) {
    Random random(11);
    const mesh::TriangleMesh mesh = huntedShape(name, random);
    EXPECT_GE(mesh.triangles.size(), 1000u) << name;
    EXPECT_LE(mesh.triangles.size(), 40000u) << name;
    const mesh::RepairResult repaired = mesh::repair(mesh);
    EXPECT_TRUE(repaired.closed) << name;
    piercing += repaired.self_intersecting ? 1 : 0;
    EXPECT_GT(mesh::signedVolume(mesh), 0.0) << name;
    const double length = mesh::boundingBox(mesh).diagonal().norm();
    EXPECT_GT(length, 50.0) << name;
    EXPECT_LT(length, 350.0) << name;
  }
  EXPECT_LE(piercing, 2u);
}

TEST(HuntedBodies, AreManyAndCanAllBeFelt) {
  const std::vector<std::string> kinds = huntedBodyKinds();
  EXPECT_GE(kinds.size(), 40u);
  EXPECT_NE(kinds.size() % 17, 0u) << "hunt.cpp goes through the kinds in steps of 17";
  for (const std::string& kind : kinds) EXPECT_GE(mesh::repair(huntedBody(kind, 5)).mesh.triangles.size(), 8u) << kind;
  EXPECT_THROW(huntedBody("nose", 1), Error);
}

TEST(HuntedBodies, AreTheSameForTheSameSeedOnly) {
  for (const char* kind : {"limbs", "slivers", "many_parts", "slitted"}) {
    const mesh::TriangleMesh one = huntedBody(kind, 7), again = huntedBody(kind, 7), other = huntedBody(kind, 8);
    EXPECT_EQ(one.positions, again.positions) << kind;
    EXPECT_EQ(one.triangles, again.triangles) << kind;
    EXPECT_NE(one.positions, other.positions) << kind;
  }
}

TEST(HuntedBodies, HaveWhatTheirKindsAreNamedFor) {
  const auto repaired = [](const char* kind) { return mesh::repair(huntedBody(kind, 2)); };
  for (const char* kind : {"two_parts", "limb_through_body", "grazing_balls", "pinched_tube"})
    EXPECT_TRUE(repaired(kind).self_intersecting) << kind;
  for (const char* kind : {"open_sheet", "ridge"}) EXPECT_FALSE(repaired(kind).closed) << kind;
  for (const char* kind : {"pierced", "slitted"}) {
    EXPECT_FALSE(mesh::repair(huntedBody(kind, 2), {.fill_holes = false}).closed) << kind;
    EXPECT_TRUE(repaired(kind).closed) << kind << ": its holes are small";
  }
  for (const char* kind : {"inside_out_open", "far_hole", "far_hole_of_parts"})
    EXPECT_FALSE(repaired(kind).closed) << kind;
  EXPECT_TRUE(repaired("doubled_caps").closed);
  EXPECT_EQ(repaired("cracks").components, 2u) << "too wide to be joined";
  EXPECT_GT(mesh::signedVolume(repaired("inside_out_open").mesh), 0.0) << "repair has found its outside";
  EXPECT_GT(mesh::validate(huntedBody("voxels", 2)).coincident_vertices.count, 0u);
  EXPECT_TRUE(repaired("voxels").closed);
  for (const char* kind : {"hollow", "chain"}) EXPECT_EQ(repaired(kind).components, 2u) << kind;
}

TEST(HuntedBodies, VoxelsKeepTheirHollowsThroughRepair) {
  // In body 11 several lumps that meet in edges enclose a hollow together.
  for (std::uint64_t seed = 6; seed < 18; ++seed) {
    const mesh::TriangleMesh given = huntedBody("voxels", seed);
    EXPECT_NEAR(mesh::signedVolume(mesh::repair(given).mesh), mesh::signedVolume(given), 1e-3) << seed;
  }
}

TEST(HuntedDamage, SliversLeaveTheSurfaceWhereItWas) {
  mesh::TriangleMesh mesh = huntedBody("octahedra", 3);
  const double volume = mesh::signedVolume(mesh);
  const std::size_t triangles = mesh.triangles.size();
  Random random(1);
  splitIntoSlivers(mesh, 3.0, random);
  EXPECT_GT(mesh.triangles.size(), triangles);
  EXPECT_NEAR(mesh::signedVolume(mesh), volume, 1e-9 * volume);
  EXPECT_TRUE(mesh::repair(mesh).closed);
}

}  // namespace
}  // namespace palpate::lab

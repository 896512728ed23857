#include "palpate/body/torso.h"

#include <gtest/gtest.h>

#include "palpate/base/error.h"
#include "palpate/body/bones.h"

namespace palpate::body {
namespace {

const Torso& defaultTorso() {
  static const Torso torso = makeTorso();
  return torso;
}

const Torso& smallTorso() {
  static const Torso torso = makeTorso({.triangles = 8163});
  return torso;
}

std::size_t trianglesOf(const Torso& torso) {
  std::size_t sum = torso.skin.mesh.triangles.size();
  for (const Bone& bone : torso.bones) sum += bone.mesh.triangles.size();
  return sum;
}

TEST(Torso, PresetsHaveTheirTrianglesInAll) {
  EXPECT_EQ(trianglesOf(smallTorso()), 8163u);
  for (const std::size_t preset : {20389, 41582}) EXPECT_EQ(trianglesOf(makeTorso({.triangles = preset})), preset);
}

TEST(Torso, EveryVertexKnowsTheNearestBone) {
  const Torso& torso = defaultTorso();
  ASSERT_EQ(torso.depth_mm.size(), torso.skin.mesh.positions.size());
  ASSERT_EQ(torso.nearest_bone.size(), torso.skin.mesh.positions.size());
  const SkinLandmark& t6 = landmark(torso, "spinous_T6");
  Index nearest = 0;
  for (Index i = 0; i < torso.skin.mesh.positions.size(); ++i) {
    const auto distance = [&](Index v) { return (torso.skin.mesh.positions[v] - t6.position).norm(); };
    if (distance(i) < distance(nearest)) nearest = i;
  }
  EXPECT_EQ(torso.bones[torso.nearest_bone[nearest]].name, "T6");
  EXPECT_GT(torso.depth_mm[nearest], 4);
  EXPECT_LT(torso.depth_mm[nearest], 10);
}

TEST(Torso, CoversL5) {
  const SkinLandmark& l5 = landmark(defaultTorso(), "spinous_L5");
  EXPECT_NEAR(mesh::boundingBox(defaultTorso().skin.mesh).min().y(), -292, 1);
  EXPECT_GT(l5.position.y(), -292 + 20);
}

TEST(Torso, SkinLandmarksLieOverTheirBones) {
  for (const SkinLandmark& point : defaultTorso().landmarks) {
    if (!point.name.starts_with("spinous_")) continue;
    EXPECT_GT((point.position - point.bone_position).dot(point.normal), 3) << point.name;
    EXPECT_LT((point.position - point.bone_position).norm(), 15) << point.name;
  }
  EXPECT_THROW(landmark(defaultTorso(), "spinous_T13"), Error);
}

TEST(Torso, AsymmetryKeepsTheCoverOfTheSpine) {
  const Torso straight = makeTorso({.shape = {1750, {}, 0}});
  for (const char* name : {"spinous_T2", "spinous_T6", "spinous_T11", "spinous_L4"}) {
    const auto cover = [&](const Torso& torso) {
      const Vec3 point = landmark(torso, name).position;
      return depthToBones({&point, 1}, torso.bones).depth_mm.front();
    };
    EXPECT_NEAR(cover(defaultTorso()), cover(straight), 0.5) << name;
  }
}

TEST(Torso, GrowsWithStature) {
  const Torso child = makeTorso({.triangles = 8163, .shape = {875, {}, 1}});
  const Torso& man = smallTorso();
  EXPECT_NEAR(child.depth_mm[100], 0.5 * man.depth_mm[100], 1e-6);
  EXPECT_NEAR((landmark(child, "spinous_T6").position - 0.5 * landmark(man, "spinous_T6").position).norm(), 0, 1e-9);
}

TEST(Torso, SharesTrianglesAsAsked) {
  const Torso torso = makeTorso({.triangles = 8163, .bone_triangles = 6000});
  EXPECT_EQ(torso.skin.mesh.triangles.size(), 2163u);
  EXPECT_EQ(trianglesOf(torso), 8163u);
  EXPECT_THROW(makeTorso({.triangles = 4400}), Error);
  EXPECT_THROW(makeTorso({.triangles = 8163, .bone_triangles = 8000}), Error);
  EXPECT_THROW(makeTorso({.triangles = 8163, .bone_triangles = 4001}), Error) << "closed bones are even";
}

}  // namespace
}  // namespace palpate::body

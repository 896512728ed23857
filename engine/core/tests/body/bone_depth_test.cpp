// Depth to bone: the least distance to any bone, and which one, against looking at every triangle.
#include "palpate/body/bones.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/body/skin_surface.h"
#include "palpate/mesh/nearest.h"
#include "support/mesh_zoo.h"

namespace palpate::body {
namespace {

const std::vector<Bone>& coarseBones() {
  static const std::vector<Bone> bones = [] {
    BonesSettings settings;
    settings.triangles = 20000;
    return makeBones(settings);
  }();
  return bones;
}

double bruteDepth(const Vec3& p, const std::vector<Bone>& bones) {
  double least = 1e300;
  for (const Bone& b : bones) {
    for (const Triangle& t : b.mesh.triangles) {
      const auto& v = b.mesh.positions;
      least = std::min(least, (mesh::nearestOnTriangle(p, v[t[0]], v[t[1]], v[t[2]]) - p).norm());
    }
  }
  return least;
}

TEST(BoneDepth, OfABallIsTheDistanceToIt) {
  const std::vector<Bone> bones = {{"ball", BoneKind::rib, zoo::sphere(10.0, 5)},
                                   {"far", BoneKind::rib, zoo::sphere(10.0, 3, Vec3(100, 0, 0))}};
  const std::vector<Vec3> points = {{0, 0, 40}, {70, 0, 0}, {30, 0, 0}};
  const BoneDepth depth = depthToBones(points, bones);
  EXPECT_NEAR(depth.depth_mm[0], 30.0, 0.02);
  EXPECT_NEAR(depth.depth_mm[1], 20.0, 0.1);
  EXPECT_NEAR(depth.depth_mm[2], 20.0, 0.02);
  EXPECT_EQ(depth.bone, (std::vector<Index>{0, 1, 0}));
}

TEST(BoneDepth, AgreesWithLookingAtEveryTriangle) {
  const std::vector<Bone>& bones = coarseBones();
  const SkinSurface skin;
  Random random(3);
  std::vector<Vec3> points(100);
  for (Vec3& p : points) p = skin.at({random.uniform(-1, 1), random.uniform(-280, 190)}).position;
  const BoneDepth depth = depthToBones(points, bones);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_DOUBLE_EQ(depth.depth_mm[i], bruteDepth(points[i], bones));
    const std::vector<Bone> named = {bones[depth.bone[i]]};
    EXPECT_DOUBLE_EQ(depth.depth_mm[i], bruteDepth(points[i], named));
  }
}

TEST(BoneDepth, NamesTheSpinousProcessUnderTheMidline) {
  const std::vector<Bone>& bones = coarseBones();
  const SkinSurface skin;
  std::vector<Vec3> points;
  std::vector<std::string> names;
  for (const Landmark& landmark : boneLandmarks()) {
    if (landmark.name.rfind("spinous_", 0) != 0 || landmark.position.y() > 190.0) continue;
    points.push_back(skin.at({0.0, landmark.position.y() + 1.0}).position);
    names.push_back(landmark.bone);
  }
  const BoneDepth depth = depthToBones(points, bones);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(bones[depth.bone[i]].name, names[i]);
    EXPECT_TRUE(depth.depth_mm[i] > 5.0 && depth.depth_mm[i] < 11.0) << names[i] << ' ' << depth.depth_mm[i];
  }
}

TEST(BoneDepth, NeedsABone) { EXPECT_THROW(depthToBones({}, {}), Error); }

}  // namespace
}  // namespace palpate::body

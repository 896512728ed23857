// The skeleton of the trunk under the trunk's skin: every vertex inside, at its cover.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "palpate/body/trunk/trunk.h"
#include "palpate/mesh/nearest.h"
#include "support/winding_number.h"

namespace palpate::body {
namespace {

constexpr double kMinCoverMm = 4.0;
constexpr double kMinSpinousCoverMm = 5.5;

TEST(SkeletonCover, EveryBoneLiesUnderTheSkinOfTheTrunk) {
  const Trunk trunk = makeTrunk();
  const mesh::NearestTriangle skin(trunk.skin);
  for (const Bone& bone : trunk.bones) {
    double least = 1e9;
    double least_spinous = 1e9;
    Vec3 nearest_to_skin = Vec3::Zero();
    for (const Vec3& p : bone.mesh.positions) {
      const double depth = skin.find(p).distance;
      if (depth < least) nearest_to_skin = p;
      least = std::min(least, depth);
      if (std::abs(p.x()) < 12.0) least_spinous = std::min(least_spinous, depth);
    }
    EXPECT_GT(least, kMinCoverMm) << bone.name;
    if (bone.kind == BoneKind::vertebra) {
      EXPECT_GT(least_spinous, kMinSpinousCoverMm) << bone.name;
    }
    // Its vertices are one side of the skin, then: the one that decides is the nearest.
    EXPECT_GT(support::windingNumber(trunk.skin, nearest_to_skin), 0.5) << bone.name;
  }
}

}  // namespace
}  // namespace palpate::body

// From an examiner's words to a place on the skin.
#include "palpate/view/skin_place.h"

#include <gtest/gtest.h>

#include "palpate/base/error.h"
#include "support/changed_body.h"
#include "support/mesh_scene.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::view {
namespace {

/// A ball of 100 mm with a landmark behind and one in front, both a little off its skin.
class SkinPlaceOnABall : public testing::Test {
 protected:
  void SetUp() override {
    world_ = *scene::build(support::meshScene(folder_ / "ball.ply", zoo::sphere(100.0, 5)));
    support::changeBody(*world_, [](scene::Body& body) {
      body.anatomy.landmarks = {{"spinous_T6", "T6", {0, 0, 103}, Vec3::UnitZ(), {0, 0, 80}},
                                {"xiphoid_tip", "sternum", {0, 10, -98}, -Vec3::UnitZ(), {0, 10, -80}}};
    });
  }

  support::TemporaryFolder folder_;
  std::optional<scene::World> world_;
};

TEST_F(SkinPlaceOnABall, ALandmarkIsWhereTheSkinIsNearestToIt) {
  const SkinPlace place = skinPlace(*world_, "T6");
  EXPECT_LT((place.point - Vec3(0, 0, 100)).norm(), 0.5);
  EXPECT_GT(place.normal.z(), 0.99);
  EXPECT_LT(place.triangle, world_->body->skin.triangles.size());
}

TEST_F(SkinPlaceOnABall, DistancesGoAcrossAndThenStraightDownToTheSkin) {
  const SkinPlace place = skinPlace(*world_, "T6 right 60 mm");
  EXPECT_LT((place.point - Vec3(60, 0, 80)).norm(), 0.5) << "not the nearest place of the ball, which is nearer to T6";
  const SkinPlace front = skinPlace(*world_, "xiphoid tip left 60");
  EXPECT_NEAR(front.point.x(), -60.0, 0.1);
  EXPECT_LT(front.point.z(), -75.0) << "on the side that the landmark is on";
  EXPECT_LT(front.normal.z(), -0.7);
}

TEST_F(SkinPlaceOnABall, BesideTheBodyItIsTheSkinThatIsNearest) {
  EXPECT_LT((skinPlace(*world_, "T6 right 300 mm").point - Vec3(95, 0, 31)).norm(), 10.0);
}

TEST_F(SkinPlaceOnABall, WhatIsNoPlaceIsRefused) {
  EXPECT_THROW(skinPlace(*world_, "T66"), Error);
  support::changeBody(*world_, [](scene::Body& body) { body.anatomy.landmarks.clear(); });
  EXPECT_THROW(skinPlace(*world_, "T6"), Error);
}

}  // namespace
}  // namespace palpate::view

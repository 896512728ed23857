// The skin never sinks into a bone: pressed as deep as it goes where bones lie near, its distance to the drawn bones.
#include "palpate/engine/bone_cover.h"
#include "palpate/engine/living_skin.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "palpate/body/bones.h"
#include "palpate/body/places.h"
#include "support/changed_body.h"

namespace palpate::engine {
namespace {

const scene::World& trunk() {
  static const auto world = [] {
    scene::Scene scene;
    scene.body.triangles = 60000;
    scene.deformation.tissue = scene::TissueModel::layered;
    return scene::build(scene);
  }();
  return *world;
}

contact::FingerOutput pressing(const scene::World& world, Index triangle, double depth_mm) {
  const Triangle& corners = world.body->skin.triangles[triangle];
  contact::FingerOutput finger;
  finger.triangle = finger.anchor_triangle = triangle;
  finger.anchor = finger.proxy = mesh::centreOf(world.body->skin, world.body->skin.triangles[triangle]);
  finger.normal = mesh::areaVector2(world.body->skin.positions[corners[0]], world.body->skin.positions[corners[1]],
                                    world.body->skin.positions[corners[2]])
                      .normalized();
  finger.depth_mm = depth_mm;
  finger.touch = contact::Touch::stick;
  return finger;
}

Index triangleNear(const scene::World& world, const Vec3& place) {
  Index nearest = 0;
  double least = 1e300;
  for (Index t = 0; t < world.body->skin.triangles.size(); ++t) {
    const double distance = (mesh::centreOf(world.body->skin, world.body->skin.triangles[t]) - place).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    nearest = t;
  }
  return nearest;
}

/// Where the skin of the back lies thinnest over bones of this name.
Vec3 thinnestOver(const scene::World& world, const std::string& bone) {
  Vec3 place = Vec3::Zero();
  double least = 1e300;
  for (Index v = 0; v < world.body->skin.positions.size(); ++v) {
    const std::string& name = world.body->anatomy.bones[world.body->anatomy.nearest_bone[v]].name;
    if (!name.starts_with(bone) || world.body->anatomy.depth_mm[v] >= least || world.body->skin.positions[v].z() < 0.0)
      continue;
    least = world.body->anatomy.depth_mm[v];
    place = world.body->skin.positions[v];
  }
  return place;
}

struct Pressed {
  Pressed(const scene::World& of, const Vec3& place, double depth_mm) : world(of), skin(of, {.strain = false}) {
    const contact::FingerOutput finger = pressing(world, triangleNear(world, place), depth_mm);
    skin.follow({&finger, 1});
    cover = BoneCoverMeter(world).of(skin.surface());
  }
  const scene::World& world;
  LivingSkin skin;
  std::optional<BoneCover> cover;
};

void expectNeverInABone(const std::vector<Vec3>& places) {
  const scene::World& world = trunk();
  for (const Vec3& place : places) {
    for (const double depth : {5.0, 10.0, 20.0}) {
      const Pressed pressed(world, place, depth);
      if (!pressed.cover) continue;  // at rest: the finger is over a hole of the mesh
      EXPECT_GT(pressed.cover->least_mm, 0.3) << place.transpose() << ", " << depth << " mm deep";
    }
  }
}

std::vector<Vec3> randomPlaces(int count) {
  const mesh::TriangleMesh& skin = trunk().body->skin;
  std::vector<Vec3> places;
  std::mt19937 random(5);
  for (int i = 0; i < count; ++i) {
    places.push_back(mesh::centreOf(skin, skin.triangles[random() % skin.triangles.size()]));
  }
  return places;
}

TEST(BoneCover, ThePressedSkinNeverSinksIntoABone) {
  const scene::World& world = trunk();
  std::vector<Vec3> places = {thinnestOver(world, "scapula"), thinnestOver(world, "rib"), thinnestOver(world, "T"),
                              thinnestOver(world, "L")};
  for (const char* words : {"T6", "T9 right 60 mm", "T4 left 60 mm", "L3", "L3 right 40 mm"}) {
    places.push_back(body::placeNamed(world.body->anatomy.landmarks, words).point);
  }
  expectNeverInABone(places);
  expectNeverInABone(randomPlaces(6));
}

/// A suite of its own, so that it need not run on every change.
TEST(BoneCoverAtManyPlaces, ThePressedSkinNeverSinksIntoABone) { expectNeverInABone(randomPlaces(60)); }

TEST(BoneCover, IsBelowZeroWhereSkinSinksIn) {
  scene::World careless = trunk();
  careless.reach = nullptr;  // nobody looks around the finger
  const Pressed pressed(careless, thinnestOver(careless, "scapula"), 10.0);
  ASSERT_TRUE(pressed.cover);
  EXPECT_LT(pressed.cover->least_mm, -1.0);
  EXPECT_TRUE(careless.body->anatomy.bones[pressed.cover->bone].name.starts_with("scapula"));
}

TEST(BoneCover, IsTheDistanceThatAnotherSearchFinds) {
  const scene::World& world = trunk();
  const Pressed pressed(world, body::placeNamed(world.body->anatomy.landmarks, "T6").point, 8.0);
  std::vector<Vec3> moved;
  for (Index v = 0; v < world.body->skin.positions.size(); ++v) {
    if (pressed.skin.surface().displacementAt(v).norm() > 0.0f)
      moved.push_back(pressed.skin.surface().positionAt(v).cast<double>());
  }
  const body::BoneDepth depths = body::depthToBones(moved, world.body->anatomy.bones);
  const auto least = std::min_element(depths.depth_mm.begin(), depths.depth_mm.end());
  ASSERT_TRUE(pressed.cover);
  EXPECT_NEAR(pressed.cover->least_mm, *least, 1e-9);
  EXPECT_EQ(pressed.cover->bone, depths.bone[static_cast<std::size_t>(least - depths.depth_mm.begin())]);
  EXPECT_EQ(describe(*pressed.cover, world), fmt::format("{:.1f} mm of tissue left over T6", *least));
}

TEST(BoneCover, IsNothingAtRestAndWithoutBones) {
  const LivingSkin still(trunk());
  EXPECT_FALSE(BoneCoverMeter(trunk()).of(still.surface()));
  scene::World boneless = trunk();
  support::changeBody(boneless, [](scene::Body& body) { body.anatomy.bones.clear(); });
  EXPECT_FALSE(Pressed(boneless, Vec3(60.0, 0.0, 100.0), 5.0).cover);
}

}  // namespace
}  // namespace palpate::engine

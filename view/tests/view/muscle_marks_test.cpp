// The superficial muscles as a drawing: where they reach, that they lie on the skin and go with it, and who has none.
#include "palpate/view/overlays/muscle_marks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "palpate/scene/scene_file.h"
#include "palpate/view/overlays/marks.h"
#include "palpate/view/picture.h"
#include "palpate/view/scene_view.h"
#include "pictures/image_compare.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

const std::shared_ptr<const scene::World>& muscularTrunk() {
  static const std::shared_ptr<const scene::World> world =
      scene::build(scene::parse("[body]\ntriangles = 24000\n", "muscles.toml"));
  return world;
}

Vec3 landmarkOf(const scene::World& world, std::string_view name) {
  for (const body::SkinLandmark& mark : world.body->anatomy.landmarks) {
    if (mark.name == name) return mark.position;
  }
  ADD_FAILURE() << name;
  return Vec3::Zero();
}

DrawnSkin restOf(const scene::World& world) {
  DrawnSkin skin;
  skin.copyAll(deform::DeformedSurface(*world.deformable));
  return skin;
}

/// Those of one muscle, left and right.
std::vector<MuscleSheet> sheetsOf(const scene::World& world, const Paint& paint) {
  std::vector<MuscleSheet> sheets = muscleSheets(world);
  std::erase_if(sheets, [&](const MuscleSheet& sheet) { return sheet.paint != paint; });
  return sheets;
}

Eigen::AlignedBox3d boxOf(const MuscleSheet& sheet, const DrawnSkin& skin) {
  Eigen::AlignedBox3d box;
  for (const auto& fibre : sheet.fibres) {
    for (const SkinSpot& spot : fibre) box.extend(placeOf(spot, skin));
  }
  return box;
}

double nearestOf(const MuscleSheet& sheet, const DrawnSkin& skin, const Vec3& place) {
  double nearest = 1e9;
  for (const auto& fibre : sheet.fibres) {
    for (const SkinSpot& spot : fibre) nearest = std::min(nearest, (placeOf(spot, skin) - place).norm());
  }
  return nearest;
}

TEST(MuscleMarks, ReachFromWhereTheyAriseToWhereTheyInsert) {
  const scene::World& world = *muscularTrunk();
  const DrawnSkin skin = restOf(world);
  struct Reach {
    Paint paint;
    std::vector<std::string> places;
  };
  const Reach reaches[] = {
      {kTrapeziusPaint, {"spinous_C5", "spinous_T12", "acromion_right", "scapula_right_spine_root"}},
      {kLatissimusPaint, {"spinous_T7", "spinous_L4", "iliac_crest_top_right", "psis_right"}},
      {kErectorPaint, {"spinous_C7", "sacrum_S3"}},
  };
  for (const Reach& reach : reaches) {
    const std::vector<MuscleSheet> sheets = sheetsOf(world, reach.paint);
    ASSERT_EQ(sheets.size(), 2u);
    for (const std::string& place : reach.places) {
      EXPECT_LT(nearestOf(sheets[1], skin, landmarkOf(world, place)), 16.0) << place;
    }
    EXPECT_GT(boxOf(sheets[1], skin).center().x(), 20.0) << "right";
    EXPECT_LT(boxOf(sheets[0], skin).center().x(), -20.0) << "left";
  }
}

TEST(MuscleMarks, LieOnTheSkinWithoutHoles) {
  const scene::World& world = *muscularTrunk();
  const DrawnSkin skin = restOf(world);
  const std::vector<MuscleSheet> sheets = muscleSheets(world);
  ASSERT_EQ(sheets.size(), 6u);
  for (const MuscleSheet& sheet : sheets) {
    for (std::size_t i = 0; i < sheet.fibres.size(); ++i) {
      ASSERT_EQ(sheet.fibres[i].size(), sheet.fibres[0].size());
      for (std::size_t j = 0; j < sheet.fibres[i].size(); ++j) {
        const SkinSpot& spot = sheet.fibres[i][j];
        EXPECT_NEAR(spot.weights.sum(), 1.0, 1e-5);
        EXPECT_GT(spot.weights.minCoeff(), -1e-4);
        const Vec3 place = placeOf(spot, skin);
        // Where a fibre turns into the fold of the armpit, the nearest skin goes on a step away.
        const Vec3 before = placeOf(sheet.fibres[i][j > 0 ? j - 1 : 0], skin);
        const Vec3 aside = placeOf(sheet.fibres[i > 0 ? i - 1 : 0][j], skin);
        EXPECT_LT(std::max((place - before).norm(), (place - aside).norm()), 50.0) << i << ", " << j;
      }
    }
  }
}

TEST(MuscleMarks, GoWhereThePressedSkinGoes) {
  const scene::World& world = *muscularTrunk();
  const SkinSpot& spot = sheetsOf(world, kErectorPaint)[1].fibres[16][20];
  const Vec3 rest = placeOf(spot, restOf(world));
  const FingerMark finger = pressedFinger(world, rest, 8.0);
  DrawnSkin pressed;
  pressed.copyAll(deformedBy(world, {&finger, 1}));
  EXPECT_GT((placeOf(spot, pressed) - rest).norm(), 4.0);
}

TEST(MuscleMarks, AreOfBodiesThatHaveAllTheirPlaces) {
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::torso;
  scene.body.triangles = 8163;
  const auto torso = scene::build(scene);
  EXPECT_FALSE(hasMuscles(torso->body->anatomy.landmarks)) << "no pelvis";
  EXPECT_TRUE(muscleSheets(*torso).empty());
  EXPECT_TRUE(muscleNames(*torso).empty());
  EXPECT_TRUE(hasMuscles(muscularTrunk()->body->anatomy.landmarks));
}

TEST(MuscleMarks, AreNowhereUnlessTheLookShowsThem) {
  const scene::World& world = *muscularTrunk();
  const DrawnSkin skin = restOf(world);
  Overlays overlays(world);
  EXPECT_TRUE(overlays.shapes({}, skin, {}).patches.points.empty());
  Look look;
  look.show(Overlay::muscles);
  EXPECT_FALSE(overlays.shapes(look, skin, {}).patches.points.empty());
}

TEST(MusclePictures, HaveTheirNames) {
  std::vector<std::string> words;
  for (const BodyName& name : muscleNames(*muscularTrunk())) words.push_back(name.words);
  EXPECT_EQ(std::count(words.begin(), words.end(), "trapezius"), 2);
  EXPECT_EQ(std::count(words.begin(), words.end(), "latissimus dorsi"), 2);
  EXPECT_EQ(std::count(words.begin(), words.end(), "erector spinae"), 2);
  scene::ViewSettings view;
  view.show = {Overlay::muscles};
  const PictureSettings settings = pictureSettings(*muscularTrunk(), view, 4.0 / 3.0);
  Studio studio(muscularTrunk());
  const deform::DeformedSurface rest(*muscularTrunk()->deformable);
  const TakenPicture taken = studio.take(rest, {}, settings, {640, 480, 2});
  EXPECT_TRUE(taken.notes.empty());
  support::expectPicture("muscles", taken.image, taken.drawn_by);
}

}  // namespace
}  // namespace palpate::view

// Names on the skin: where they are, which are seen, and that each eye sees their dots where it sees the skin.
#include "palpate/view/overlays/body_names.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "palpate/scene/scene_file.h"
#include "palpate/view/overlays/marks.h"
#include "palpate/view/overlays/muscle_marks.h"
#include "palpate/view/picture.h"
#include "palpate/view/scene_view.h"
#include "pictures/image_compare.h"
#include "support/changed_body.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

constexpr PictureSize kNamesPicture{960, 540, 1};

body::SkinLandmark landmarkAt(const std::string& name, const Vec3& place) {
  return {.name = name, .bone = "bone", .position = place, .normal = Vec3::UnitZ(), .bone_position = place};
}

std::shared_ptr<const scene::World> worldWith(mesh::TriangleMesh mesh, std::vector<body::SkinLandmark> landmarks) {
  auto world = std::make_shared<scene::World>(*meshWorld(std::move(mesh)));
  support::changeBody(*world, [&](scene::Body& body) { body.anatomy.landmarks = std::move(landmarks); });
  return world;
}

std::shared_ptr<const scene::World> flatBack() {
  return worldWith(zoo::grid(50, 100.0),
                   {landmarkAt("spinous_T6", {50.0, 50.0, 2.0}), landmarkAt("psis_left", {30.0, 20.0, -1.0})});
}

std::vector<std::string> wordsSeen(const std::vector<const BodyName*>& names) {
  std::vector<std::string> words;
  for (const BodyName* name : names) words.push_back(name->words);
  return words;
}

TEST(BodyNames, LieOnTheSkinWithTheirSitesAndKeepToItsTriangles) {
  const auto world = flatBack();
  const deform::DeformedSurface rest(*world->deformable);
  const std::vector<BodyName> names = bodyNames(*world);
  ASSERT_EQ(names.size(), 4u) << "T6, the PSIS, and the two sites beside T6";
  EXPECT_EQ(names[0].words, "T6");
  EXPECT_EQ(names[0].kind, NameKind::spine);
  EXPECT_LT((placeOf(names[0], *world, rest) - Vec3(50, 50, 0)).norm(), 1e-4);
  EXPECT_EQ(names[1].words, "left PSIS");
  EXPECT_EQ(names[2].words, "left site 2");
  EXPECT_EQ(names[2].kind, NameKind::site);
  EXPECT_LT((placeOf(names[2], *world, rest) - Vec3(20, 50, 0)).norm(), 1e-4);
}

TEST(BodyNames, GoWhereThePressedSkinGoes) {
  const auto world = flatBack();
  const FingerMark finger = pressedFinger(*world, {50.0, 50.0, 0.0}, 6.0);
  const std::vector<BodyName> names = bodyNames(*world);
  const Vec3 pressed = placeOf(names[0], *world, deformedBy(*world, {&finger, 1}));
  EXPECT_LT(pressed.z(), -4.0);
  EXPECT_LT((pressed - Vec3(50, 50, -6)).norm(), 1.5);
}

TEST(BodyNames, OfAnotherPartOfTheBodyAreLeftOut) {
  const auto world = worldWith(zoo::grid(50, 100.0), {landmarkAt("spinous_C7", {50.0, 160.0, 0.0})});
  EXPECT_TRUE(bodyNames(*world).empty());
  EXPECT_TRUE(bodyNames(*flatWorld()).empty());
}

TEST(BodyNames, AreSeenWhereSkinFacesTheEyeAndNoOtherSkinHidesIt) {
  // Two balls, one behind the other.
  mesh::TriangleMesh balls = zoo::joined(zoo::sphere(20.0, 3, {0, 0, 0}), zoo::sphere(10.0, 3, {0, 0, 60}));
  const auto world =
      worldWith(std::move(balls), {landmarkAt("spinous_T1", {0, 0, 20}), landmarkAt("spinous_T2", {0, 0, -20}),
                                   landmarkAt("spinous_T3", {0, 0, 70})});
  const std::vector<BodyName> names = bodyNames(*world);
  using Words = std::vector<std::string>;
  EXPECT_EQ(wordsSeen(namesSeen(names, *world, {0, 0, 500})), Words({"T3"})) << "the front ball hides T1";
  EXPECT_EQ(wordsSeen(namesSeen(names, *world, {0, 300, 400})), Words({"T1", "T3"}));
  EXPECT_EQ(wordsSeen(namesSeen(names, *world, {0, 0, -500})), Words({"T2"}));
}

PictureSettings namedView(StereoMode mode) {
  PictureSettings settings;
  settings.camera.centre = {50.0, 50.0, -40.0};  // the skin lies before the screen
  settings.camera.distance_mm = 600.0;
  settings.camera.height_rad = 0.3;
  settings.stereo.mode = mode;
  settings.labels = LabelSettings::none();
  settings.look.show(Overlay::names);
  return settings;
}

/// Middle of the pixels of the dots' own colour near a place; none: NaN.
Vec2 dotNear(const Image& image, const Vec2& place) {
  Vec2 sum = Vec2::Zero();
  double count = 0.0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Pixel& p = image.at(x, y);
      const bool is_dot = p[0] == kNamePaint[0] && p[1] == kNamePaint[1] && p[2] == kNamePaint[2];
      if (!is_dot || (Vec2(x, y) - place).norm() > 40.0) continue;
      sum += Vec2(x + 0.5, y + 0.5);
      count += 1.0;
    }
  }
  return sum / count;
}

TEST(NamesInPictures, HaveTheirDotsWhereTheSkinIs) {
  const auto world = flatBack();
  const PictureSettings settings = namedView(StereoMode::mono);
  const Screen screen = cameraScreen(settings.camera, 16.0 / 9.0);
  const Frustum frustum = makeFrustum(screen, settings.camera.eye(), 1.0, 1e4);
  const Image image = picture(world, deform::DeformedSurface(*world->deformable), {}, settings, kNamesPicture);
  for (const Vec3& place : {Vec3(50, 50, 0), Vec3(30, 20, 0), Vec3(80, 50, 0)}) {
    const Vec2 seen = seenAt(frustum, place).cwiseProduct(Vec2(kNamesPicture.width, kNamesPicture.height));
    EXPECT_LT((dotNear(image, seen) - seen).norm(), 1.0) << place.transpose();
  }
}

TEST(NamesInPictures, EachEyeSeesTheDotsOnTheSkin) {
  const auto world = flatBack();
  const PictureSettings settings = namedView(StereoMode::sbs_full);
  const Image image = picture(world, deform::DeformedSurface(*world->deformable), {}, settings, kNamesPicture);
  const Vec2 half(0.5 * kNamesPicture.width, kNamesPicture.height);
  const Eyes eyes = placeEyes(settings.camera, settings.stereo, half.x() / half.y());
  for (const Eye eye : {Eye::left, Eye::right}) {
    const Vec2 shift(eye == Eye::left ? 0.0 : half.x(), 0.0);
    const Frustum frustum = makeFrustum(eyes.screen, eyes.of(eye), 1.0, 1e4);
    const Vec2 seen = seenAt(frustum, Vec3(50, 50, 0)).cwiseProduct(half) + shift;
    EXPECT_LT((dotNear(image, seen) - seen).norm(), 1.0);
  }
}

TEST(NamesInPictures, ANoteSaysWhenTheBodyHasNone) {
  const PictureSettings settings = namedView(StereoMode::mono);
  for (const bool named : {true, false}) {
    const auto world = named ? flatBack() : flatWorld();
    const auto notes =
        Studio(world).capture(deform::DeformedSurface(*world->deformable), {}, settings, {160, 90, 1}).notes;
    using Notes = std::vector<std::string>;
    EXPECT_EQ(notes, named ? Notes() : Notes{"this body has no named places"});
  }
}

TEST(NamesInPictures, TheKeyExplainsNothingThatTheBodyLacks) {
  PictureSettings settings = namedView(StereoMode::mono);
  settings.labels.legend = true;
  const auto world = flatWorld();
  Studio studio(world);
  const auto capture = [&] {
    return studio.capture(deform::DeformedSurface(*world->deformable), {}, settings, {160, 90, 1}).image.pixels;
  };
  settings.look.overlays.reset();
  const auto bare = capture();
  for (const Overlay missing : {Overlay::names, Overlay::muscles, Overlay::lumps}) {
    settings.look.overlays.reset();
    settings.look.show(missing);
    EXPECT_EQ(capture(), bare) << static_cast<int>(missing);
  }
}

// ---- the superficial muscles as a drawing: where they reach, that they go with the skin, and who has none

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

DrawnSkin restSkin(const scene::World& world) {
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

Eigen::AlignedBox3d sheetBox(const MuscleSheet& sheet, const DrawnSkin& skin) {
  Eigen::AlignedBox3d box;
  for (const auto& fibre : sheet.fibres) {
    for (const SkinSpot& spot : fibre) box.extend(placeOf(spot, skin));
  }
  return box;
}

double distanceToFibres(const MuscleSheet& sheet, const DrawnSkin& skin, const Vec3& place) {
  double nearest = 1e9;
  for (const auto& fibre : sheet.fibres) {
    for (const SkinSpot& spot : fibre) nearest = std::min(nearest, (placeOf(spot, skin) - place).norm());
  }
  return nearest;
}

TEST(MuscleMarks, ReachFromWhereTheyAriseToWhereTheyInsert) {
  const scene::World& world = *muscularTrunk();
  const DrawnSkin skin = restSkin(world);
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
      EXPECT_LT(distanceToFibres(sheets[1], skin, landmarkOf(world, place)), 16.0) << place;
    }
    EXPECT_GT(sheetBox(sheets[1], skin).center().x(), 20.0) << "right";
    EXPECT_LT(sheetBox(sheets[0], skin).center().x(), -20.0) << "left";
  }
}

TEST(MuscleMarks, LieOnTheSkinWithoutHoles) {
  const scene::World& world = *muscularTrunk();
  const DrawnSkin skin = restSkin(world);
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
  const Vec3 rest = placeOf(spot, restSkin(world));
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
  const DrawnSkin skin = restSkin(world);
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
  const TakenPicture taken = studio.capture(rest, {}, settings, {640, 480, 2});
  EXPECT_TRUE(taken.notes.empty());
  support::expectPicture("muscles", taken.image, taken.drawn_by);
}

}  // namespace
}  // namespace palpate::view

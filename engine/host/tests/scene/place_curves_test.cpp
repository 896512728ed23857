#include "palpate/scene/place_curves.h"

#include <gtest/gtest.h>

#include <functional>

#include "host/tests/scene/scene_text.h"
#include "palpate/body/places.h"
#include "palpate/deform/deformer.h"
#include "palpate/scene/scene_writer.h"
#include "palpate/scene/skin_contact.h"
#include "palpate/scene/world.h"
#include "palpate/tissue/profile_curve.h"
#include "support/temporary_folder.h"

namespace palpate::scene {
namespace {

using tissue::ProfileKind;

tissue::ProfileSettings profileOf(ProfileKind kind) {
  tissue::ProfileSettings profile;
  profile.kind = kind;
  return profile;
}

double pressAt(const deform::Contact& contact, double q) {
  return tissue::curveAt(contact.layered->press.down, tissue::kPressBend, q * q).value;
}
double dragAt(const deform::Contact& contact, double q) {
  return tissue::curveAt(contact.layered->drag, tissue::kDragBend, q * q).value;
}

Scene smallTrunk(TissueModel tissue) {
  Scene scene;
  scene.body.triangles = 20000;
  scene.deformation.tissue = tissue;
  return scene;
}

PlaceProfile sharpAtT6() {
  return {.radius_mm = 30.0, .press = ProfileKind::sharp, .drag = ProfileKind::cosine, .region = 1.5, .at = "T6"};
}

/// A finger that presses and drags the skin of the back beside T6.
contact::FingerOutput fingerBesideT6(const World& world, double right_mm) {
  Vec3 place = body::placeNamed(world.body->anatomy.landmarks, "T6").point;
  place.x() += right_mm;
  contact::FingerOutput finger;
  const auto skin = tree::firstFrontCrossing(world.surface.geometry->tree, place + 500.0 * Vec3::UnitZ(),
                                             place - 500.0 * Vec3::UnitZ());
  finger.anchor_triangle = finger.triangle = skin.triangle;
  finger.anchor = skin.point;
  finger.proxy = skin.point + Vec3(0.0, 6.0, 0.0);
  finger.normal = Vec3::UnitZ();
  finger.depth_mm = 5.0;
  finger.touch = contact::Touch::stick;
  return finger;
}

deform::Contact contactBesideT6(const World& world, double right_mm) {
  return contactOf(world, fingerBesideT6(world, right_mm)).value();
}

TEST(FittedCurve, IsTheProfileToAFewThousandthsWhereItIsSmooth) {
  for (const auto& [kind, most] : {std::pair{ProfileKind::half_gaussian, 0.002},
                                   {ProfileKind::cosine, 0.01},
                                   {ProfileKind::two_gaussians, 0.01},
                                   {ProfileKind::sharp, 0.04},
                                   {ProfileKind::power, 0.035}}) {
    for (const double bend : {tissue::kPressBend, tissue::kDragBend}) {
      const FittedCurve fitted = fittedCurve(profileOf(kind), bend);
      EXPECT_LT(fitted.error, most) << static_cast<int>(kind);
      EXPECT_NEAR(tissue::curveAt(fitted.curve, bend, 0.0).value, 1.0, 1e-6);
      EXPECT_EQ(tissue::curveAt(fitted.curve, bend, 1.0).value, 0.0);
    }
  }
}

TEST(PlaceCurves, ActInTheirPlaceAndNowhereElse) {
  for (const TissueModel tissue : {TissueModel::layered, TissueModel::gaussian}) {
    Scene scene = smallTrunk(tissue);
    const auto without = build(scene);
    scene.profiles = {sharpAtT6()};
    const auto with = rebuilt(*without, scene);

    const deform::Contact here = contactBesideT6(*with, 0.0);
    ASSERT_TRUE(here.layered);
    const tissue::ProfileCurve sharp(profileOf(ProfileKind::sharp)), cosine(profileOf(ProfileKind::cosine));
    for (const double q : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      EXPECT_NEAR(pressAt(here, q), sharp.at(q).value, 0.04) << q;
      EXPECT_NEAR(dragAt(here, q), cosine.at(q).value, 0.01) << q;
    }
    EXPECT_EQ(tissue::curveAt(here.layered->press.outward, tissue::kPressBend, 0.25).value, 0.0) << "no layers";
    const double radius_mm = 1.5 * deform::normalRegion(here.normal, 5.0, {}).half_major.norm();
    EXPECT_NEAR(here.normal_region.half_major.norm(), radius_mm, 1e-9);
    EXPECT_EQ(here.depth_mm, contactBesideT6(*without, 0.0).depth_mm);

    const deform::Contact away = contactBesideT6(*with, 45.0), as_before = contactBesideT6(*without, 45.0);
    EXPECT_EQ(away.normal_region.half_major, as_before.normal_region.half_major);
    EXPECT_EQ(away.tangential_region.half_major, as_before.tangential_region.half_major);
    ASSERT_EQ(away.layered.has_value(), as_before.layered.has_value());
    if (away.layered) {
      EXPECT_EQ(pressAt(away, 0.4), pressAt(as_before, 0.4));
    }
  }
}

TEST(PlaceCurves, GoOverIntoTheLayersAroundThem) {
  Scene scene = smallTrunk(TissueModel::layered);
  const auto without = build(scene);
  scene.profiles = {sharpAtT6()};
  const auto with = rebuilt(*without, scene);
  EXPECT_NEAR(contactBesideT6(*with, 29.9).tangential_region.aspect,
              contactBesideT6(*without, 29.9).tangential_region.aspect, 1e-3);
  double last = contactBesideT6(*with, 14.0).normal_region.half_major.norm();
  for (double right_mm = 14.5; right_mm < 33.0; right_mm += 0.5) {  // the edge is from 15 to 30 mm
    const double radius_mm = contactBesideT6(*with, right_mm).normal_region.half_major.norm();
    const double bare_mm = contactBesideT6(*without, right_mm).normal_region.half_major.norm();
    const double bare_last_mm = contactBesideT6(*without, right_mm - 0.5).normal_region.half_major.norm();
    EXPECT_LT(std::abs(radius_mm - last), 3.0 + 2.0 * std::abs(bare_mm - bare_last_mm)) << right_mm;
    last = radius_mm;
  }
  EXPECT_EQ(last, contactBesideT6(*without, 32.5).normal_region.half_major.norm());
}

// With a half Gaussian for the whole body and the same for a place, the skin is the same to the fit.
TEST(PlaceCurves, DeformTheSkinAsTheSameProfileOfTheWholeBody) {
  Scene scene = smallTrunk(TissueModel::gaussian);
  const auto whole = build(scene);
  scene.profiles = {{.radius_mm = 60.0, .at = "T6"}};
  const auto placed = rebuilt(*whole, scene);
  deform::DeformedSurface expected(*whole->deformable), found(*placed->deformable);
  deform::Deformer by_whole(*whole->deformable, whole->deformation), by_place(*placed->deformable, placed->deformation);
  const deform::Contact one = contactBesideT6(*whole, 3.0), other = contactBesideT6(*placed, 3.0);
  EXPECT_FALSE(one.layered);
  ASSERT_TRUE(other.layered);
  by_whole.apply({&one, 1}, expected);
  by_place.apply({&other, 1}, found);
  double farthest = 0.0, moved = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    for (Index v = 0; v < whole->deformable->vertices; ++v) {
      farthest = std::max<double>(farthest, std::abs(found.position(axis)[v] - expected.position(axis)[v]));
      moved = std::max<double>(moved, std::abs(expected.position(axis)[v] - whole->deformable->restPosition(v)[axis]));
    }
  }
  EXPECT_GT(moved, 4.0);
  EXPECT_LT(farthest, 0.03);
}

TEST(PlaceCurves, LeaveTheForceAndSaySo) {
  Scene scene = smallTrunk(TissueModel::layered);
  const auto without = build(scene);
  scene.profiles = {sharpAtT6()};
  const auto with = rebuilt(*without, scene);
  EXPECT_TRUE(with->layered);
  EXPECT_EQ(*with->surface.stiffness_n_per_mm, *without->surface.stiffness_n_per_mm);
  EXPECT_EQ(with->tissue.law, without->tissue.law);
  ASSERT_EQ(with->notes.size(), without->notes.size() + 1);
  EXPECT_NE(with->notes.back().find("[[profile]] at T6: the skin follows \"sharp\" (press) and \"cosine\" (drag)"),
            std::string::npos)
      << with->notes.back();
  EXPECT_NE(with->notes.back().find("the force is unchanged"), std::string::npos);
}

TEST(PlaceCurves, AreReadAndWrittenWithTheirScene) {
  const support::TemporaryFolder folder;
  const Scene scene = parse(
      "[[profile]]\nat = \"T6\"\nradius_mm = 25\npress = \"sharp\"\n[[profile]]\nx_mm = 5\ndrag = \"power\"\nregion = "
      "2\n" +
          kFinger,
      (folder / "s.toml").string());
  ASSERT_EQ(scene.profiles.size(), 2u);
  EXPECT_EQ(scene.profiles[0].press, ProfileKind::sharp);
  EXPECT_EQ(scene.profiles[0].drag, ProfileKind::half_gaussian);
  EXPECT_EQ(scene.profiles[1].x_mm, 5.0);
  EXPECT_EQ(scene.profiles[1].region, 2.0);
  const Scene again = parse(sceneAsToml(scene, folder.path()), (folder / "t.toml").string());
  ASSERT_EQ(again.profiles.size(), 2u);
  EXPECT_EQ(again.profiles[0].at, "T6");
  EXPECT_EQ(again.profiles[1].drag, ProfileKind::power);
}

TEST(PlaceCurves, RefuseWhatACurveCannotBe) {
  Scene scene = smallTrunk(TissueModel::gaussian);
  scene.profiles = {{.press = ProfileKind::logarithm, .at = "T6"}};
  const std::string message = support::thrownMessage([&] { build(scene); });
  EXPECT_EQ(message.find("[[profile]] press = \"logarithm\": the best smooth curve is 19 % off"), 0u) << message;
  EXPECT_EQ(messageFor("[[profile]]\nat = \"T6\"\npress = \"user\"\n" + kFinger),
            "s.toml:1: [[profile]] press = \"user\" needs press_file");
  EXPECT_EQ(messageFor("[[profile]]\nat = \"T6\"\ndrag_file = \"a.csv\"\n" + kFinger),
            "s.toml:1: [[profile]] drag_file is read only with drag = \"user\"");
}

}  // namespace
}  // namespace palpate::scene

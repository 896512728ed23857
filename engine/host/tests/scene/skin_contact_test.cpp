#include "palpate/scene/skin_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "palpate/contact/friction.h"
#include "palpate/deform/finger_contact.h"
#include "palpate/mesh/files/save.h"
#include "palpate/scene/anatomical_reach.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/tissue_of_body.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::scene {
namespace {

/// The torso, built once, in the forms of these lines of a scene file.
World worldWith(const std::string& toml) {
  const std::string finger = "\n[[finger]]\nname = \"index\"\nscript = [{ do = \"press\" }]\n";
  static const auto plain = build(
      parse("[body]\nkind = \"torso\"\ntriangles = 8163\n[deformation]\ntissue = \"gaussian\"\n" + finger, "s.toml"));
  World world = *plain;
  const Scene scene = parse(toml + finger, "s.toml");
  world.deformation = formsOf(scene);
  world.contours = contoursOf(scene, {});
  world.reach = reachOf(scene, world.body->skin, world.body->anatomy, world.surface.geometry->tree, nullptr);
  return world;
}

contact::FingerOutput dragging(const World& world) {
  contact::FingerOutput finger{};
  const Index triangle = 1000;
  const auto& [a, b, c] = world.body->skin.triangles[triangle];
  const Vec3 normal =
      mesh::areaVector2(world.body->skin.positions[a], world.body->skin.positions[b], world.body->skin.positions[c]);
  finger.normal = normal.normalized();
  const Vec3 along = finger.normal.unitOrthogonal();
  finger.anchor = centreOf(world.body->skin, world.body->skin.triangles[triangle]);
  finger.proxy = finger.anchor + 2.0 * along;
  finger.tip = finger.proxy - 6.0 * finger.normal;
  finger.force = 3.0 * finger.normal - 1.0 * along;
  finger.depth_mm = 6.0;
  finger.touch = contact::Touch::stick;
  finger.triangle = finger.anchor_triangle = triangle;
  return finger;
}

TEST(SkinContact, IsThatOfTheMapsByDefault) {
  const World world = worldWith("");
  const contact::FingerOutput finger = dragging(world);
  const auto contact = contactOf(world, finger);
  const auto expected = deform::contactOf(finger, world.ellipses, deform::TissueSettings{});
  ASSERT_TRUE(contact && expected);
  EXPECT_EQ(contact->anchor, finger.anchor);
  EXPECT_EQ(contact->normal_region.half_major, expected->normal_region.half_major);
  EXPECT_EQ(contact->tangential_region.half_major, expected->tangential_region.half_major);
  EXPECT_EQ(contact->tangential_contour.contour.count, 0u);
}

TEST(SkinContact, FreeFingerTouchesNothing) {
  const World world = worldWith("");
  contact::FingerOutput finger = dragging(world);
  finger.touch = contact::Touch::free;
  EXPECT_FALSE(contactOf(world, finger));
}

TEST(SkinContact, ADentIsWhereSkinWasLeftDentedAndNowhereElse) {
  const World world = worldWith("");
  contact::FingerOutput finger = dragging(world);
  finger.touch = contact::Touch::free;
  EXPECT_FALSE(dentOf(world, finger)) << "none is left";
  finger.dent = {.place = finger.anchor, .rest_mm = 2.0, .triangle = finger.triangle};
  const auto dent = dentOf(world, finger);
  ASSERT_TRUE(dent);
  EXPECT_EQ(dent->anchor, finger.anchor);
  EXPECT_GT(dent->depth_mm, 1.0);
  EXPECT_EQ(dent->drag_mm, Vec3::Zero());
  finger.dent.triangle = kNoIndex;
  EXPECT_FALSE(dentOf(world, finger));
  finger.dent = {.place = finger.anchor, .rest_mm = 0.0, .triangle = finger.triangle};
  EXPECT_FALSE(dentOf(world, finger)) << "it has gone";
}

TEST(SkinContact, APressDoesNotComeOutOfTheFarSideOfAThinPart) {
  const support::TemporaryFolder folder;
  for (const double thickness_mm : {0.5, 5.0}) {
    mesh::save(folder / "plate.obj", zoo::plate(50.0, thickness_mm));
    const auto world =
        build(parse("[body]\nkind = \"mesh\"\nfile = \"plate.obj\"\n[[finger]]\nname = \"index\"\nscript = [{ do = "
                    "\"press\" }]\n",
                    (folder / "s.toml").string()));
    contact::FingerOutput finger;
    finger.normal = Vec3::UnitZ();
    finger.tip = finger.proxy = finger.anchor = Vec3(25.0, 25.0, thickness_mm);
    finger.touch = contact::Touch::stick;
    finger.triangle = finger.anchor_triangle =
        tree::firstFrontCrossing(world->surface.geometry->tree, Vec3(25, 25, 20), Vec3(25, 25, -20)).triangle;
    for (const double share : {0.5, 0.95, 1.2, 1.5}) {
      finger.depth_mm = share * thickness_mm;
      const double most_mm = std::min(share, 0.9) * thickness_mm;
      EXPECT_NEAR(contactOf(*world, finger)->depth_mm, most_mm, 1e-6) << share << " of " << thickness_mm << " mm";
    }
  }
}

TEST(SkinContact, PrintedAnchorIsDerivedFromTheForce) {  // E1
  World world = worldWith("fidelity.E1 = \"literal\"\n");
  contact::FingerOutput finger = dragging(world);
  finger.force = 3.0 * finger.normal + 1.0 * (finger.anchor - finger.proxy).normalized();
  const Vec3 along = (finger.anchor - finger.proxy).normalized();
  const auto contact = contactOf(world, finger);
  ASSERT_TRUE(contact);
  EXPECT_LT((contact->anchor - (finger.proxy + 2.0 * along)).norm(), 1e-9) << "6 mm x 1 N / 3 N";
  EXPECT_LT((contact->drag_mm + 2.0 * along).norm(), 1e-9);
  world.scene.contact.finger.stiffness_ratio = 0.25;
  EXPECT_LT((contactOf(world, finger)->drag_mm + 8.0 * along).norm(), 1e-9) << "of a spring four times as soft";
}

// 2.3: a felt surface that gives way leaves half of the stiffness and half of the depth to the skin; with k doubled the
// force is back.
TEST(SkinContact, AHapticSurfaceThatYieldsTakesHalfOfTheDepth) {
  const std::string body =
      "[body]\nkind = \"back\"\ntriangles = 2962\n[deformation]\ntissue = \"gaussian\"\n"
      "[tissue]\nforce_law = \"linear\"\n[[finger]]\nname = \"index\"\nscript = [{ do = \"press\" }]\n";
  const auto rigid = build(parse(body, "s.toml"));
  const auto world_with = [&](const std::string& kind) {
    return rebuilt(*rigid, parse("[contact]\nhaptic_surface = \"" + kind + "\"\n" + body, "s.toml"));
  };
  const auto yields = world_with("yields"), doubled = world_with("yields_doubled");
  const Index v = rigid->body->skin.triangles[1000][0];
  EXPECT_EQ((*yields->surface.stiffness_n_per_mm)[v], 0.5 * (*rigid->surface.stiffness_n_per_mm)[v]);
  EXPECT_EQ((*doubled->surface.stiffness_n_per_mm)[v], (*rigid->surface.stiffness_n_per_mm)[v]);
  const contact::FingerOutput finger = dragging(*rigid);
  EXPECT_EQ(contactOf(*rigid, finger)->depth_mm, 6.0);
  EXPECT_EQ(contactOf(*yields, finger)->depth_mm, 3.0);
  EXPECT_EQ(contactOf(*doubled, finger)->depth_mm, 3.0);
}

TEST(SkinContact, PressEllipseGrowsInProportionToTheDepth) {  // 4.2
  const World world = worldWith("[deformation]\nregion = \"scaled\"\n");
  contact::FingerOutput finger = dragging(world);
  const auto share = [&](double depth_mm) {
    finger.depth_mm = depth_mm;
    const auto contact = contactOf(world, finger);
    EXPECT_EQ(contact->normal_region.aspect, contact->tangential_region.aspect);
    return contact->normal_region.half_major.norm() / contact->tangential_region.half_major.norm();
  };
  EXPECT_NEAR(share(2.0), 0.2, 1e-12);
  EXPECT_NEAR(share(6.0), 0.6, 1e-12);
  EXPECT_NEAR(share(25.0), 1.0, 1e-12) << "the cap is 10 mm";
  EXPECT_EQ(share(-1.0), 0.0);
}

TEST(SkinContact, EllipseOfTheNearestVertexAsPrinted) {  // 5.2
  World world = worldWith("");
  world.scene.ellipses.place = EllipsePlace::nearest_vertex;
  contact::FingerOutput finger = dragging(world);
  const Vec3 corner = world.body->skin.positions[world.body->skin.triangles[finger.anchor_triangle][1]];
  const auto expected = world.ellipses.on(corner, finger.normal);
  finger.anchor = 0.7 * corner + 0.3 * finger.anchor;
  const Vec3 near = contactOf(world, finger)->tangential_region.half_major;
  EXPECT_EQ(near, expected.half_major);
  finger.anchor = 0.9 * corner + 0.1 * finger.anchor;
  EXPECT_EQ(contactOf(world, finger)->tangential_region.half_major, near) << "it does not change within the cell";
  world.scene.ellipses.place = EllipsePlace::anchor;
  EXPECT_NE(contactOf(world, finger)->tangential_region.half_major, near);
}

TEST(SkinContact, OneEllipseForBothPartsAsPrinted) {  // E21
  const World world = worldWith("[deformation]\nregion = \"shared\"\nboundary = \"two_mm\"\n");
  const contact::FingerOutput finger = dragging(world);
  const auto contact = contactOf(world, finger);
  const auto measured = deform::contactOf(finger, world.ellipses, deform::TissueSettings{});
  ASSERT_TRUE(contact && measured);
  EXPECT_EQ(contact->normal_region.half_major, contact->tangential_region.half_major);
  EXPECT_NEAR(contact->tangential_region.half_major.norm() / measured->tangential_region.half_major.norm(), 1.635,
              1e-3);
}

// Without a table of contours the map's ellipse is bent to the place: on the even back by little, and no ellipse any
// more.
TEST(SkinContact, BuiltInContoursAreTheEllipsesBentToThePlace) {
  const World world = worldWith("[deformation]\nshape = \"contour\"\n");
  const contact::FingerOutput finger = dragging(world);
  const auto contact = contactOf(world, finger);
  ASSERT_TRUE(contact);
  const maps::SurfaceContour& bent = contact->tangential_contour;
  ASSERT_GE(bent.contour.count, 24u);
  double shortest = 1.0;
  double skew = 0.0;
  for (std::size_t i = 0; i < bent.contour.count; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(bent.contour.count);
    const Vec3 ahead = std::cos(angle) * bent.axis_x + std::sin(angle) * bent.axis_y;
    const double factor = maps::radiusAt(bent.contour, angle) * maps::locationRatio(contact->tangential_region, ahead);
    EXPECT_GE(factor, 0.24);
    EXPECT_LE(factor, 1.65);
    shortest = std::min(shortest, factor);
    skew = std::max(skew, std::abs(std::log(maps::radiusAt(bent.contour, angle) /
                                            maps::radiusAt(bent.contour, angle + std::numbers::pi))));
  }
  EXPECT_LT(shortest, 0.98);
  EXPECT_GT(skew, 0.02) << "an ellipse is the same both ways";
}

}  // namespace
}  // namespace palpate::scene

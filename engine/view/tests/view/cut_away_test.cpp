// The body cut open through finger and lump, and lumps under the skin.
#include "palpate/view/overlays/cut_away.h"

#include <gtest/gtest.h>

#include <numbers>

#include "palpate/view/overlays/lump_marks.h"
#include "palpate/view/overlays/marks.h"
#include "palpate/view/overlays/overlays.h"
#include "view/tests/view/lump_world.h"

namespace palpate::view {
namespace {

CutAway cutOf(const scene::World& world, const FingerMark& finger) {
  const deform::DeformedSurface surface = deformedBy(world, {&finger, 1});
  const auto at = [&](Index v) { return Vec3(surface.positionAt(v).cast<double>()); };
  const auto cut = CutMaker(world).cut({&finger, 1}, at);
  EXPECT_TRUE(cut.has_value());
  return cut.value_or(CutAway{});
}

double areaOf(const std::vector<Vec2>& rim) {
  double area = 0.0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Vec2& a = rim[i];
    const Vec2& b = rim[(i + 1) % rim.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return std::abs(area);
}

TEST(EllipsoidIn, IsACircleOfTheRightSizeForABallAndNothingBesideIt) {
  const std::array<Vec3, 3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  SectionPlane plane;
  plane.origin = {0.0, 3.0, 0.0};  // 3 mm from the middle of a ball of 5
  const auto rim = ellipsoidIn(plane, Vec3(1.0, 0.0, -2.0), axes, {5.0, 5.0, 5.0});
  ASSERT_FALSE(rim.empty());
  for (const Vec2& point : rim) EXPECT_NEAR((point - Vec2(1.0, -2.0)).norm(), 4.0, 1e-9);
  plane.origin.y() = 5.1;
  EXPECT_TRUE(ellipsoidIn(plane, Vec3(1.0, 0.0, -2.0), axes, {5.0, 5.0, 5.0}).empty());
}

TEST(EllipsoidIn, TurnsWithTheEllipsoid) {
  const double s = std::sqrt(0.5);
  const std::array<Vec3, 3> axes = {Vec3(s, 0.0, s), Vec3::UnitY(), Vec3(-s, 0.0, s)};
  const auto rim = ellipsoidIn({}, Vec3::Zero(), axes, {6.0, 4.0, 2.0});
  EXPECT_NEAR(areaOf(rim), std::numbers::pi * 12.0, 0.2);
  for (const Vec2& point : rim) {
    const Vec3 at(point.x(), 0.0, point.y());
    EXPECT_NEAR(std::pow(at.dot(axes[0]) / 6.0, 2) + std::pow(at.dot(axes[2]) / 2.0, 2), 1.0, 1e-9);
  }
}

TEST(CutAway, HoldsTheFingerAndTheFootOfTheNearestLump) {
  scene::LumpSettings far = lumpAt(-40.0, 60.0);
  far.name = "far";
  const auto world = lumpyTorso({far, lumpAt(kLumpX, kLumpY)});
  const FingerMark finger = fingertipAt(*world, kLumpX - 9.0, kLumpY + 4.0, 5.0);
  const CutAway cut = cutOf(*world, finger);
  ASSERT_EQ(cut.nearest, 1u);
  EXPECT_EQ(cut.lumps[1].name, "hard");
  const Vec3 beside = cut.plane.along.cross(cut.plane.upward);
  EXPECT_LT(std::abs((world->lumps[1]->lump.foot - cut.plane.origin).dot(beside)), 1e-6);
  EXPECT_GT(cut.plane.along.x(), 0.0) << "the patient's right is at the right";
  EXPECT_LT(cut.low.x(), cut.lumps[1].middle.x() - 4.0);
  EXPECT_GT(cut.high.x(), cut.lumps[1].middle.x() + 4.0);
  EXPECT_LT(cut.low.y(), cut.lumps[1].middle.y() - 4.0);
}

TEST(CutAway, HasTheLayersOfThePlaceDownToTheBone) {
  const auto world = lumpyTorso();
  const FingerMark finger = fingertipAt(*world, kLumpX, kLumpY, 0.3);
  const CutAway cut = cutOf(*world, finger);
  ASSERT_EQ(cut.layers.size(), 3u);
  EXPECT_EQ(cut.layers[0].name, "skin");
  EXPECT_EQ(cut.layers[2].name, "muscle");
  EXPECT_NEAR(cut.bone_mm, world->lumps[0]->thickness_mm, 1.5) << "the finger has slid a little";
  const auto middle = static_cast<std::size_t>(
      std::min_element(cut.skin.begin(), cut.skin.end(),
                       [](const Vec2& a, const Vec2& b) { return std::abs(a.x()) < std::abs(b.x()); }) -
      cut.skin.begin());
  double above = cut.skin[middle].y();
  for (const CutAway::Layer& layer : cut.layers) {
    ASSERT_EQ(layer.below.size(), cut.skin.size());
    EXPECT_LT(layer.below[middle].y(), above);
    above = layer.below[middle].y();
  }
  EXPECT_NEAR(cut.rest[middle].y() - cut.layers[0].below[middle].y(), 2.0, 0.4) << "skin of 2 mm";
  EXPECT_NEAR(cut.rest[middle].y() - above, cut.bone_mm, 0.5);
}

TEST(CutAway, SinksTheLumpWithTheSkinAndLeavesTheBone) {
  const auto world = lumpyTorso();
  const CutAway rest = cutOf(*world, fingertipAt(*world, kLumpX, kLumpY, 0.1));
  const CutAway pressed = cutOf(*world, fingertipAt(*world, kLumpX, kLumpY, 6.0));
  const double sunk = rest.lumps[0].middle.y() - pressed.lumps[0].middle.y();
  EXPECT_GT(sunk, 1.0);
  EXPECT_LT(sunk, 6.0);
  EXPECT_NEAR(rest.layers.back().below[rest.skin.size() / 2].y(),
              pressed.layers.back().below[pressed.skin.size() / 2].y(), 0.3);
}

TEST(CutAway, LaysTheFingerOnTheSkinThatGaveWay) {
  const auto world = lumpyTorso();
  const CutAway cut = cutOf(*world, fingertipAt(*world, kLumpX, kLumpY, 6.0));
  for (const Vec2& point : cut.skin) EXPECT_GT((point - cut.finger).norm(), cut.finger_mm - 1e-6);
}

TEST(CutAway, ShowsHowFarAMobileLumpHasMoved) {
  const MovedLump made = movedLump(4.0, 3.0);
  const CutAway cut = cutOf(*made.world, made.finger);
  EXPECT_NEAR(cut.lumps[0].moved_mm, 3.0, 1e-12);
  EXPECT_GT(cut.lumps[0].middle.x(), 7.0) << "9 mm away along the map now, not 6, on skin that slopes";
  ASSERT_FALSE(cut.lumps[0].placed.empty()) << "and where it was";
}

TEST(CutAway, IsACutThroughTheFingerWhereNoLumpIsNear) {
  const auto world = lumpyTorso({});
  const CutAway cut = cutOf(*world, fingertipAt(*world, kLumpX, kLumpY, 4.0));
  EXPECT_FALSE(cut.nearest);
  EXPECT_EQ(cut.layers.size(), 3u);
  EXPECT_TRUE(CutMaker(*world).cut({}, [](Index) { return Vec3(Vec3::Zero()); }) == std::nullopt) << "no finger";
}

TEST(LumpMarks, LieAtTheirPlaceUnderTheSkin) {
  const auto world = lumpyTorso();
  DrawnSkin skin;
  skin.copyAll(deformedBy(*world, {}));
  Patches solid;
  addLumps(*world, {}, skin, solid);
  const contact::Lump& lump = world->lumps[0]->lump;
  const Vec3 middle = lump.foot - 8.0 * lump.axis;
  ASSERT_FALSE(solid.points.empty());
  for (const PaintedPoint& point : solid.points) EXPECT_NEAR((point.place.cast<double>() - middle).norm(), 4.0, 1e-3);
}

TEST(LumpMarks, FollowAMobileLump) {
  scene::LumpSettings mobile = lumpAt(kLumpX, kLumpY);
  mobile.mobility_mm_per_n = 20.0;
  const auto world = lumpyTorso({mobile});
  FingerMark finger;
  finger.contact.lump = 0;
  finger.contact.lump_moved_mm = Vec2(-2.0, 1.0);
  DrawnSkin skin;
  skin.copyAll(deformedBy(*world, {}));
  const contact::Lump& lump = world->lumps[0]->lump;
  const Vec3 moved = lumpCentre(*world, 0, {&finger, 1}, skin) - lumpCentre(*world, 0, {}, skin);
  EXPECT_NEAR(moved.dot(lump.across), -2.0, 1e-6);
  EXPECT_NEAR(moved.dot(lump.up), 1.0, 1e-6);
}

TEST(LumpMarks, AreNowhereUnlessTheLookShowsThem) {
  const auto world = lumpyTorso();
  const FingerMark finger = fingertipAt(*world, kLumpX, kLumpY, 4.0);
  DrawnSkin skin;
  skin.copyAll(deformedBy(*world, {&finger, 1}));
  Overlays overlays(*world);
  for (std::size_t i = 0; i < kOverlays; ++i) {
    Look look;
    look.overlays.set(i);
    const bool shown = static_cast<Overlay>(i) == Overlay::lumps;
    EXPECT_EQ(!overlays.shapes(look, skin, {&finger, 1}).solid.points.empty(), shown) << kOverlayNames[i];
  }
}

}  // namespace
}  // namespace palpate::view

#include "palpate/view/overlays/section.h"

#include <gtest/gtest.h>

#include <numbers>

#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

TEST(Section, OfFlatSkinIsADentAsDeepAsTheFinger) {
  const auto world = flatWorld();
  const FingerMark finger = pressedFinger(*world, {51.0, 49.0, 0.0}, 6.0);
  const auto surface = deformedBy(*world, {&finger, 1});
  const SectionPlane plane = sectionPlane(*world, finger.contact);
  const auto curve = sectionCurve(*world, surface, plane, 40.0);
  ASSERT_GT(curve.size(), 30u);
  double deepest = 0.0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    EXPECT_NEAR(curve[i].rest.y(), 0.0, 1e-9) << "at rest the skin is flat";
    EXPECT_TRUE(i == 0 || curve[i].rest.x() > curve[i - 1].rest.x()) << "in order";
    deepest = std::min(deepest, curve[i].deformed.y());
  }
  EXPECT_NEAR(deepest, -6.0, 0.3);
  EXPECT_LT(curve.front().rest.x(), -40.0 + 2.0);
  EXPECT_GT(curve.back().rest.x(), 40.0 - 2.0);
  EXPECT_EQ(curve.front().rest, curve.front().deformed) << "far away nothing moves";
}

TEST(Section, LiesAlongTheDrag) {
  const auto world = flatWorld();
  const FingerMark finger = pressedFinger(*world, {50.0, 50.0, 0.0}, 8.0, {0.0, 2.0, 0.0});
  const SectionPlane plane = sectionPlane(*world, finger.contact);
  EXPECT_NEAR(std::abs(plane.along.y()), 1.0, 1e-6);
  const auto surface = deformedBy(*world, {&finger, 1});
  const auto curve = sectionCurve(*world, surface, plane, 30.0);
  double pulled = 0.0;
  for (const SectionPoint& point : curve) pulled = std::max(pulled, (point.deformed - point.rest).x());
  EXPECT_NEAR(pulled, 2.0, 0.2);
}

TEST(Section, TellsItsEndsApartByLettersAndThePatientsSides) {
  const auto ends_of = [](const Vec3& along) {
    const SectionEnds ends = sectionEnds({Vec3::Zero(), along.normalized(), Vec3::UnitZ()});
    return ends.low + ", " + ends.high;
  };
  EXPECT_EQ(ends_of(Vec3::UnitX()), "A left, B right");
  EXPECT_EQ(ends_of(-Vec3::UnitX()), "A right, B left");
  EXPECT_EQ(ends_of({0.3, 1.0, 0.0}), "A caudal, B cranial");
  EXPECT_EQ(ends_of(-Vec3::UnitY()), "A cranial, B caudal");
  EXPECT_EQ(ends_of({1.0, 1.0, 0.0}), "A, B") << "between the sides";
}

TEST(Section, ThroughACornerOfTheMeshIsWholeToo) {
  const auto world = flatWorld();
  const auto surface = deformedBy(*world, {});
  const SectionPlane plane{{50.0, 50.0, 0.0}, Vec3::UnitX(), Vec3::UnitZ()};  // along a line of edges
  const auto curve = sectionCurve(*world, surface, plane, 30.0);
  ASSERT_FALSE(curve.empty());
  EXPECT_LE(curve.front().rest.x(), -30.0);
  EXPECT_GE(curve.back().rest.x(), 30.0);
}

TEST(Section, GoesRoundAClosedBodyOnce) {
  const auto world = meshWorld(zoo::sphere(20.0));
  const auto surface = deformedBy(*world, {});
  const SectionPlane plane{{0.0, 0.0, 20.0}, Vec3::UnitX(), Vec3::UnitZ()};
  const auto curve = sectionCurve(*world, surface, plane, 1000.0);
  ASSERT_GT(curve.size(), 20u);
  EXPECT_EQ(curve.front().rest, curve.back().rest) << "closed";
  double turned_rad = 0.0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec3 here = onPlane(plane, curve[i].rest);
    EXPECT_NEAR(here.norm(), 20.0, 0.3);
    if (i == 0) continue;
    const Vec3 before = onPlane(plane, curve[i - 1].rest);
    turned_rad += std::atan2(before.cross(here).y(), before.dot(here));
  }
  EXPECT_NEAR(std::abs(turned_rad), 2.0 * std::numbers::pi, 1e-9);
}

TEST(Section, IsEmptyWhereThereIsNoSkin) {
  const auto world = flatWorld();
  const SectionPlane far_away{{0.0, 0.0, 500.0}, Vec3::UnitX(), Vec3::UnitZ()};
  EXPECT_TRUE(sectionCurve(*world, deformedBy(*world, {}), far_away).empty());
}

}  // namespace
}  // namespace palpate::view

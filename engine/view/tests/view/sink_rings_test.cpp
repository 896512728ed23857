// Rings of a finger's sink: they tell the depth and nothing else.
#include "palpate/view/overlays/sink_rings.h"

#include <gtest/gtest.h>

#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

/// Farthest of the bold ring from the axis of the press, mm; 0 without rings.
double reachOf(const std::vector<Lines>& rings, const contact::FingerOutput& finger) {
  double farthest = 0.0;
  if (rings.empty()) return farthest;
  for (const PaintedPoint& point : rings.back().points) {
    const Vec3 away = point.place.cast<double>() - finger.proxy;
    farthest = std::max(farthest, (away - away.dot(finger.normal) * finger.normal).norm());
  }
  return farthest;
}

/// The built-in body, made once.
const scene::World& ringedWorld() {
  static const std::shared_ptr<const scene::World> world = scene::build(scene::Scene{});
  return *world;
}

std::size_t ringsIn(const Lines& lines) {
  constexpr std::size_t kPointsOfRing = 80;  // 40 segments
  return lines.points.size() / kPointsOfRing;
}

TEST(SinkRings, OpenWithTheDepthAndAreTheSameForEveryPlace) {
  const scene::World& world = ringedWorld();
  for (const double depth_mm : {1.2, 4.0, 6.7}) {
    for (const double x_mm : {-35.0, 35.0}) {
      const FingerMark finger = pressedFinger(
          world,
          tree::firstFrontCrossing(world.surface.geometry->tree, Vec3(x_mm, 60.0, 500.0), Vec3(x_mm, 60.0, -500.0))
              .point,
          depth_mm);
      const auto rings = sinkRings(world, finger.contact);
      ASSERT_EQ(rings.size(), 3u);
      EXPECT_NEAR(reachOf(rings, finger.contact), sinkRadius(finger.contact.depth_mm), 0.01);
      EXPECT_EQ(ringsIn(rings.front()), static_cast<std::size_t>(finger.contact.depth_mm) + 1);
    }
  }
  EXPECT_GT(sinkRadius(5.0), sinkRadius(4.0) + 3.0) << "a millimetre is seen";
}

TEST(SinkRings, AreNotThereWithoutATouch) {
  const scene::World& world = ringedWorld();
  contact::FingerOutput finger;
  EXPECT_TRUE(sinkRings(world, finger).empty());
  finger.touch = contact::Touch::stick;
  finger.normal = Vec3::UnitZ();
  EXPECT_TRUE(sinkRings(world, finger).empty()) << "it touches and has not sunk in";
}

}  // namespace
}  // namespace palpate::view

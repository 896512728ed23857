#include "palpate/maps/ellipse_map.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "support/golden.h"

namespace palpate::maps {

using test::golden;

std::vector<KeyPoint> keysOf(const nlohmann::json& data) {
  std::vector<KeyPoint> keys;
  for (const auto& [name, key] : data["keys"].items()) {
    const double half_major = key["half_major_mm"];
    const double direction = key["deg"].get<double>() * std::numbers::pi / 180.0;
    keys.push_back({name,
                    test::vec2(key["xy"]),
                    canonicalEllipse(half_major, half_major / key["ratio"].get<double>(), direction),
                    {}});
  }
  return keys;
}

TEST(EllipseMap, SevenKeyPointsGiveTheReferenceField) {
  const auto data = golden("direction_interp")["seven_keys"];
  const auto keys = keysOf(data);
  for (const double radius : {150.0, 200.0, 400.0}) {
    const EllipseMap map(keys, {radius, data["r_c"]});
    for (const auto& place : data["field"]) {
      const auto& expected = place[fmt::format("e{}", radius)]["log_tensor"];
      const Ellipse e = map.at(place["p"][0], place["p"][1]);
      EXPECT_NEAR(e.half_major_mm, expected["half_major"], 1e-9) << place;
      EXPECT_NEAR(1.0 / e.aspect, expected["ratio"], 1e-11) << place;
      if (e.aspect > 1.0 - 1e-9) continue;  // a circle has no direction
      EXPECT_NEAR(std::sin(e.direction_rad - expected["deg"].get<double>() * std::numbers::pi / 180.0), 0.0, 1e-8);
    }
  }
}

TEST(EllipseMap, KeyPointsKeepTheirOwnEllipse) {
  const auto keys = dissertationKeyPoints();
  const EllipseMap map(keys);
  for (const KeyPoint& key : keys) {
    const Ellipse e = map.at(key.position_mm.x(), key.position_mm.y());
    EXPECT_NEAR(e.half_major_mm, key.ellipse.half_major_mm, 1e-9) << key.name;
    EXPECT_NEAR(e.aspect, key.ellipse.aspect, 1e-12) << key.name;
  }
}

TEST(EllipseMap, LeftAndRightAreMirrored) {
  const EllipseMap map(dissertationKeyPoints());
  Random random(11);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.uniform(-200, 200);
    const double y = random.uniform(-300, 300);
    const Ellipse right = map.at(x, y);
    const Ellipse left = map.at(-x, y);
    EXPECT_NEAR(right.half_major_mm, left.half_major_mm, 1e-9);
    EXPECT_NEAR(right.aspect, left.aspect, 1e-12);
    if (right.aspect > 1.0 - 1e-6) continue;  // a circle has no direction
    EXPECT_NEAR(std::sin(right.direction_rad + left.direction_rad), 0.0, 1e-6);
  }
}

TEST(EllipseMap, WithoutKeyPointsItIsTheBasicCircle) {
  const Ellipse e = EllipseMap({}, {200.0, 80.0}).at(3.0, 4.0);
  EXPECT_NEAR(e.half_major_mm, 80.0, 1e-12);
  EXPECT_EQ(e.aspect, 1.0);
}

TEST(EllipseMap, AnswersEverywhereWhateverTheNumberOfKeyPoints) {
  Random random(3);
  for (const int n : {1, 2, 7, 10000}) {
    std::vector<KeyPoint> keys;
    for (int i = 0; i < n; ++i) {
      keys.push_back({"k",
                      {random.uniform(-200, 200), random.uniform(-200, 200)},
                      {random.uniform(20, 180), random.uniform(0.3, 1.0), random.uniform(0, 3.1)},
                      {}});
    }
    keys.push_back(keys.front());  // coincident on purpose
    const EllipseMap map(keys);
    for (const Vec2& place : {keys.front().position_mm, Vec2(0, 0), Vec2(1e6, 0)}) {
      const Ellipse e = map.at(place.x(), place.y());
      EXPECT_GE(e.half_major_mm, 10.0);
      EXPECT_LE(e.half_major_mm, 200.0);
      EXPECT_GT(e.aspect, 0.0);
      EXPECT_LE(e.aspect, 1.0);
    }
  }
}

TEST(EllipseMap, RefusesABasicCircleWithoutSize) { EXPECT_THROW(EllipseMap({}, {200.0, 0.0}), Error); }

TEST(EllipseMap, EveryPlaceGetsAnEllipseInItsTangentPlane) {
  const EllipseMap map(dissertationKeyPoints());
  const std::vector<Vec3> positions{{0, 0, 100}, {120, 50, 40}, {0, 0, -100}};
  const std::vector<Vec3> normals{Vec3::UnitZ(), Vec3(0.8, 0, 0.6), -Vec3::UnitZ()};
  for (std::size_t v = 0; v < 3; ++v) {
    const SurfaceEllipse ellipse = map.on(positions[v], normals[v]);
    EXPECT_NEAR(ellipse.half_major.dot(normals[v]), 0.0, 1e-9);
    const Ellipse flat = map.at(positions[v].x(), positions[v].y());
    EXPECT_NEAR(ellipse.half_major.norm(), flat.half_major_mm, 1e-9);
  }
}

}  // namespace palpate::maps

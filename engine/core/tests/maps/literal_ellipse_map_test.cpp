#include "palpate/maps/literal_ellipse_map.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/maps/gaussian_interpolation.h"
#include "support/golden.h"

namespace palpate::maps {

using test::golden;
using test::goldenRows;

Fidelity taking(std::initializer_list<Erratum> errata) {
  Fidelity fidelity;
  for (const Erratum e : errata) fidelity.setLiteral(e);
  return fidelity;
}

/// Angle between two undirected axes, in degree.
double apart(double direction_rad, double degree) {
  return std::asin(std::abs(std::sin(direction_rad - degree * kRadPerDeg))) / kRadPerDeg;
}

std::vector<KeyPoint> sevenKeys(const nlohmann::json& data) {
  std::vector<KeyPoint> keys;
  for (const auto& [name, key] : data["keys"].items()) {
    const double half_major = key["half_major_mm"];
    keys.push_back(
        {name,
         test::vec2(key["xy"]),
         canonicalEllipse(half_major, half_major / key["ratio"].get<double>(), key["deg"].get<double>() * kRadPerDeg),
         {}});
  }
  return keys;
}

/// Keys round the origin, so far away that each has the level asked for there.
std::vector<KeyPoint> keysWithLevels(const nlohmann::json& levels, const nlohmann::json& degrees, double radius_mm) {
  std::vector<KeyPoint> keys;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double level = levels[i];
    const double distance = level > 0.0 ? radius_mm * std::sqrt(-std::log(level) / kGaussianRate) : 2 * radius_mm;
    const double angle = static_cast<double>(i);
    keys.push_back({"K",
                    distance * Vec2(std::cos(angle), std::sin(angle)),
                    canonicalEllipse(120.0, 120.0 / 1.3, degrees[i].get<double>() * kRadPerDeg),
                    {}});
  }
  return keys;
}

/// (5.17) on degrees as numbers, the basic circle pointing to 90.
double blendedDegrees(const std::vector<double>& levels, const std::vector<double>& degrees) {
  GaussianBlend<double> blend(90.0);
  for (std::size_t i = 0; i < levels.size(); ++i) blend.add(levels[i], degrees[i]);
  return blend.result();
}

TEST(LiteralEllipseMap, SevenKeyPointsGiveThePrintedField) {
  const auto data = golden("direction_interp")["seven_keys"];
  const auto keys = sevenKeys(data);
  for (const double radius : {150.0, 200.0, 400.0}) {
    const LiteralEllipseMap map(keys, {radius, data["r_c"]}, taking({Erratum::E29_mean_of_angles}));
    for (const auto& place : data["field"]) {
      const auto& expected = place[fmt::format("e{}", radius)]["literal"];
      const Ellipse e = map.at(place["p"][0], place["p"][1]);
      EXPECT_NEAR(e.half_major_mm, expected["half_major"], 1e-9) << place;
      EXPECT_NEAR(1.0 / e.aspect, expected["ratio"], 1e-11) << place;
      EXPECT_NEAR(apart(e.direction_rad, expected["deg"]), 0.0, 1e-6) << place;
    }
  }
}

TEST(LiteralEllipseMap, DirectionsAsNumbersAndByDoubleAngle) {
  for (const auto& c : goldenRows("direction_interp", "cases")) {
    const auto keys = keysWithLevels(c["a"], c["deg"], 200.0);
    const EllipseMapSettings settings{200.0, 90.0};
    const Ellipse raw = LiteralEllipseMap(keys, settings, taking({Erratum::E29_mean_of_angles})).at(0, 0);
    const bool has_zero = std::find(c["deg"].begin(), c["deg"].end(), 0) != c["deg"].end();  // the map says 180
    if (!has_zero) {
      EXPECT_NEAR(apart(raw.direction_rad, c["literal_5_17_dc90"]), 0.0, 1e-6) << c;
    }
    EXPECT_NEAR(blendedDegrees(c["a"], c["deg"]), c["literal_5_17_dc90"], 1e-9) << c;
    LiteralForms by_double_angle;
    by_double_angle.direction = DirectionBlend::double_angle;
    const Ellipse doubled = LiteralEllipseMap(keys, settings, by_double_angle).at(0, 0);
    EXPECT_NEAR(apart(doubled.direction_rad, c["double_angle_deg"]), 0.0, 1e-6) << c;
  }
}

// From P3 (180 degree) the printed direction turns the same way on both sides of the spine.
TEST(LiteralEllipseMap, PrintedDirectionsAreNoMirrorImages) {
  const auto keys = sevenKeys(golden("direction_interp")["seven_keys"]);
  const LiteralEllipseMap literal(keys, {200.0, 150.0}, taking({Erratum::E29_mean_of_angles}));
  const LiteralEllipseMap corrected(keys, {200.0, 150.0}, Fidelity{});
  const auto sum = [](const LiteralEllipseMap& map) {
    return (map.at(30, 31.25).direction_rad + map.at(-30, 31.25).direction_rad) / kRadPerDeg;
  };
  EXPECT_NEAR(sum(literal), 279.77, 0.01);
  EXPECT_NEAR(sum(corrected), 180.0, 1e-6);
}

TEST(LiteralEllipseMap, TakingNothingLiterallyItIsTheEllipseMap) {
  const auto keys = dissertationKeyPoints();
  const EllipseMap map(keys);
  const LiteralEllipseMap same(keys, {}, Fidelity{});
  LiteralForms forms;
  forms.weights = LiteralWeights::products;
  const LiteralEllipseMap products(keys, {}, forms);
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    const Vec3 place(random.uniform(-200, 200), random.uniform(-300, 300), 0.0);
    const Vec3 normal(random.uniform(-1, 1), random.uniform(-1, 1), 1.0);
    const SurfaceEllipse expected = map.on(place, normal);
    EXPECT_EQ(same.on(place, normal).half_major, expected.half_major);
    EXPECT_EQ(same.on(place, normal).aspect, expected.aspect);
    EXPECT_LT((products.on(place, normal).half_major - expected.half_major).norm(), 1e-6);
  }
}

// Each of the errata of the maps alone, at a place between P2 and P5.
TEST(LiteralEllipseMap, EachErratumSwitchesAlone) {
  const auto keys = dissertationKeyPoints();
  const Vec3 place(-60, -90, 0);
  const Vec3 normal(0.5, 0.2, 0.8);
  const SurfaceEllipse corrected = LiteralEllipseMap(keys, {}, Fidelity{}).on(place, normal);
  for (const Erratum e : {Erratum::E15_aspect, Erratum::E16_full_axes, Erratum::E26_weight_formulae,
                          Erratum::E28_effect_radius, Erratum::E29_mean_of_angles, Erratum::E32_vertical_skin}) {
    const SurfaceEllipse literal = LiteralEllipseMap(keys, {}, taking({e})).on(place, normal);
    const double change =
        (literal.half_major - corrected.half_major).norm() + std::abs(literal.aspect - corrected.aspect);
    EXPECT_GT(change, 1e-3) << "E" << numberOf(e);
    EXPECT_TRUE(literal.half_major.allFinite()) << "E" << numberOf(e);
  }
}

TEST(LiteralEllipseMap, SizesAndAspectsAsMisread) {
  const auto keys = dissertationKeyPoints();
  const KeyPoint& p4 = keys[3];
  const auto at_p4 = [&](Erratum e) {
    return LiteralEllipseMap(keys, {}, taking({e})).at(p4.position_mm.x(), p4.position_mm.y());
  };
  EXPECT_NEAR(at_p4(Erratum::E15_aspect).aspect, 1.357, 1e-9);
  EXPECT_NEAR(at_p4(Erratum::E16_full_axes).half_major_mm, 358.0, 1e-9);
  EXPECT_NEAR(at_p4(Erratum::E28_effect_radius).half_major_mm, 179.0, 1e-9);  // a key stays a key
  EXPECT_NEAR(LiteralEllipseMap({}, {}, taking({Erratum::E16_full_axes})).at(0, 0).half_major_mm, 150.0,
              1e-9);  // the base is a radius
}

TEST(LiteralEllipseMap, DiameterAsRadiusReachesTwiceAsFar) {
  const std::vector<KeyPoint> one{{"K", {0, 0}, {100.0, 0.5, 0.0}, {}}};
  const EllipseMap wide(one, {400.0, 150.0});
  const LiteralEllipseMap literal(one, {200.0, 150.0}, taking({Erratum::E28_effect_radius}));
  EXPECT_EQ(literal.at(300, 0).half_major_mm, wide.at(300, 0).half_major_mm);
  EXPECT_NE(literal.at(300, 0).half_major_mm, 150.0);
}

TEST(LiteralEllipseMap, PrintedProductsLeaveNoEllipseOnTheKeysButTheFirst) {
  const auto keys = dissertationKeyPoints();
  const LiteralEllipseMap map(keys, {}, taking({Erratum::E26_weight_formulae}));
  EXPECT_GT(map.at(keys[0].position_mm.x(), keys[0].position_mm.y()).half_major_mm, 179.0);
  for (std::size_t i = 1; i < keys.size(); ++i) {
    EXPECT_EQ(map.at(keys[i].position_mm.x(), keys[i].position_mm.y()).half_major_mm, 0.0) << keys[i].name;
    EXPECT_LT(map.at(keys[i].position_mm.x() + 1.0, keys[i].position_mm.y()).half_major_mm, 1.0) << keys[i].name;
  }
}

TEST(LiteralEllipseMap, WithoutAValueItIsTheBasicCircle) {
  auto keys = dissertationKeyPoints();
  keys.push_back(keys.front());  // coincident: 0/0
  keys.back().ellipse = {100.0, 0.5, 0.3};
  const Vec2 place = keys.front().position_mm;
  for (const Fidelity& fidelity : {taking({Erratum::E27_weight_zero_by_zero}), literalFidelity()}) {
    const Ellipse e = LiteralEllipseMap(keys, {}, fidelity).at(place.x(), place.y());
    EXPECT_NEAR(e.half_major_mm, 150.0, 1e-9);
    EXPECT_NEAR(e.aspect, 1.0, 1e-12);
    const Ellipse far = LiteralEllipseMap(keys, {}, fidelity).at(1e5, NAN);
    EXPECT_NEAR(far.half_major_mm, 150.0, 1e-9);
  }
  // Corrected, coincident keys are averaged.
  const Ellipse mean = LiteralEllipseMap(keys, {}, taking({Erratum::E29_mean_of_angles})).at(place.x(), place.y());
  EXPECT_NEAR(mean.half_major_mm, 0.5 * (179.0 + 100.0), 1e-9);
}

TEST(LiteralEllipseMap, AnswersWhateverTheNumberOfKeyPoints) {
  Random random(9);
  for (const int n : {0, 1, 2, 7, 10000}) {
    std::vector<KeyPoint> keys;
    for (int i = 0; i < n; ++i) {
      keys.push_back({"k",
                      {random.uniform(-2000, 2000), random.uniform(-2000, 2000)},
                      {random.uniform(20, 180), random.uniform(0.3, 1.0), random.uniform(0, 3.1)},
                      {}});
    }
    const LiteralEllipseMap map(keys, {}, literalFidelity());
    const Ellipse e = map.at(0, 0);
    EXPECT_TRUE(std::isfinite(e.half_major_mm + e.aspect + e.direction_rad)) << n;
    EXPECT_GE(e.half_major_mm, 0.0);
  }
}

TEST(LiteralLift, AlongZTheAxisGetsLonger) {
  for (const auto& c : goldenRows("ellipse_lift", "cases")) {
    const Ellipse flat{c["half_major"], 0.8, c["deg"].get<double>() * kRadPerDeg};
    const SurfaceEllipse lifted = literallyLiftedOntoSurface(flat, test::vec3(c["normal"]));
    EXPECT_EQ(lifted.aspect, 0.8);
    if (c["literal_along_z"].is_null()) {  // vertical: the corrected axis
      EXPECT_NEAR(lifted.half_major.norm(), flat.half_major_mm, 1e-9);
      continue;
    }
    EXPECT_LT((lifted.half_major - test::vec3(c["literal_along_z"])).norm(), 1e-9) << c;
    EXPECT_NEAR(lifted.half_major.norm(), c["literal_length"], 1e-9) << c;
  }
}

TEST(LiteralLift, NoNormalGivesAnEmptyEllipse) {
  EXPECT_TRUE(literallyLiftedOntoSurface({100.0, 0.5, 0.0}, Vec3::Zero()).half_major.isZero());
  EXPECT_TRUE(literallyLiftedOntoSurface({100.0, 0.5, 0.0}, Vec3(0, NAN, 1)).half_major.isZero());
}

TEST(LiteralEllipseMap, RefusesABasicCircleWithoutSize) {
  EXPECT_THROW(LiteralEllipseMap({}, {200.0, 0.0}, Fidelity{}), Error);
}

}  // namespace palpate::maps

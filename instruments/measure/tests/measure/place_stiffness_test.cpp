// Stiffness of places from forces whose law is known.
#include "palpate/measure/place_stiffness.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/error_message.h"

namespace palpate::measure {
namespace {

using tissue::ForceForm;

/// Rows "place,subject,press,x,y,depth,force" of F = k d (d / 8)^(p - 1), noise relative to the force.
std::string powerRows(const std::string& first, double k, double p, double noise = 0.0, unsigned seed = 1,
                      double deepest_mm = 12.0) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0.0, noise);
  std::string rows;
  for (int i = 1; i <= 24; ++i) {
    const double depth = deepest_mm * i / 24;
    rows += fmt::format("{},{:.6g},{:.6g}\n", first, depth,
                        k * depth * std::pow(depth / 8.0, p - 1.0) * (1.0 + normal(engine)));
  }
  return rows;
}
const std::string kHeader = "place,subject,press,x_mm,y_mm,depth_mm,force_n\n";

PlaceFits fitsOf(const std::string& rows, const PlaceFitSettings& settings = {}) {
  return fitPlaces(parsePlaceCurves(kHeader + rows, "f.csv"), settings);
}

TEST(PlaceStiffness, ALinearSpringIsFoundToBeOne) {
  int linear = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const PlaceStiffness place = fitsOf(powerRows("T6,,1,0,41", 0.6, 1.0, 0.03, seed)).places.front();
    linear += place.best().fit.form == ForceForm::linear ? 1 : 0;
    const FormOfPlace& line = place.forms.front();
    EXPECT_NEAR(line.fit.secant.value, 0.6, 0.02);
    EXPECT_GT(line.fit.secant.standard_error, 0.001);
    EXPECT_LT(line.fit.secant.standard_error, 0.01);
    EXPECT_GT(line.r_squared, 0.98);
    EXPECT_LT(line.rms_n, 0.3);
    EXPECT_TRUE(place.warnings.empty());
  }
  EXPECT_GE(linear, 14) << "noise now and then looks like a bend";
}

TEST(PlaceStiffness, APowerLawIsFoundWithItsExponentAndItsSecant) {
  const PlaceStiffness place = fitsOf(powerRows("T6,,1,0,41", 0.4, 1.7, 0.02)).places.front();
  ASSERT_EQ(place.best().fit.form, ForceForm::power);
  EXPECT_NEAR(place.best().fit.numbers.front().value, 1.7, 0.05);
  EXPECT_NEAR(place.secant_n_per_mm.value, 0.4, 0.01) << "at 8 mm";
  EXPECT_GT(place.forms[0].rms_n, 3.0 * place.best().rms_n) << "a straight line misses more";
}

TEST(PlaceStiffness, TheStiffeningFormIsFoundWhereItIsTheTruth) {
  tissue::ForceLaw law{.kind = tissue::ForceLaw::Kind::stiffening};
  law.stiffening_ratio = 6.0;
  law.stiffening_depth_mm = 6.0;
  std::string rows;
  for (int i = 1; i <= 40; ++i) {
    rows += fmt::format("L3,,1,0,0,{},{:.9g}\n", 0.3 * i, tissue::normalForce(law, 0.5, 0.3 * i));
  }
  const PlaceStiffness place = fitsOf(rows).places.front();
  ASSERT_EQ(place.best().fit.form, ForceForm::stiffening);
  EXPECT_NEAR(place.best().fit.numbers[0].value, 6.0, 0.1);
  EXPECT_NEAR(place.secant_n_per_mm.value, 0.5, 0.005);
  EXPECT_EQ(fitsOf(rows, {.form = ForceForm::linear}).places.front().best().fit.form, ForceForm::linear) << "as asked";
}

TEST(PlaceStiffness, PeopleCountAlikeAndTheirSpreadIsTheError) {
  std::string rows;
  for (int press = 0; press < 6; ++press) rows += powerRows(fmt::format("T6,one,{},0,41", press), 0.3, 1.5);
  rows += powerRows("T6,two,0,0,41", 0.5, 1.5);
  const PlaceStiffness place = fitsOf(rows).places.front();
  EXPECT_EQ(place.presses, 7u);
  EXPECT_EQ(place.subjects, 2u);
  EXPECT_NEAR(place.secant_n_per_mm.value, 0.4, 0.005);
  EXPECT_NEAR(place.secant_n_per_mm.sd, 0.1, 0.005) << "0.2 / sqrt 2 / sqrt 2";
}

TEST(PlaceStiffness, WhatIsNoPressIsRefusedWithAReason) {
  const auto refusal = [](const std::string& rows) { return fitsOf(rows).places.front().refusal; };
  EXPECT_EQ(refusal("A,,1,0,0,1,1\nA,,1,0,0,2,2\nA,,1,0,0,2,2.1\nA,,1,0,0,3,3\n"),
            "3 depths below the skin, 4 are needed: press deeper, in more steps");
  EXPECT_NE(refusal(powerRows("A,,1,0,0", -0.4, 1.5)).find("pulls: is the sign turned"), std::string::npos);
  EXPECT_NE(refusal("A,,1,0,0,1,4\nA,,1,0,0,2,3\nA,,1,0,0,3,2\nA,,1,0,0,4,1\n").find("falls with the depth"),
            std::string::npos);
  EXPECT_NE(refusal("A,,1,0,0,1,0\nA,,1,0,0,2,0\nA,,1,0,0,3,0\nA,,1,0,0,4,0\n").find("no force at all"),
            std::string::npos);
  const std::string slipped =
      powerRows("A,,good,0,0", 0.4, 1.5) + "A,,slip,0,0,2,1\nA,,slip,0,0,4,3\nA,,slip,0,0,6,1\nA,,slip,0,0,8,0.5\n";
  EXPECT_NE(refusal(slipped).find("press slip: the force falls"), std::string::npos);
  EXPECT_EQ(refusal(powerRows("A,,1,0,0", 0.4, 1.5)), "");
}

TEST(PlaceStiffness, ARefusedPlaceLeavesTheOthersAlone) {
  const PlaceFits fits = fitsOf(powerRows("good,,1,0,0", 0.4, 1.6) + powerRows("bad,,1,0,0", -0.4, 1.6));
  EXPECT_FALSE(fits.places[0].refused());
  EXPECT_TRUE(fits.places[1].refused());
  EXPECT_EQ(withStiffness(fits).size(), 1u);
  ASSERT_TRUE(fits.shared.has_value());
  EXPECT_NEAR(fits.shared->numbers.front().value, 1.6, 0.01);
}

TEST(PlaceStiffness, SaysWhatIsExtrapolatedAndWhatIsNoSkin) {
  const auto warnings = [](const std::string& rows) {
    std::string all;
    const PlaceFits fits = fitsOf(rows);
    for (const std::string& warning : fits.places.front().warnings) all += warning + "\n";
    return all;
  };
  EXPECT_NE(warnings(powerRows("A,,1,0,0", 0.4, 1.5, 0.0, 1, 5.0)).find("5 mm deep: the stiffness at 8 mm is extra"),
            std::string::npos);
  EXPECT_NE(warnings(powerRows("A,,1,0,0", 400.0, 1.5)).find("is not a skin"), std::string::npos);
  EXPECT_EQ(warnings(powerRows("A,,1,0,0", 0.4, 1.5)), "");
}

TEST(PlaceStiffness, OneShapeForAllPlacesBecomesKeysOfAScene) {
  const PlaceFits power = fitsOf(powerRows("A,,1,0,0", 0.3, 1.6, 0.01) + powerRows("B,,1,9,0", 0.7, 1.6, 0.01, 2));
  EXPECT_EQ(tissueKeys(power).substr(0, 34), "force_law = \"power\"\nexponent = 1.6") << tissueKeys(power);
  EXPECT_EQ(tissueKeys(fitsOf(powerRows("A,,1,0,0", 0.3, 1.0) + powerRows("B,,1,9,0", 0.7, 1.0))),
            "force_law = \"linear\"\n");
}

TEST(PlaceStiffness, KeyPointsGetTheStiffnessOfTheirName) {
  const std::vector<maps::KeyPoint> keys = {{"P1", {5, 6}, {100.0, 0.8, 1.0}, {}}};
  const PlaceFits fits = fitsOf(powerRows("P1,,1,,", 0.3, 1.5) + powerRows("spare,,1,7,8", 0.5, 1.5));
  const std::vector<maps::KeyPoint> both = withStiffness(fits, keys);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NEAR(*both[0].stiffness_n_per_mm, 0.3, 1e-6);
  EXPECT_EQ(both[0].position_mm, Vec2(5, 6));
  EXPECT_EQ(both[0].ellipse.half_major_mm, 100.0);
  EXPECT_EQ(both[1].position_mm, Vec2(7, 8));
  EXPECT_EQ(both[1].ellipse.half_major_mm, 0.0) << "no ellipse was measured there";
  const auto read = maps::parseKeyPoints(stiffnessTable(both), "keys.csv");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_NEAR(read[0].ellipse.aspect, 0.8, 1e-9);
  EXPECT_NEAR(read[0].ellipse.direction_rad, 1.0, 1e-9);
  EXPECT_NEAR(*read[1].stiffness_n_per_mm, 0.5, 1e-6);
  EXPECT_EQ(read[1].ellipse.half_major_mm, 0.0);
  EXPECT_EQ(support::thrownMessage([&] { withStiffness(fits); }), "P1 has no position; give x_mm and y_mm in its rows");
}

TEST(PlaceCurves, NamesTheLineOfWhatItCannotRead) {
  const auto fault = [](const std::string& text) {
    return support::thrownMessage([&] { parsePlaceCurves(text, "f.csv"); });
  };
  EXPECT_EQ(fault("place,depth_mm\n"), "f.csv:1: the header has no column force_n");
  EXPECT_EQ(fault("depth_mm,force_n\n"), "f.csv:1: the header has no column name");
  EXPECT_EQ(fault(kHeader), "f.csv: has no rows; expected a header and one row per depth");
  EXPECT_EQ(fault(kHeader + "A,,1,0,0,1,x\n"), "f.csv:2: force_n is not a number: 'x'");
  EXPECT_EQ(fault(kHeader + "A,,1,0,0,1,1\nA,,1,0,9,2,2\n"),
            "f.csv:3: A is at 0, 0 in an earlier row; expected the same place");
  EXPECT_EQ(fault(kHeader + ",,1,0,0,1,1\n"), "f.csv:2: the place has no name");
}

}  // namespace
}  // namespace palpate::measure

#include "palpate/maps/gaussian_interpolation.h"

#include <gtest/gtest.h>

#include <numbers>

#include "palpate/base/random.h"
#include "palpate/maps/ellipse.h"
#include "support/golden.h"

namespace palpate::maps {

using test::golden;
using test::goldenRows;

double blended(const nlohmann::json& levels, const nlohmann::json& values, double base) {
  GaussianBlend<double> blend(base);
  for (std::size_t i = 0; i < levels.size(); ++i) blend.add(levels[i], values[i].get<double>());
  return blend.result();
}

TEST(GaussianInterpolation, EffectLevelsOfTheTableInTheText) {
  const auto data = golden("gri");
  for (const auto& c : data["series"]) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 key = test::vec2(data["keys"][i]);
      EXPECT_NEAR(effectLevel((test::vec2(c["p"]) - key).norm(), c["e"]), c["a"][i], 1e-12);
    }
    EXPECT_NEAR(blended(c["a"], data["half_major"], data["r_c"]), c["exact_5_16"], 1e-9) << c;
  }
}

TEST(GaussianInterpolation, EqualsTheProductFormula) {
  for (const auto& c : goldenRows("gri", "random")) EXPECT_NEAR(blended(c["a"], c["r"], c["r_c"]), c["exact"], 1e-9);
}

TEST(GaussianInterpolation, HasAnAnswerWhereTheProductFormulaIsZeroByZero) {
  for (const auto& c : goldenRows("gri", "edge"))
    EXPECT_NEAR(blended(c["a"], c["r"], c["r_c"]), c["exact"], 1e-12) << c;
}

TEST(GaussianInterpolation, NothingReachesFartherThanTheEffectRadius) {
  EXPECT_NEAR(effectLevel(200.0, 200.0), 0.0021, 1e-4);
  EXPECT_EQ(effectLevel(200.001, 200.0), 0.0);
  EXPECT_EQ(effectLevel(0.0, 0.0), 1.0);
  EXPECT_EQ(effectLevel(1.0, 0.0), 0.0);
}

// Two keys a hair apart: weights near 1e16, still a mean of the two and never NaN.
TEST(GaussianInterpolation, StaysBetweenAlmostCoincidentKeys) {
  for (double distance = 1e-12; distance < 1.0; distance *= 10) {
    GaussianBlend<double> blend(90.0);
    blend.add(effectLevel(distance, 200.0), 120.0);
    blend.add(effectLevel(0.5 * distance, 200.0), 100.0);
    EXPECT_GE(blend.result(), 100.0 - 1e-9);
    EXPECT_LE(blend.result(), 120.0 + 1e-9);
  }
}

TEST(GaussianInterpolation, TenThousandKeysStayWithinTheirRange) {
  Random random(5);
  GaussianBlend<double> blend(90.0);
  for (int i = 0; i < 10000; ++i) blend.add(random.uniform(), random.uniform(50.0, 180.0));
  EXPECT_GT(blend.result(), 50.0);
  EXPECT_LT(blend.result(), 180.0);
}

TEST(GaussianInterpolation, UndirectedAxesBlendAsTensors) {
  for (const auto& c : goldenRows("direction_interp", "cases")) {
    const auto& expected = c["log_tensor"];
    const double half_major = expected["key_half_major"];
    GaussianBlend<LogTensor> blend(logTensor({expected["r_c"], 1.0}));
    for (std::size_t i = 0; i < c["a"].size(); ++i) {
      const double direction = c["deg"][i].get<double>() * std::numbers::pi / 180.0;
      const double half_minor = half_major / expected["key_ratio"].get<double>();
      blend.add(c["a"][i], logTensor(canonicalEllipse(half_major, half_minor, direction)));
    }
    const Ellipse e = ellipseOf(blend.result());
    EXPECT_NEAR(e.half_major_mm, expected["half_major"], 1e-9) << c;
    EXPECT_NEAR(1.0 / e.aspect, expected["ratio"], 1e-12) << c;
    const double off = e.direction_rad - expected["deg"].get<double>() * std::numbers::pi / 180.0;
    EXPECT_NEAR(std::sin(off), 0.0, 1e-9) << c;
  }
}

}  // namespace palpate::maps

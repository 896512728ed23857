#include "palpate/maps/literal_interpolation.h"

#include <gtest/gtest.h>

#include <vector>

#include "palpate/base/random.h"
#include "palpate/base/vec.h"
#include "palpate/maps/gaussian_interpolation.h"
#include "support/golden.h"

namespace palpate::maps {

using test::golden;
using test::goldenRows;

double blended(LiteralWeights form, const std::vector<double>& levels, const std::vector<double>& values, double base) {
  return literalBlend(form, levels, values, base).value_or(base);
}

TEST(LiteralInterpolation, TableOfTheTextWithBothReadingsOfTheEffectRadius) {
  const auto data = golden("gri");
  const double base = data["r_c"];
  for (const auto& c : data["series"]) {
    EXPECT_NEAR(blended(LiteralWeights::single_effects, c["a"], data["half_major"], base), c["naive_5_7"], 1e-9) << c;
    EXPECT_NEAR(blended(LiteralWeights::products, c["a"], data["half_major"], base), c["exact_5_16"], 1e-9) << c;
  }
}

TEST(LiteralInterpolation, LevelsFromTheTableOf700) {
  const auto data = golden("gri");
  const double base = data["r_c"];
  for (const auto& c : data["series"]) {
    std::vector<double> levels;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 key = test::vec2(data["keys"][i]);
      levels.push_back(tabulatedEffectLevel((test::vec2(c["p"]) - key).norm(), c["e"]));
      EXPECT_NEAR(levels.back(), c["a_table"][i], 1e-12) << c;
    }
    EXPECT_NEAR(blended(LiteralWeights::single_effects, levels, data["half_major"], base), c["naive_table"], 1e-9);
    EXPECT_NEAR(blended(LiteralWeights::products, levels, data["half_major"], base), c["exact_table"], 1e-9);
  }
}

TEST(LiteralInterpolation, TableEntriesAreTheGaussianAtEqualSteps) {
  const auto table = goldenRows("gaussian_table", "table");
  ASSERT_EQ(table.size(), 700u);
  for (std::size_t i = 0; i < 700; ++i) {
    EXPECT_NEAR(tabulatedEffectLevel(static_cast<double>(i) / 699.0 * 400.0, 400.0), table[i], 1e-12) << i;
  }
  EXPECT_EQ(tabulatedEffectLevel(400.1, 400.0), 0.0);
  EXPECT_EQ(tabulatedEffectLevel(0.0, 0.0), 1.0);
  EXPECT_EQ(tabulatedEffectLevel(0.28, 400.0), 1.0);  // nearest entry: within 1/1398 of the radius
}

// "R(E1) = 115 and R(E2) = 112" need the effect radius 200, "112" in the sentence after it is 112.92 cut off.
TEST(LiteralInterpolation, NumbersOfTheText) {
  const auto data = golden("gri");
  const auto& text = data["text_statements"];
  const auto at = [&](const Vec2& place, LiteralWeights form) {
    std::vector<double> levels;
    for (const auto& key : data["keys"]) levels.push_back(effectLevel((place - test::vec2(key)).norm(), 200.0));
    return blended(form, levels, data["half_major"], data["r_c"]);
  };
  EXPECT_EQ(std::round(at(Vec2(0, 150), LiteralWeights::single_effects)), text["R_E1_naive"]);
  EXPECT_EQ(std::round(at(Vec2(0, 60), LiteralWeights::single_effects)), text["R_E2_naive"]);
  for (const auto& key : data["keys"]) {
    EXPECT_NEAR(at(test::vec2(key), LiteralWeights::products), text["exact_at_keys"], 1e-9);
  }
  const auto& example = text["example_levels"];
  const double stated = blended(LiteralWeights::single_effects, example["a"], example["r"], 90.0);
  EXPECT_NEAR(stated, example["naive_formula_value"], 1e-9);
  EXPECT_EQ(std::floor(stated), example["text"]);
}

TEST(LiteralInterpolation, RandomLevels) {
  for (const auto& c : goldenRows("gri", "random")) {
    EXPECT_NEAR(blended(LiteralWeights::single_effects, c["a"], c["r"], c["r_c"]), c["naive"], 1e-9);
    EXPECT_NEAR(blended(LiteralWeights::products, c["a"], c["r"], c["r_c"]), c["exact"], 1e-9);
  }
}

TEST(LiteralInterpolation, ProductsEqualTheWeightsOfTheEngine) {
  Random random(3);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> levels;
    std::vector<double> values;
    GaussianBlend<double> blend(90.0);
    for (int i = 0; i < 9; ++i) {
      levels.push_back(random.uniform());
      values.push_back(random.uniform(50, 180));
      blend.add(levels.back(), values.back());
    }
    EXPECT_NEAR(blended(LiteralWeights::products, levels, values, 90.0), blend.result(), 1e-9);
  }
}

// Two keys, a = (0.6, 0.5): the printed product leaves out j = 1 for both, so key 2 is weighted with its own (1 - a_2).
TEST(LiteralInterpolation, PrintedProductsByHand) {
  const double v1 = 90 * 0.4 + 120 * 0.6;
  const double v2 = 90 * 0.5 + 100 * 0.5;
  const double denominator = 0.6 * 0.5 + 0.5 * 0.4;
  const double expected = v1 * (0.6 * 0.5) / denominator + v2 * (0.5 * 0.5) / denominator;
  EXPECT_NEAR(blended(LiteralWeights::printed_products, {0.6, 0.5}, {120, 100}, 90), expected, 1e-12);
}

TEST(LiteralInterpolation, PrintedProductsMissTheKeys) {
  EXPECT_EQ(blended(LiteralWeights::printed_products, {0.3, 1.0, 0.2}, {120, 110, 100}, 90), 0.0);
  EXPECT_GT(blended(LiteralWeights::printed_products, {1.0, 0.3, 0.2}, {120, 110, 100}, 90), 120.0);
  EXPECT_NEAR(blended(LiteralWeights::printed_products, {0.4}, {120}, 90), 102.0, 1e-12);  // one key: right
}

TEST(LiteralInterpolation, HasNoValueWhereTheFormulaIsZeroByZero) {
  for (const LiteralWeights form : {LiteralWeights::products, LiteralWeights::printed_products}) {
    EXPECT_FALSE(literalBlend(form, std::vector<double>{1, 1, 0.3}, std::vector<double>{120, 100, 80}, 90));
  }
  for (const LiteralWeights form :
       {LiteralWeights::single_effects, LiteralWeights::products, LiteralWeights::printed_products}) {
    EXPECT_FALSE(literalBlend(form, std::vector<double>{0, 0}, std::vector<double>{120, 100}, 90));
    EXPECT_FALSE(literalBlend(form, std::vector<double>{}, std::vector<double>{}, 90));
  }
  EXPECT_NEAR(
      *literalBlend(LiteralWeights::single_effects, std::vector<double>{1, 1}, std::vector<double>{120, 100}, 90),
      110.0, 1e-12);
  // The product of 10,000 factors is smaller than any double.
  EXPECT_FALSE(
      literalBlend(LiteralWeights::products, std::vector<double>(10000, 0.5), std::vector<double>(10000, 7.0), 90));
}

}  // namespace palpate::maps

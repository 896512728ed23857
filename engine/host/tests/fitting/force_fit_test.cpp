// Fits are judged by curves whose law is known, made here with noise of known size.
#include "palpate/tissue/fitting/force_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "palpate/tissue/fitting/force_rows.h"
#include "palpate/tissue/user_profile.h"
#include "support/error_message.h"

namespace palpate::tissue {
namespace {

/// A power curve of secant k at 8 mm with noise, a share of each force and a share of the largest.
struct PowerCurve {
  double k = 0.4;
  double p = 1.6;
  int rows = 40;
  double deepest_mm = 10.0;
  double relative = 0.05;
  double absolute = 0.0;
  double offset_mm = 0.0;

  ForceCurve with(unsigned seed) const {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal;
    ForceCurve curve;
    const double most = 8.0 * k * std::pow(deepest_mm / 8.0, p);
    for (int i = 1; i <= rows; ++i) {
      const double depth = deepest_mm * i / rows;
      const double felt = std::max(0.0, depth - offset_mm);
      const double force = 8.0 * k * std::pow(felt / 8.0, p);
      curve.depth_mm.push_back(depth);
      curve.force_n.push_back(force * (1.0 + relative * normal(engine)) + absolute * most * normal(engine));
    }
    return curve;
  }
};

/// Like tissue-wide recordings are judged, written down once more.
double rmsOf(const ForceFit& fit, const ForceCurve& curve) {
  const double most = *std::ranges::max_element(curve.force_n);
  double squares = 0.0;
  for (std::size_t i = 0; i < curve.depth_mm.size(); ++i) {
    const double rest = (forceOf(fit, curve.depth_mm[i]) - curve.force_n[i]) / std::max(curve.force_n[i], 0.3 * most);
    squares += rest * rest;
  }
  return std::sqrt(squares / static_cast<double>(curve.depth_mm.size()));
}

const ForceFit& findFit(const std::vector<ForceFit>& fits, ForceForm form) {
  return *std::ranges::find(fits, form, &ForceFit::form);
}

TEST(ForceFit, FindsTheExponentUnderNoiseOfFivePercent) {
  for (const double p : {1.0, 1.3, 1.6, 2.2, 3.0}) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const ForceFit fit = fitForce(PowerCurve{.p = p}.with(seed), ForceForm::power, {});
      EXPECT_NEAR(fit.numbers.at(0).value, p, 0.05) << "seed " << seed;
      EXPECT_NEAR(fit.secant.value, 0.4, 0.02) << "seed " << seed;
    }
  }
}

TEST(ForceFit, FindsItOnFewRowsNearly) {
  int within = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const ForceFit fit = fitForce(PowerCurve{.rows = 15}.with(seed), ForceForm::power, {});
    within += std::abs(fit.numbers.at(0).value - 1.6) < 0.05 ? 1 : 0;
  }
  EXPECT_GE(within, 46) << "the best that can be had is 97 of 100";
}

TEST(ForceFit, FindsItWhereTheNoiseDoesNotGrowWithTheForce) {
  const PowerCurve curve{.rows = 400, .relative = 0.0, .absolute = 0.02};
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const ForceFit fit = fitForce(curve.with(seed), ForceForm::power, {});
    EXPECT_NEAR(fit.numbers.at(0).value, 1.6, 0.04) << "seed " << seed;
    EXPECT_GE(fit.noise_floor, 0.5) << "distinguished from noise that grows with the force";
  }
}

TEST(ForceFit, SaysHowSureItIs) {
  int within = 0;
  double error = 0.0;
  std::vector<double> found;
  constexpr int kSeeds = 200;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const ForceFit fit = fitForce(PowerCurve{}.with(seed), ForceForm::power, {});
    const FittedNumber& exponent = fit.numbers.at(0);
    within += std::abs(exponent.value - 1.6) < 2.0 * exponent.standard_error ? 1 : 0;
    error += exponent.standard_error / kSeeds;
    found.push_back(exponent.value);
  }
  EXPECT_GE(within, 178) << "about 95 of 100 lie within two standard errors";
  double spread = 0.0;
  for (const double value : found) spread += (value - 1.6) * (value - 1.6) / kSeeds;
  EXPECT_NEAR(std::sqrt(spread) / error, 1.0, 0.25);
}

TEST(ForceFit, IsExactWithoutNoise) {
  const ForceCurve curve = PowerCurve{.k = 0.7, .p = 2.3, .relative = 0.0}.with(1);
  const ForceFit fit = fitForce(curve, ForceForm::power, {});
  EXPECT_NEAR(fit.numbers.at(0).value, 2.3, 1e-6);
  EXPECT_NEAR(fit.secant.value, 0.7, 1e-6);
  EXPECT_LT(fit.rms, 1e-6);
  EXPECT_LT(fit.unseen_rms, 1e-6);
  EXPECT_EQ(fit.rows, 40u);
  EXPECT_EQ(fit.deepest_mm, 10.0);
}

TEST(ForceFit, FindsTheNumbersOfEveryForm) {
  ForceLaw law{.kind = ForceLaw::Kind::stiffening};
  law.stiffening_ratio = 6.0;
  law.stiffening_depth_mm = 9.0;
  ForceCurve stiffening, cubic, straight;
  for (int i = 1; i <= 30; ++i) {
    const double depth = 0.4 * i;
    for (ForceCurve* curve : {&stiffening, &cubic, &straight}) curve->depth_mm.push_back(depth);
    stiffening.force_n.push_back(normalForce(law, 0.5, depth));
    cubic.force_n.push_back(0.2 * depth + 0.004 * depth * depth * depth);
    straight.force_n.push_back(0.3 * depth);
  }
  const ForceFit stiff = fitForce(stiffening, ForceForm::stiffening, {});
  EXPECT_NEAR(stiff.numbers.at(0).value, 6.0, 0.01);
  EXPECT_NEAR(stiff.numbers.at(1).value, 9.0, 0.01);
  EXPECT_NEAR(stiff.secant.value, normalForce(law, 0.5, 8.0) / 8.0, 1e-4);
  const ForceFit third = fitForce(cubic, ForceForm::cubic, {});
  EXPECT_NEAR(third.secant.value, 0.2 + 0.004 * 64.0, 1e-6);
  EXPECT_NEAR(third.numbers.at(0).value, 0.004 * 64.0 / (0.2 + 0.004 * 64.0), 1e-6);
  const ForceFit hooke = fitForce(straight, ForceForm::linear, {});
  EXPECT_NEAR(hooke.secant.value, 0.3, 1e-9);
  EXPECT_TRUE(hooke.numbers.empty());
}

TEST(ForceFit, FindsWhereTheSkinIsMet) {
  const ForceCurve curve = PowerCurve{.rows = 100, .relative = 0.01, .offset_mm = 0.4}.with(3);
  const ForceFit blind = fitForce(curve, ForceForm::power, {});
  EXPECT_GT(blind.numbers.at(0).value, 1.65) << "a late contact looks like a steeper law";
  EXPECT_EQ(blind.offset.value, 0.0);
  const ForceFit fit = fitForce(curve, ForceForm::power, {.free_offset = true});
  EXPECT_NEAR(fit.offset.value, 0.4, 0.05);
  EXPECT_NEAR(fit.numbers.at(0).value, 1.6, 0.03);
  EXPECT_GT(fit.offset.standard_error, 0.0);
  EXPECT_LT(fit.offset.standard_error, 0.05);
  EXPECT_NEAR(fit.deepest_mm, 9.6, 0.05);
  EXPECT_EQ(forceOf(fit, 0.3), 0.0);
}

TEST(ForceFit, SaysThatANumberIsAtTheEndOfItsRange) {
  const ForceCurve late = PowerCurve{.rows = 100, .relative = 0.001, .offset_mm = 2.0}.with(3);
  const ForceFit fit = fitForce(late, ForceForm::power, {.free_offset = true});
  EXPECT_TRUE(fit.offset.at_end);
  EXPECT_EQ(fit.offset.value, 0.6);
  EXPECT_EQ(fit.offset.standard_error, 0.0);
}

TEST(ForceFit, JudgesAsRecordingsAreJudged) {
  const ForceCurve curve = PowerCurve{.relative = 0.1}.with(4);
  for (const ForceFit& fit : fitForces(curve, {})) EXPECT_NEAR(fit.rms, rmsOf(fit, curve), 1e-9) << nameOf(fit.form);
}

TEST(ForceFit, ChoosesTheFormThatMadeTheCurve) {
  EXPECT_EQ(bestOf(fitForces(PowerCurve{.p = 1.0}.with(1), {})).form, ForceForm::linear);
  EXPECT_EQ(bestOf(fitForces(PowerCurve{.p = 1.8}.with(1), {})).form, ForceForm::power);
  ForceCurve steps = PowerCurve{.relative = 0.0}.with(1);
  for (double& force : steps.force_n) force = 0.5 + 2.0 * std::floor(force);
  EXPECT_EQ(bestOf(fitForces(steps, {})).form, ForceForm::measured) << "no form has steps";
}

TEST(ForceFit, UnseenRowsSeeThroughAFormThatFollowsTheNoise) {
  const std::vector<ForceFit> fits = fitForces(PowerCurve{.rows = 24, .relative = 0.15}.with(9), {});
  const ForceFit& measured = findFit(fits, ForceForm::measured);
  EXPECT_LT(measured.rms, findFit(fits, ForceForm::power).rms) << "it goes through the rows";
  EXPECT_GT(measured.unseen_rms, findFit(fits, ForceForm::power).unseen_rms);
}

TEST(ForceFit, IsATableThatASceneReads) {
  const ForceCurve curve = PowerCurve{.relative = 0.0, .offset_mm = 0.3}.with(1);
  for (const ForceFit& fit : fitForces(curve, {.free_offset = true})) {
    const ForceTable table = parseForceTable(forceTableText(tableOf(fit)), "t.csv");
    const double offset = fit.offset.value;
    for (const double depth : {0.5, 2.0, 5.0, 8.0, 9.5}) {
      EXPECT_NEAR(forceIn(table, depth), forceOf(fit, depth + offset), 0.012) << nameOf(fit.form) << " " << depth;
    }
    EXPECT_NEAR(table.depth_mm[table.rows - 1], fit.deepest_mm, fit.form == ForceForm::measured ? 0.2 : 1e-6);
  }
}

TEST(ForceFit, OfSeveralPlacesHasOneShape) {
  std::vector<ForceCurve> curves;
  for (unsigned i = 0; i < 7; ++i) {
    curves.push_back(PowerCurve{.k = 0.2 + 0.1 * i, .p = 1.7, .rows = 20 + 20 * static_cast<int>(i)}.with(i + 1));
  }
  const ForceFit shared = fitSharedForce(curves, ForceForm::power, {});
  EXPECT_NEAR(shared.numbers.at(0).value, 1.7, 0.03);
  EXPECT_NEAR(shared.secant.value, 0.5, 0.02) << "the middle of seven";
  EXPECT_NEAR(shared.rms, 0.05, 0.02);
  EXPECT_GE(shared.unseen_rms, 0.99 * shared.rms);
  const ForceFit measured = fitSharedForce(curves, ForceForm::measured, {});
  EXPECT_NEAR(forceOf(measured, 8.0), 8.0 * 0.5, 0.3);
}

TEST(ForceFit, PlacesOfDifferentShapeDoNotForetellEachOther) {
  std::vector<ForceCurve> curves;
  for (const double p : {1.0, 1.0, 1.0, 1.0, 3.0}) curves.push_back(PowerCurve{.p = p, .relative = 0.0}.with(1));
  const ForceFit shared = fitSharedForce(curves, ForceForm::power, {});
  EXPECT_GT(shared.unseen_rms, 1.04 * shared.rms);
  EXPECT_GT(shared.rms, 0.05);
}

TEST(ForceFit, RefusesACurveThatTellsNothing) {
  const auto fault = [](const ForceCurve& curve) {
    return support::thrownMessage([&] { fitForce(curve, ForceForm::power, {}); });
  };
  EXPECT_EQ(fault({"T6", {-1.0, 0.0, 1.0, 2.0, 2.0, 3.0}, {0, 0, 1, 2, 2, 3}}),
            "curve 'T6' has 3 depths below the skin; at least 4 are required");
  EXPECT_EQ(fault({"", {1.0, 2.0, 3.0, 4.0}, {0.0, 0.0, -0.1, 0.0}}), "the curve has no force above 0 N");
}

TEST(SmoothedForce, NeverFallsAndKeepsTheMean) {
  ForceCurve curve{"", {1.0, 2.0, 3.0, 4.0, 5.0}, {1.0, 3.0, 2.0, 4.0, 9.0}};
  const ForceRows rows = rowsOf(curve);
  const ForceTable table = smoothedTable(rows, Eigen::ArrayXd::Ones(5));
  ASSERT_EQ(table.rows, 4u) << "two rows that fall are one";
  EXPECT_DOUBLE_EQ(table.depth_mm[1], 2.5);
  EXPECT_DOUBLE_EQ(table.effective_mm[1], 2.5);
  EXPECT_DOUBLE_EQ(forceIn(table, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(forceIn(table, 4.5), 6.5);
  EXPECT_DOUBLE_EQ(forceIn(table, 6.0), 14.0) << "with its last slope";
}

TEST(SmoothedForce, AveragesCloseRows) {
  ForceCurve curve;
  for (int i = 0; i < 1000; ++i) {
    const int pair = i / 2;
    curve.depth_mm.push_back(0.01 * (pair + 1));
    curve.force_n.push_back(curve.depth_mm.back() + (i % 2 == 0 ? 0.5 : -0.5));
  }
  const ForceTable table = smoothedTable(rowsOf(curve), Eigen::ArrayXd::Ones(1000), 20);
  ASSERT_EQ(table.rows, 20u);
  for (std::uint32_t i = 0; i < table.rows; ++i) EXPECT_NEAR(table.effective_mm[i], table.depth_mm[i], 1e-9);
}

}  // namespace
}  // namespace palpate::tissue

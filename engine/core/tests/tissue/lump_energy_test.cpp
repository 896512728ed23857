// What a lump adds to a press: an energy whose slopes are the forces, smooth everywhere, from any field.
#include "palpate/tissue/lump_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "palpate/tissue/force_law.h"
#include "palpate/tissue/layered_library.h"
#include "palpate/tissue/layered_tissue.h"
#include "palpate/tissue/library_fields.h"
#include "palpate/tissue/lump_saturation.h"
#include "support/counted.h"
#include "support/error_message.h"

namespace palpate::tissue {
namespace {

LumpShape ball(double diameter_mm, double depth_mm, double ratio) {
  const double radius = 0.5 * diameter_mm;
  return {.half_axes_mm = {radius, radius, radius}, .depth_mm = depth_mm, .stiffness_ratio = ratio};
}

LumpEnergy energyOf(const LumpShape& lump, double thickness_mm = 40.0, std::vector<ForceCorrection> correction = {}) {
  return LumpEnergy(lump, placeStack(thickness_mm, 8.0), libraryFieldsAt(thickness_mm, 8.0), correction);
}

std::string errorMessage(const LumpShape& lump, const LayerStack& stack = placeStack(40.0, 8.0)) {
  return support::thrownMessage([&] { check(lump, stack); });
}

TEST(LumpEnergy, ForcesAreTheSlopesOfTheEnergy) {
  const LumpEnergy energy = energyOf(ball(10.0, 3.0, 20.0));
  constexpr double kStep = 1e-4;
  for (const double rho : {0.0, 0.3, 2.71, 5.0, 11.99, 12.01, 20.0, 34.9}) {
    for (const double depth : {0.2, 1.0, 3.3, 7.9, 11.9, 12.5, 16.0}) {
      const LumpAnswer here = energy.at(rho, depth);
      const double by_rho =
          (energy.at(rho + kStep, depth).energy_n_mm - energy.at(rho - kStep, depth).energy_n_mm) / (2.0 * kStep);
      const double by_depth =
          (energy.at(rho, depth + kStep).energy_n_mm - energy.at(rho, depth - kStep).energy_n_mm) / (2.0 * kStep);
      EXPECT_NEAR(here.d_rho, by_rho, 1e-6) << rho << " " << depth;
      EXPECT_NEAR(here.d_depth, by_depth, 1e-6) << rho << " " << depth;
      const double bend = (energy.at(rho + kStep, depth).d_rho - energy.at(rho - kStep, depth).d_rho) / (2.0 * kStep);
      if (std::abs(std::remainder(rho, 0.6)) > kStep) {
        EXPECT_NEAR(here.d_rho_rho, bend, 1e-5) << rho << " " << depth;
      }
    }
  }
}

TEST(LumpEnergy, SlopesAloneAreTheSameBits) {
  const LumpEnergy energy = energyOf(ball(10.0, 3.0, 20.0)).scaled(0.7);
  for (double rho = -40.0; rho < 40.0; rho += 0.37) {
    for (double depth = -0.5; depth < 20.0; depth += 0.31) {
      const LumpAnswer answer = energy.at(rho, depth);
      EXPECT_EQ(energy.forceAt(rho, depth), answer.d_depth) << rho << " " << depth;
      EXPECT_EQ(energy.slopesAt(rho, depth).d_depth, answer.d_depth) << rho << " " << depth;
      EXPECT_EQ(energy.slopesAt(rho, depth).d_rho, answer.d_rho) << rho << " " << depth;
    }
  }
}

TEST(LumpEnergy, PushesTheFingerOutOfTheBodyAndOffTheLump) {
  const LumpEnergy energy = energyOf(ball(10.0, 3.0, 20.0));
  EXPECT_NEAR(energy.at(0.0, 5.0).d_depth, 0.547, 0.03);  // finite elements: 41 % of 1.34 N, in a stack like this one
  EXPECT_LT(energy.at(5.0, 5.0).d_rho, -0.05);
  EXPECT_EQ(energy.at(-5.0, 5.0).d_rho, -energy.at(5.0, 5.0).d_rho);
  EXPECT_EQ(energy.at(-5.0, 5.0).d_depth, energy.at(5.0, 5.0).d_depth);
  EXPECT_EQ(energy.at(0.0, 5.0).d_rho, 0.0);
}

TEST(LumpEnergy, EndsSmoothlyWhereItIsNoLongerFelt) {
  const LumpEnergy energy = energyOf(ball(10.0, 3.0, 20.0));
  EXPECT_EQ(energy.reachMm(), 35.0);
  const LumpAnswer last = energy.at(35.0 - 1e-6, 8.0);
  EXPECT_NEAR(last.energy_n_mm, 0.0, 1e-9);
  EXPECT_NEAR(last.d_rho, 0.0, 1e-9);
  for (const auto& [rho, depth] :
       {std::pair{35.0, 8.0}, std::pair{80.0, 8.0}, std::pair{0.0, 0.0}, std::pair{0.0, -3.0}}) {
    const LumpAnswer nothing = energy.at(rho, depth);
    EXPECT_EQ(nothing.energy_n_mm, 0.0);
    EXPECT_EQ(nothing.d_rho, 0.0);
    EXPECT_EQ(nothing.d_depth, 0.0);
  }
  EXPECT_EQ(energy.at(std::nan(""), 3.0).d_depth, 0.0);
  EXPECT_EQ(energy.at(1.0, std::nan("")).d_depth, 0.0);
}

TEST(LumpEnergy, OfTheLightestTouchStaysAShareOfWhatTheTissuePushesBack) {
  const LayeredTissue tissue(libraryNodes(8.0));
  const ForceLaw law{.kind = ForceLaw::Kind::layered, .layers = tissue.forceRows()};
  const auto share = [&](const LumpEnergy& energy, double depth) {
    const double plain = normalForce(law, tissue.secantAt(40.0, 8.0), depth, {.tissue_mm = 40.0, .finger_mm = 8.0});
    return energy.forceAt(0.0, depth) / plain;
  };
  const LumpEnergy hard = energyOf(ball(10.0, 3.0, 20.0)), soft = energyOf(ball(16.0, 2.5, 0.2));
  for (const double depth : {1e-6, 1e-4, 1e-2, 0.1, 0.3, 0.5}) {
    EXPECT_GT(share(hard, depth), 0.0) << depth;
    EXPECT_LT(share(hard, depth), 2.0 * share(hard, 0.55)) << depth;
    EXPECT_LT(share(soft, depth), 0.0) << depth;
    EXPECT_GT(share(soft, depth), 2.0 * share(soft, 0.55)) << depth;
    EXPECT_GT(share(soft, depth), -0.5) << "a soft lump would pull the finger in, " << depth;
  }
}

TEST(LumpEnergy, GoesStraightOnBeyondTheLastSolvedDepth) {
  const LumpEnergy energy = energyOf(ball(10.0, 8.0, 5.0));
  const double last = energy.deepestMm();
  EXPECT_EQ(last, 12.0);
  EXPECT_NEAR(energy.at(3.0, last - 1e-7).d_depth, energy.at(3.0, last + 1e-7).d_depth, 1e-7);
  EXPECT_NEAR(energy.at(3.0, last - 1e-7).d_rho, energy.at(3.0, last + 1e-7).d_rho, 1e-7);
  const double first = energy.at(3.0, last + 1.0).d_depth - energy.at(3.0, last).d_depth;
  const double second = energy.at(3.0, last + 2.0).d_depth - energy.at(3.0, last + 1.0).d_depth;
  EXPECT_NEAR(first, second, 1e-12);
}

TEST(LumpEnergy, OfASofterLumpTakesForceAway) {
  const LumpEnergy cyst = energyOf(ball(10.0, 8.0, 0.3));
  EXPECT_LT(cyst.at(0.0, 5.0).d_depth, -0.02);
  EXPECT_GT(cyst.at(5.0, 5.0).d_rho, 0.0);
}

TEST(LumpEnergy, ShallowLumpsStandOutUnderALightPressAndDeepOnesUnderADeepOne) {
  const LumpEnergy shallow = energyOf(ball(6.0, 3.0, 20.0));
  const LumpEnergy deep = energyOf(ball(6.0, 15.0, 20.0));
  const auto growth = [](const LumpEnergy& energy) {
    return energy.at(0.0, 8.0).d_depth / energy.at(0.0, 2.0).d_depth;
  };
  EXPECT_LT(growth(shallow), 0.6 * growth(deep));
}

TEST(LumpEnergy, IsScaledAsAWhole) {
  const LumpEnergy energy = energyOf(ball(10.0, 3.0, 20.0));
  const LumpEnergy half = energy.scaled(0.5);
  EXPECT_EQ(half.at(4.0, 6.0).energy_n_mm, 0.5 * energy.at(4.0, 6.0).energy_n_mm);
  EXPECT_EQ(half.at(4.0, 6.0).d_rho, 0.5 * energy.at(4.0, 6.0).d_rho);
  EXPECT_EQ(half.steepest().depth, 0.5 * energy.steepest().depth);
}

TEST(LumpEnergy, KnowsItsSteepestSlopes) {
  const LumpEnergy energy = energyOf(ball(10.0, 3.0, 20.0));
  const LumpSteepness steepest = energy.steepest();
  EXPECT_GT(steepest.depth, 0.1);
  EXPECT_GE(steepest.rho, steepest.snapping);
  for (double rho = 0.0; rho < 35.0; rho += 0.37) {
    for (double depth = 0.1; depth < 12.0; depth += 0.31) {
      EXPECT_LE(std::abs(energy.at(rho, depth).d_rho_rho), 1.02 * steepest.rho);
      EXPECT_LE(std::abs(energy.at(rho, depth + 0.01).d_depth - energy.at(rho, depth).d_depth),
                0.0102 * steepest.depth);
    }
  }
}

TEST(LumpEnergy, TakesTheForceOfItsOwnSolveWhereThatIsGiven) {
  const LumpShape lump = ball(10.0, 3.0, 20.0);
  const LumpEnergy table = energyOf(lump);
  const LumpEnergy solved = energyOf(lump, 40.0, {{1.0, 1.2}, {5.0, 1.0}, {9.0, 0.9}});
  for (const double depth : {24.0 / 23.0, 84.0 / 23.0, 180.0 / 23.0}) {  // at knots, where nothing is interpolated
    const double factor = depth < 5.0 ? 1.2 - 0.05 * (depth - 1.0) : 1.0 - 0.025 * (depth - 5.0);
    EXPECT_NEAR(solved.at(0.0, depth).d_depth, factor * table.at(0.0, depth).d_depth, 1e-9);
  }
  constexpr double kStep = 1e-4;
  const double by_rho =
      (solved.at(4.0 + kStep, 6.1).energy_n_mm - solved.at(4.0 - kStep, 6.1).energy_n_mm) / (2.0 * kStep);
  EXPECT_NEAR(solved.at(4.0, 6.1).d_rho, by_rho, 1e-6) << "still a gradient";
}

TEST(LumpEnergy, BlendsNeighbouringStacks) {
  const LumpShape lump = ball(8.0, 6.0, 5.0);
  const double thin = energyOf(lump, 30.0).at(0.0, 6.0).d_depth;
  const double middle = energyOf(lump, 34.0).at(0.0, 6.0).d_depth;
  const double thick = energyOf(lump, 40.0).at(0.0, 6.0).d_depth;
  EXPECT_LT(std::min(thin, thick) - 0.002, middle);
  EXPECT_GT(std::max(thin, thick) + 0.002, middle);
  double shares = 0.0;
  for (const WeightedField& one : libraryFieldsAt(34.0, 5.0)) {
    EXPECT_EQ(support::thrownMessage([&] { check(*one.field, *one.stack); }), "no error");
    shares += one.share;
  }
  EXPECT_NEAR(shares, 1.0, 1e-12);
  EXPECT_EQ(libraryFieldsAt(34.0, 5.0).size(), 4u);
}

TEST(LumpEnergy, AsksForNoMemoryInTheTick) {
  const LumpEnergy energy = energyOf(ball(10.0, 3.0, 20.0));
  double sum = 0.0;
  support::expectNoAllocation([&] {
    for (int i = 0; i < 100; ++i) sum += energy.at(0.3 * i, 0.15 * i).energy_n_mm;
  });
  EXPECT_GT(sum, 0.0);
}

TEST(LumpSaturation, FarFromEverythingIsEshelbys) {
  const LayerStack deep{{{"skin", 2.0, 100.0}, {"fat", 400.0, 10.0}}, 0.48};
  const Saturation far(ball(2.0, 150.0, 5.0), deep);
  EXPECT_NEAR(far.sigma(1), 1.0, 0.01);
  EXPECT_LT(Saturation(ball(10.0, 3.0, 5.0), deep).sigma(1), 0.6) << "near the skin a lump cannot relax";
  const Hardening hard = far.at(1, 0.5, 0.9);
  const double shear = 10.0 / (2.0 * 1.48);
  EXPECT_NEAR(hard.shear_kpa, shear * 4.0 / (1.0 + 0.4103 * 0.9 * 4.0), 1e-3);
  EXPECT_EQ(Saturation({.stiffness_ratio = 5.0, .edge = 0.5}, deep).at(1, 1.0, 1.0).shear_kpa, 0.0)
      << "soft to its rim";
}

TEST(LumpSaturation, OverFirmGroundGrowsWithThePressAndOverSoftGroundDoesNot) {
  const LumpShape lump{.half_axes_mm = {5.0, 5.0, 5.0}, .depth_mm = 6.0, .young_kpa = 150.0};
  const LayerStack firm{{{"skin", 2.0, 100.0}, {"fat", 14.0, 4.0}, {"muscle", 20.0, 30.0}}, 0.48};
  const LayerStack soft{{{"skin", 2.0, 100.0}, {"fat", 34.0, 4.0}}, 0.48};
  EXPECT_LT(Saturation(lump, firm).sigma(1, 0.5), 0.8 * Saturation(lump, firm).sigma(1));
  EXPECT_EQ(Saturation(lump, soft).sigma(1, 0.5), Saturation(lump, soft).sigma(1));
  EXPECT_LT(Saturation(lump, firm).sigma(1), 0.9 * Saturation(lump, soft).sigma(1)) << "the ground itself holds it";
}

TEST(LumpSaturation, UnderAStifferSkinALumpRelaxesLess) {
  const LumpShape lump{.half_axes_mm = {5.0, 5.0, 5.0}, .depth_mm = 4.0, .young_kpa = 150.0};
  const auto under = [&](double skin_kpa) {
    return Saturation(lump, LayerStack{{{"skin", 2.0, skin_kpa}, {"fat", 34.0, 4.0}}, 0.48}).sigma(1);
  };
  EXPECT_LT(under(150.0), under(20.0));
  EXPECT_GT(under(4.1), 0.95);
}

TEST(LumpSaturation, OfASofterLumpStaysSafe) {
  const LayerStack stack{{{"skin", 2.0, 100.0}, {"fat", 10.0, 4.0}, {"muscle", 20.0, 30.0}}, 0.48};
  const LumpShape cyst{.half_axes_mm = {3.0, 3.0, 3.0}, .depth_mm = 12.1, .stiffness_ratio = 0.2};
  EXPECT_EQ(Saturation(cyst, stack).sigma(2), 1.0);
  EXPECT_GT(Saturation(LumpShape{.half_axes_mm = {3.0, 3.0, 3.0}, .depth_mm = 12.1}, stack).sigma(2), 1.0)
      << "a hard one relaxes more under a softer layer";
}

TEST(LumpSaturation, ReadsTheStretchOfTissueFromItsEnergy) {
  for (const double stretch : {1.0, 0.9, 0.5, 0.1}) {
    EXPECT_NEAR(stretchAlongAxis(0.5 * (stretch * stretch + 2.0 / stretch - 3.0)), stretch, 1e-6);
  }
}

TEST(LumpEnergy, OfALumpWhoseMiddlePassesABorderDoesNotJump) {
  const auto force_at = [](double depth_mm) {
    return energyOf({.half_axes_mm = {4.0, 4.0, 4.0}, .depth_mm = depth_mm, .young_kpa = 300.0}).forceAt(0.0, 6.0);
  };
  const LayerStack stack = placeStack(40.0, 8.0);
  const double border = stack.layers[0].thickness_mm + stack.layers[1].thickness_mm;
  EXPECT_NEAR(force_at(border - 4.001) / force_at(border - 3.999), 1.0, 0.002);
}

TEST(LumpShape, IsRefusedWhereItCannotBe) {
  EXPECT_EQ(errorMessage(ball(10.0, 8.0, 5.0)), "no error");
  EXPECT_EQ(
      errorMessage(ball(10.0, 2.0, 5.0)),
      "lump: depth_mm = 2 is out of range: the top must be at least 0.5 mm below the skin layer, here 2.5 to 29.0 mm");
  EXPECT_EQ(errorMessage(ball(10.0, 30.0, 5.0)),
            "lump: reaches the bone: its bottom is at 40.0 mm, the bone at 40.0 mm; make it smaller or shallower");
  EXPECT_EQ(errorMessage(ball(10.0, 8.0, 0.1)), "lump: stiffness_ratio = 0.1 is out of range: 0.2 to 1,000");
  LumpShape lump = ball(10.0, 8.0, 5.0);
  lump.young_kpa = 1.0;
  EXPECT_EQ(errorMessage(lump),
            "lump: young_kpa = 1 is out of range: expected at least 0.2 times the layer's, here 5.4 kPa");
  lump = ball(10.0, 8.0, 5.0);
  lump.half_axes_mm[1] = 4.0;
  EXPECT_NE(errorMessage(lump).find("first two half axes must be equal"), std::string::npos);
  lump.half_axes_mm[1] = std::nan("");
  EXPECT_NE(errorMessage(lump).find("half axis = nan is out of range"), std::string::npos);
  EXPECT_NE(errorMessage(ball(10.0, std::nan(""), 5.0)).find("depth_mm = nan"), std::string::npos);
  EXPECT_NE(errorMessage(ball(10.0, 8.0, 5.0), {{{"muscle", 40.0, 27.0}}, 0.48}).find("requires a skin layer"),
            std::string::npos);
  EXPECT_EQ(support::thrownMessage([] { LumpEnergy(ball(10.0, 8.0, 5.0), placeStack(40.0, 8.0), {}); }),
            "lump: the press field is missing");
}

}  // namespace
}  // namespace palpate::tissue

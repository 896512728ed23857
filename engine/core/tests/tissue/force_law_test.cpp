#include "palpate/tissue/force_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/tissue/profile.h"
#include "support/error_message.h"

namespace palpate::tissue {
namespace {

using Kind = ForceLaw::Kind;

ForceLaw lawOf(Kind kind) {
  ForceLaw law;
  law.kind = kind;
  return law;
}

ForceLaw powerLaw(double exponent, double reference_mm) {
  ForceLaw law = lawOf(Kind::power);
  law.exponent = exponent;
  law.reference_depth_mm = reference_mm;
  return law;
}

ForceLaw stiffeningLaw(double ratio, double depth_mm) {
  ForceLaw law = lawOf(Kind::stiffening);
  law.stiffening_ratio = ratio;
  law.stiffening_depth_mm = depth_mm;
  return law;
}

ForceLaw tableLaw(const std::vector<std::array<double, 2>>& rows) {
  ForceLaw law = lawOf(Kind::table);
  for (const auto& [depth, force] : rows) {
    law.table.depth_mm[law.table.rows] = depth;
    law.table.effective_mm[law.table.rows] = force;
    ++law.table.rows;
  }
  return law;
}

struct Named {
  std::string name;
  ForceLaw law;
};

/// Every kind, also at the edges of its parameters.
std::vector<Named> laws() {
  return {{"linear", {}},
          {"power", powerLaw(1.6, 8.0)},
          {"steepest power", powerLaw(3.0, 2.0)},
          {"stiffening", stiffeningLaw(5.0, 12.0)},
          {"softening", stiffeningLaw(0.1, 4.0)},
          {"table", tableLaw({{2, 0.5}, {3, 0.5}, {10, 12}})}};
}

/// The largest relative miss of a law over measured forces, its stiffness being chosen best for that.
double worstMiss(const ForceLaw& law, const std::array<double, 4>& force_n) {
  constexpr std::array<double, 4> kDepths = {2, 5, 7.5, 10};
  double sum = 0.0;
  double sum2 = 0.0;
  for (std::size_t i = 0; i < kDepths.size(); ++i) {
    const double ratio = normalForce(law, 1.0, kDepths[i]) / force_n[i];
    sum += ratio;
    sum2 += ratio * ratio;
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < kDepths.size(); ++i) {
    worst = std::max(worst, std::abs(sum / sum2 * normalForce(law, 1.0, kDepths[i]) / force_n[i] - 1.0));
  }
  return worst;
}

}  // namespace

TEST(ForceLaw, LinearIsHookeToTheLastBit) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double stiffness = random.uniform(0.01, 2.0);
    const double depth = random.uniform(0.0, 40.0);
    const Response response = respond({}, stiffness, depth);
    EXPECT_EQ(response.force_n, stiffness * depth);
    EXPECT_EQ(response.secant_n_per_mm, stiffness);
  }
}

TEST(ForceLaw, NothingPushesAboveTheSkinNorWhereThereIsNoNumber) {
  for (const auto& [name, law] : laws()) {
    for (const double depth : {0.0, -1.0, std::nan("")}) EXPECT_EQ(normalForce(law, 0.5, depth), 0.0) << name;
    for (const double stiffness : {0.0, -0.5, std::nan("")}) EXPECT_EQ(normalForce(law, stiffness, 1.0), 0.0) << name;
  }
}

TEST(ForceLaw, ForceIsContinuousAndNeverFallsWithDepth) {
  constexpr double kStepMm = 1e-3;
  for (const auto& [name, law] : laws()) {
    const double steepest = steepestFactor(law, 41.0);
    double last = 0.0;
    for (double depth = kStepMm; depth <= 40.0; depth += kStepMm) {
      const double force = normalForce(law, 0.5, depth);
      ASSERT_GE(force, last - 1e-12) << name << " at " << depth;
      ASSERT_LE(force, last + 0.5 * steepest * kStepMm * (1 + 1e-9)) << name << " at " << depth;
      last = force;
    }
  }
}

TEST(ForceLaw, IsProportionalToTheStiffnessOfTheMap) {
  for (const auto& [name, law] : laws()) {
    for (const double depth : {0.3, 2.5, 9.0, 30.0}) {
      EXPECT_DOUBLE_EQ(normalForce(law, 0.8, depth), 2.0 * normalForce(law, 0.4, depth)) << name;
    }
  }
}

TEST(ForceLaw, TangentStiffnessIsTheDerivative) {
  constexpr double kStepMm = 1e-5;
  for (const auto& [name, law] : laws()) {
    for (double depth = 0.15; depth < 30.0; depth += 0.5) {  // not on a row of the table
      const double difference =
          (normalForce(law, 0.5, depth + kStepMm) - normalForce(law, 0.5, depth - kStepMm)) / (2 * kStepMm);
      EXPECT_NEAR(tangentStiffness(law, 0.5, depth), difference, 1e-6 * std::max(1.0, difference)) << name << depth;
    }
  }
}

TEST(ForceLaw, SecantTimesDepthIsTheForce) {
  for (const auto& [name, law] : laws()) {
    const Response response = respond(law, 0.5, 6.5);
    EXPECT_DOUBLE_EQ(response.secant_n_per_mm * 6.5, response.force_n) << name;
  }
}

TEST(ForceLaw, LimitsOfTheParametersGiveHooke) {
  for (const double depth : {0.01, 1.0, 8.0, 12.0, 25.0}) {
    EXPECT_DOUBLE_EQ(normalForce(powerLaw(1.0, 8.0), 0.5, depth), 0.5 * depth);
    EXPECT_DOUBLE_EQ(normalForce(stiffeningLaw(1.0, 12.0), 0.5, depth), 0.5 * depth);
    EXPECT_DOUBLE_EQ(normalForce(tableLaw({{5, 5}}), 0.5, depth), 0.5 * depth);
  }
}

TEST(ForceLaw, PowerAgreesWithHookeAtItsReferenceDepth) {
  EXPECT_DOUBLE_EQ(normalForce(powerLaw(1.6, 8.0), 0.5, 8.0), 4.0);
  EXPECT_NEAR(normalForce(powerLaw(1.6, 8.0), 0.5, 4.0), 4.0 * std::pow(0.5, 1.6), 1e-12);
}

TEST(ForceLaw, EveryKindAgreesWithTheMapAtTheReferenceDepth) {
  for (const auto& [name, law] : laws()) {
    const double reference = law.reference_depth_mm;
    EXPECT_NEAR(normalForce(law, 0.5, reference), 0.5 * reference, 1e-12) << name;
  }
  ForceLaw nothing_there = tableLaw({{20, 0}, {30, 1}});
  EXPECT_EQ(normalForce(nothing_there, 0.5, 8.0), 0.0) << "a table that begins deeper keeps its own unit";
  EXPECT_DOUBLE_EQ(normalForce(nothing_there, 0.5, 30.0), 0.5);
}

TEST(ForceLaw, StiffeningGoesFromALightTouchToItsRatio) {
  const ForceLaw law = stiffeningLaw(5.0, 12.0);
  const double light = tangentStiffness(law, 0.2, 0.0);
  EXPECT_LT(light, 0.2) << "the map is the secant at 8 mm, not how a light touch feels";
  EXPECT_DOUBLE_EQ(tangentStiffness(law, 0.2, 12.0), 5.0 * light);
  EXPECT_DOUBLE_EQ(tangentStiffness(law, 0.2, 30.0), 5.0 * light);
  EXPECT_NEAR(normalForce(law, 0.2, 1e-6), light * 1e-6, 1e-15);
}

TEST(ForceLaw, StiffeningIsTheIntegralOfItsGaussian) {
  const ForceLaw law = stiffeningLaw(5.0, 12.0);
  constexpr int kSteps = 100000;
  const auto integral = [&](double to) {
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      sum += (5.0 + (1.0 - 5.0) * profile(to * (i + 0.5) / kSteps / 12.0)) * to / kSteps;
    }
    return sum;
  };
  EXPECT_NEAR(normalForce(law, 0.2, 9.0), 0.2 * 8.0 / integral(8.0) * integral(9.0), 1e-9);
}

TEST(ForceLaw, ATableIsStraightBetweenItsRowsAndGoesOnWithItsLastSlope) {
  const ForceLaw law = tableLaw({{2, 1}, {6, 5}, {8, 11}});
  constexpr double kUnit = 8.0 / 11.0;  // so that 1 N/mm gives 8 N at 8 mm
  EXPECT_DOUBLE_EQ(normalForce(law, 1.0, 1.0), kUnit * 0.5) << "from the origin to the first row";
  EXPECT_DOUBLE_EQ(normalForce(law, 1.0, 2.0), kUnit * 1.0);
  EXPECT_DOUBLE_EQ(normalForce(law, 1.0, 4.0), kUnit * 3.0);
  EXPECT_DOUBLE_EQ(normalForce(law, 1.0, 8.0), kUnit * 11.0);
  EXPECT_DOUBLE_EQ(normalForce(law, 1.0, 10.0), kUnit * 17.0) << "three per mm";
}

TEST(ForceLaw, SteepestFactorBoundsTheSlope) {
  EXPECT_DOUBLE_EQ(steepestFactor({}, 40.0), 1.0);
  for (const double ratio : {5.0, 0.2}) {
    const ForceLaw law = stiffeningLaw(ratio, 12.0);
    EXPECT_DOUBLE_EQ(steepestFactor(law, 40.0), std::max(1.0, ratio) * tangentStiffness(law, 1.0, 0.0));
  }
  EXPECT_DOUBLE_EQ(steepestFactor(tableLaw({{2, 1}, {3, 9}, {8, 10}}), 40.0), 8.0 * 0.8) << "in the middle";
}

// Forces of a sphere pressed 2, 5, 7.5 and 10 mm into layered tissue, from finite elements
// (docs/explanation/force-laws.md).
TEST(ForceLaw, FitsLayeredTissueWhereHookeDoesNot) {
  struct Tissue {
    std::array<double, 4> force_n;
    double power, stiffening;
  };
  for (const Tissue& tissue : {Tissue{{0.31, 1.33, 2.62, 4.16}, 0.02, 0.02},     // middle of a back
                               Tissue{{0.49, 2.52, 5.21, 8.35}, 0.17, 0.16},     // bone near
                               Tissue{{0.23, 0.88, 1.68, 2.66}, 0.10, 0.11},     // much fat
                               Tissue{{0.60, 2.35, 4.76, 8.00}, 0.07, 0.06}}) {  // stiff skin
    EXPECT_GT(worstMiss({}, tissue.force_n), 0.4);
    EXPECT_LT(worstMiss(lawOf(Kind::power), tissue.force_n), tissue.power);
    EXPECT_LT(worstMiss(lawOf(Kind::stiffening), tissue.force_n), tissue.stiffening);
  }
}

TEST(ForceLaw, RefusesParametersThatMakeNoSense) {
  const auto message = [](const ForceLaw& law) { return support::thrownMessage([&] { check(law); }); };
  for (const auto& [name, law] : laws()) EXPECT_EQ(message(law), "no error") << name;
  EXPECT_EQ(message(powerLaw(0.5, 8.0)), "force law: exponent must be 1 to 3");
  EXPECT_EQ(message(powerLaw(1.6, 0.0)), "force law: reference_depth_mm must be above 0 and at most 1000");
  EXPECT_EQ(message(stiffeningLaw(std::nan(""), 8.0)), "force law: stiffening_ratio must be above 0 and at most 100");
  EXPECT_EQ(message(stiffeningLaw(2.0, -1.0)), "force law: stiffening_depth_mm must be above 0 and at most 1000");
  EXPECT_EQ(message(lawOf(Kind::table)), "force law: the table needs 1 to 64 rows");
  EXPECT_EQ(message(tableLaw({{2, 1}, {2, 3}})), "force law: the table's depths must increase from 0");
  EXPECT_EQ(message(tableLaw({{2, 1}, {3, 0.5}})), "force law: the table's forces must not decrease");
}

}  // namespace palpate::tissue

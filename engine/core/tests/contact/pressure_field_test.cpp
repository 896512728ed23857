// The pressure under a finger, judged by its two sums, by symmetry and by what a lump must do to it.
#include "palpate/contact/pressure_field.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/tests/contact/finger_track.h"
#include "palpate/base/random.h"
#include "support/counted.h"
#include "support/golden.h"
#include "support/lump_field.h"
#include "support/mesh_zoo.h"

namespace palpate::contact {
namespace {

constexpr double kNPerKpaMm2 = 1e-3;

struct Felt {
  FingerOutput output;
  std::shared_ptr<const Lumps> lumps;
};

/// A fingertip of 8 mm on a plate, pressed so deep and dragged a little.
Felt pressed(const Vec2& place, double depth_mm, std::vector<Lump> lumps, const Vec3& drag_mm = Vec3::Zero()) {
  Surface plate = surfaceOf(zoo::grid());
  plate.tissue_mm.assign(plate.stiffness_n_per_mm->size(), 40.0);
  Felt felt{.output = {}, .lumps = std::make_shared<const Lumps>(Lumps{.all = std::move(lumps)})};
  plate.lumps = felt.lumps;
  FingerTrack finger(plate, sphereSettings(8.0));
  finger.to({place.x(), place.y(), 10.0});
  finger.slide({place.x(), place.y(), 8.0 - depth_mm}, 0.1);
  felt.output = finger.slide(Vec3(place.x(), place.y(), 8.0 - depth_mm) + drag_mm, 0.1);
  return felt;
}

struct Field {
  std::vector<double> kpa;
  std::vector<Vec2> shear;
  PadSums sums;
};

Field computeField(const Felt& felt, const PressurePad& pad = {}) {
  static const PressureGround ground = test::inventedGround();
  Field field{std::vector<double>(pad.taxels * pad.taxels), std::vector<Vec2>(pad.taxels * pad.taxels), {}};
  field.sums = pressureField(ground, felt.lumps.get(), felt.output, pad, field.kpa, field.shear);
  return field;
}

double totalForce(const Field& field, const PressurePad& pad) {
  const double side = pad.size_mm / static_cast<double>(pad.taxels);
  return kNPerKpaMm2 * side * side * std::accumulate(field.kpa.begin(), field.kpa.end(), 0.0);
}

/// Of taxels as points in their middle, for pads fine enough: minus the lateral force of a frictionless sphere.
Vec2 lateralOf(const Field& field, const PressurePad& pad) {
  const auto n = static_cast<int>(pad.taxels);
  const double side = pad.size_mm / n;
  Vec2 sum = Vec2::Zero();
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      const Vec2 at((column + 0.5) * side - 0.5 * pad.size_mm, 0.5 * pad.size_mm - (row + 0.5) * side);
      const double kpa =
          field.kpa[static_cast<std::size_t>(row) * static_cast<std::size_t>(n) + static_cast<std::size_t>(column)];
      if (kpa > 0.0) sum -= kNPerKpaMm2 * side * side * kpa / std::sqrt(std::max(1.0, 64.0 - at.squaredNorm())) * at;
    }
  }
  return sum;
}

TEST(PressureField, AddsUpToTheNormalForceAndToTheLateralForceOfTheLumps) {
  Random random(2);
  for (int i = 0; i < 60; ++i) {
    const Vec2 place(random.uniform(42, 58), random.uniform(42, 58));
    Lump soft = test::inventedLump({60, 55, 0});
    soft.shape.stiffness_ratio = 0.3;
    soft.energy = test::inventedEnergy(soft.shape);
    const Felt felt = pressed(place, random.uniform(0.1, 8.0), {test::inventedLump({50, 50, 0}), soft},
                              {random.uniform(-1, 1), random.uniform(-1, 1), 0});
    const double normal_n = felt.output.force.dot(felt.output.normal);
    const PadPlane plane = padPlane(felt.output.normal);
    const Vec2 lateral_n(felt.output.lump_force.dot(plane.u), felt.output.lump_force.dot(plane.v));
    for (const std::size_t taxels : {2, 3, 4, 5, 8, 13, 16}) {
      const PressurePad pad{.taxels = taxels};
      const Field field = computeField(felt, pad);
      EXPECT_NEAR(totalForce(field, pad), normal_n, 1e-9 * normal_n);
      EXPECT_NEAR(field.sums.normal_n, normal_n, 1e-9 * normal_n);
      EXPECT_NEAR((field.sums.lateral_n - lateral_n).norm(), 0.0, 1e-6 * normal_n) << taxels << " taxels, run " << i;
      EXPECT_GE(*std::min_element(field.kpa.begin(), field.kpa.end()), 0.0);
    }
  }
}

TEST(PressureField, IsTheLayersPatternWhereThereIsNoLump) {
  const Felt felt = pressed({50, 50}, 5.0, {});
  const PressurePad pad{.taxels = 16};
  const Field field = computeField(felt, pad);
  const double force_n = felt.output.force.dot(felt.output.normal);
  const tissue::PressurePattern pattern = test::inventedGround().at(40.0, felt.output.depth_mm, 8.0);
  for (int row = 0; row < 16; ++row) {
    for (int column = 0; column < 16; ++column) {
      const double r = std::hypot(column - 7.5, row - 7.5);
      const double kpa = field.kpa[16 * static_cast<std::size_t>(row) + static_cast<std::size_t>(column)];
      if (r < pattern.contact_radius_mm - 1.0) {
        EXPECT_NEAR(kpa, tissue::pressureAt(pattern, force_n, r), 0.04 * kpa) << r << " mm from the middle";
      }
      if (r > pattern.contact_radius_mm + 1.0) {
        EXPECT_EQ(kpa, 0.0);
      }
    }
  }
}

TEST(PressureField, ALumpMakesABumpOnItsSideAndPushesTheTipOff) {
  const PressurePad pad{.taxels = 8};
  // The lump is to the right of the finger and nearer to the head.
  const Felt felt = pressed({47, 46}, 5.0, {test::inventedLump({50, 50, 0})});
  const Felt plain = pressed({47, 46}, 5.0, {});
  const Field with = computeField(felt, pad);
  const Field without = computeField(plain, pad);
  double right = 0.0, left = 0.0, head = 0.0, feet = 0.0;
  for (std::size_t i = 0; i < with.kpa.size(); ++i) {
    const double more = with.kpa[i] - without.kpa[i];
    (i % 8 >= 4 ? right : left) += more;
    (i / 8 < 4 ? head : feet) += more;
  }
  EXPECT_GT(right, left);
  EXPECT_GT(head, feet);
  EXPECT_LT(felt.output.lump_force.x(), 0.0);
  EXPECT_LT(lateralOf(computeField(felt, {.taxels = 16}), {.taxels = 16}).x(), 0.0);
}

TEST(PressureField, OfALumpThatMovedIsWhereTheLumpIs) {
  Felt felt = pressed({50, 50}, 5.0, {test::inventedLump({50, 50, 0})});
  const PressurePad pad{.taxels = 8};
  const Field middle = computeField(felt, pad);
  felt.output.lump = 0;
  felt.output.lump_moved_mm = {3.0, 0.0};
  felt.output.lump_force.x() = -0.01;
  felt.output.force.x() = -0.01;
  const Field moved = computeField(felt, pad);
  double shift = 0.0;
  for (std::size_t i = 0; i < 64; ++i) shift += (moved.kpa[i] - middle.kpa[i]) * (static_cast<double>(i % 8) - 3.5);
  EXPECT_GT(shift, 0.0);
}

TEST(PressureField, ShearIsFrictionsShareOfThePressure) {
  const Felt felt = pressed({50, 50}, 5.0, {test::inventedLump({50, 50, 0})}, {6.0, 0.0, 0.0});
  ASSERT_EQ(felt.output.touch, Touch::slip);
  const PressurePad pad;
  const Field field = computeField(felt, pad);
  const Vec3 friction = felt.output.force - felt.output.lump_force;
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < field.kpa.size(); ++i) {
    sum += kNPerKpaMm2 * 16.0 * field.shear[i];
    EXPECT_LE(field.shear[i].norm(), 0.46 * field.kpa[i] + 1e-12);
  }
  EXPECT_NEAR(sum.x(), friction.x(), 1e-9);
  EXPECT_NEAR(sum.y(), friction.y(), 1e-9);
  EXPECT_LT(sum.x(), -0.1);
}

TEST(PressureField, IsNothingInTheAirAndNeverJumpsOnTheWayIn) {
  const Felt air = pressed({50, 50}, -1.0, {test::inventedLump({50, 50, 0})});
  for (const double kpa : computeField(air).kpa) EXPECT_EQ(kpa, 0.0);
  const PressurePad pad{.taxels = 4};
  constexpr double kMaxKpaPerMm = 75.0;
  constexpr double kStepMm = 0.05;
  Field before = computeField(pressed({51, 50}, 0.02, {test::inventedLump({50, 50, 0})}), pad);
  for (double depth = 0.02 + kStepMm; depth < 7.0; depth += kStepMm) {
    const Field now = computeField(pressed({51, 50}, depth, {test::inventedLump({50, 50, 0})}), pad);
    for (std::size_t i = 0; i < 16; ++i) {
      EXPECT_NEAR(now.kpa[i], before.kpa[i], kMaxKpaPerMm * kStepMm) << depth << " mm, taxel " << i;
    }
    before = now;
  }
}

TEST(PressureField, ALargeDeepLumpIsTouchedALittleFartherOut) {
  const tissue::PressurePattern plain{5.0, 0.1};
  EXPECT_EQ(tissue::overLumps(plain, 0.0).contact_radius_mm, 5.0);
  EXPECT_EQ(tissue::overLumps(plain, -0.5).contact_radius_mm, 5.0) << "softer ones";
  EXPECT_NEAR(tissue::overLumps(plain, 0.2).contact_radius_mm, 5.1, 1e-12);
  EXPECT_NEAR(tissue::overLumps(plain, 3.0).contact_radius_mm, 5.15, 1e-12);
  EXPECT_EQ(tissue::overLumps(plain, 0.2).exponent, 0.1);
  const tissue::LumpShape small{.half_axes_mm = {5.0, 5.0, 5.0}, .depth_mm = 8.0};
  const tissue::LumpShape large{.half_axes_mm = {10.0, 10.0, 10.0}, .depth_mm = 8.0};
  EXPECT_EQ(tissue::wideningOf(small, 2.0), 0.0);
  EXPECT_EQ(tissue::wideningOf(large, 2.0), 1.0);
  EXPECT_EQ(tissue::wideningOf(large, 7.0), 0.0) << "right under the skin";
}

TEST(PressureField, HasTheSameBitsOnEveryInstructionSet) {
  const Felt felt = pressed({47, 52}, 5.0, {test::inventedLump({50, 50, 0}), test::inventedLump({63, 45, 0})});
  for (const std::size_t taxels : {2u, 3u, 4u, 8u, 11u, 16u}) {
    const Field expected = computeField(felt, {.taxels = taxels});
    int compared = 0;
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1, ++compared) {
      hwy::SetSupportedTargetsForTest(left & -left);
      hwy::GetChosenTarget().Update(hwy::SupportedTargets());
      const Field field = computeField(felt, {.taxels = taxels});
      hwy::SetSupportedTargetsForTest(0);
      hwy::GetChosenTarget().Update(hwy::SupportedTargets());
      EXPECT_EQ(field.kpa, expected.kpa) << taxels << " taxels, " << hwy::TargetName(left & -left);
      EXPECT_EQ(field.sums.lateral_n, expected.sums.lateral_n);
    }
    EXPECT_GE(compared, 1);
  }
}

TEST(PressureField, OfManyLumpsDoesNotDependOnTheirOrder) {
  std::vector<Lump> lumps;
  for (int i = 0; i < 20; ++i) lumps.push_back(test::inventedLump({40.0 + i, 45.0 + 7.0 * (i % 3), 0}));
  const Felt felt = pressed({48, 51}, 5.0, lumps);
  Felt other = felt;
  std::reverse(lumps.begin(), lumps.end());
  other.lumps = std::make_shared<const Lumps>(Lumps{.all = lumps});
  const Field one = computeField(felt, {.taxels = 8}), reversed = computeField(other, {.taxels = 8});
  for (std::size_t i = 0; i < one.kpa.size(); ++i) EXPECT_NEAR(one.kpa[i], reversed.kpa[i], 1e-9 * one.kpa[27]) << i;
}

TEST(PressureField, AsksForNoMemory) {
  const PressureGround ground = test::inventedGround();
  const Felt felt = pressed({47, 50}, 5.0, {test::inventedLump({50, 50, 0})});
  std::array<double, 256> kpa;
  std::array<Vec2, 256> shear;
  support::expectNoAllocation(
      [&] { pressureField(ground, felt.lumps.get(), felt.output, {.taxels = 16}, kpa, shear); });
}

/// What the pattern alone is worth: the forces are the finite elements' own, and c and q those of the stack.
PressureGround makeGround(const std::vector<tissue::PressurePattern>& at_2_5_8_mm) {
  tissue::PressField field;
  field.depths_mm = {2.0, 5.0, 8.0};
  field.patterns = at_2_5_8_mm;
  const tissue::LayerStack stack = test::backStack();
  const std::vector<tissue::WeightedField> fields = {{&stack, &field, 1.0}};
  return PressureGround({{.thickness_mm = 40.0, .form = tissue::PressureForm(fields)}});
}

TEST(PressureField, FallsOffAsItsExponentSays) {
  FingerOutput felt;
  felt.touch = Touch::stick;
  felt.normal = Vec3::UnitZ();
  felt.depth_mm = 5.0;
  felt.tissue_mm = 40.0;
  felt.finger_mm = 8.0;
  felt.force = 2.0 * felt.normal;
  for (const double exponent : {0.0, 0.1, 0.3, 0.49, 0.5, 0.6, 0.99, 1.0, 1.7, 2.5}) {
    const tissue::PressurePattern pattern{6.0, exponent};
    const PressureGround ground = makeGround({pattern, pattern, pattern});
    std::array<double, 256> kpa;
    pressureField(ground, nullptr, felt, {.taxels = 16}, kpa);
    const double peak = tissue::pressureAt(pattern, 2.0, 0.0);
    for (std::size_t i = 0; i < kpa.size(); ++i) {
      const std::size_t row = i / 16;
      const double r = std::hypot(static_cast<double>(i % 16) - 7.5, static_cast<double>(row) - 7.5);
      if (r < 5.0) {
        EXPECT_NEAR(kpa[i], tissue::pressureAt(pattern, 2.0, r), 0.03 * peak) << exponent << ", " << r << " mm";
      }
    }
  }
}

/// Means over rings of 1 mm, kPa, of 16 x 16 taxels of 1 mm.
std::array<double, 9> ringMeans(std::span<const double> kpa) {
  std::array<double, 9> sum{}, count{};
  for (int i = 0; i < 256; ++i) {
    const int row = i / 16;
    const double r = std::hypot(i % 16 - 7.5, row - 7.5);
    if (r >= 9.0) continue;
    sum[static_cast<std::size_t>(r)] += kpa[static_cast<std::size_t>(i)];
    count[static_cast<std::size_t>(r)] += 1.0;
  }
  for (std::size_t ring = 0; ring < 9; ++ring) sum[ring] /= count[ring];
  return sum;
}

/// RMS over the rings that touch, of the peak.
double relativeRmsError(const std::array<double, 9>& rings, const nlohmann::json& truth) {
  double square = 0.0, peak = 0.0, count = 0.0;
  for (std::size_t ring = 0; ring < 9; ++ring) {
    const double kpa = truth[ring];
    if (!(kpa > 0.0)) break;
    square += (rings[ring] - kpa) * (rings[ring] - kpa);
    peak = std::max(peak, kpa);
    count += 1.0;
  }
  return std::sqrt(square / count) / peak;
}

struct GoldenErrors {
  double mean = 0.0;         ///< of all presses
  double shallow = 0.0;      ///< of lumps 3 mm deep
  double only_scaled = 0.0;  ///< of those, by the pattern without a bump
};

GoldenErrors goldenErrors(const std::string& stack, const PressureGround& ground, double skin_mm) {
  GoldenErrors errors;
  double presses = 0.0, shallow = 0.0;
  for (const nlohmann::json& golden : test::goldenRows("lumps", "cases")) {
    const nlohmann::json& lump = golden["lump"];
    if (golden["stack"] != stack || golden["at_mm"] != 0 || lump["diameter_mm"] > 10.0 || lump.contains("edge"))
      continue;
    Lump placed = test::inventedLump(Vec3::Zero());
    const double half = 0.5 * lump["diameter_mm"].get<double>();
    placed.shape.half_axes_mm = {half, half, half};
    placed.shape.depth_mm = lump["depth_mm"];
    placed.skin_mm = skin_mm;
    const Lumps lumps{.all = {placed}};
    for (const nlohmann::json& press : golden["presses"]) {
      if (press["depth_mm"] < 2.0) continue;
      FingerOutput felt;
      felt.touch = Touch::stick;
      felt.normal = Vec3::UnitZ();
      felt.depth_mm = press["depth_mm"];
      felt.tip = {0, 0, -felt.depth_mm};
      felt.finger_mm = 8.0;
      felt.force = press["force_n"].get<double>() * felt.normal;
      felt.lump_force = felt.force - press["force_without_n"].get<double>() * felt.normal;
      std::array<double, 256> kpa;
      pressureField(ground, &lumps, felt, {.taxels = 16}, kpa);
      const double error = relativeRmsError(ringMeans(kpa), press["pressure_kpa"]);
      errors.mean += error;
      presses += 1.0;
      if (placed.shape.depth_mm > 3.5) continue;
      felt.lump_force.setZero();
      pressureField(ground, &lumps, felt, {.taxels = 16}, kpa);
      errors.shallow += error;
      errors.only_scaled += relativeRmsError(ringMeans(kpa), press["pressure_kpa"]);
      shallow += 1.0;
    }
  }
  EXPECT_GT(presses, 10.0);
  return {errors.mean / presses, errors.shallow / shallow, errors.only_scaled / shallow};
}

TEST(PressureField, IsNearThatOfFiniteElementsOverLumps) {
  const GoldenErrors back = goldenErrors("A", makeGround({{2.9, 0.02}, {5.1, 0.06}, {6.4, 0.14}}), 2.0);
  const GoldenErrors soft = goldenErrors("B", makeGround({{3.1, 0.10}, {5.1, 0.10}, {6.4, 0.18}}), 1.5);
  for (const GoldenErrors& errors : {back, soft}) {
    EXPECT_LT(errors.mean, 0.06);
    EXPECT_LT(errors.shallow, 0.6 * errors.only_scaled);
  }
  RecordProperty("rms_percent_back", std::to_string(100.0 * back.mean));
  RecordProperty("rms_percent_soft", std::to_string(100.0 * soft.mean));
}

}  // namespace
}  // namespace palpate::contact

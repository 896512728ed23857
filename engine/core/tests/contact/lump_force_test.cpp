// Lumps as a finger feels them, judged by energy: what is felt is minus the gradient of what is stored, closed paths
// cost nothing, and a world without lumps is as it was.
#include "palpate/contact/lump_force.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/tests/contact/finger_track.h"
#include "palpate/base/random.h"
#include "support/counted.h"
#include "support/lump_field.h"
#include "support/mesh_zoo.h"

namespace palpate::contact {
namespace {

std::shared_ptr<const Lumps> lumpsOf(std::vector<Lump> all) {
  return std::make_shared<const Lumps>(Lumps{.all = std::move(all)});
}

Surface plateWith(std::shared_ptr<const Lumps> lumps) {
  Surface plate = surfaceOf(zoo::grid());
  plate.lumps = std::move(lumps);
  return plate;
}

/// One under the middle of the plate, one beside it.
std::shared_ptr<const Lumps> twoLumps() {
  return lumpsOf({test::inventedLump({50, 50, 0}), test::inventedLump({66, 44, 0})});
}

FingerSettings frictionless(double radius_mm = 0.0) {
  FingerSettings settings = sphereSettings(radius_mm);
  settings.mu_static = settings.mu_dynamic = 0.0;
  return settings;
}

/// The energy that a press on the flat plate stores in its lumps.
double storedAt(const Lumps& lumps, const Vec3& tip, double radius_mm) {
  const LumpPress press{tip, Vec3::UnitZ(), radius_mm - tip.z(), 1.0};
  return lumpEnergy(lumps, {}, {&press, 1});
}

/// A smooth closed path round `middle` that begins and ends where it was, in the skin all the time.
Vec3 onClosedPath(const Vec3& middle, const std::array<double, 6>& size, double share) {
  const double turn = 2.0 * std::numbers::pi * share;
  return middle + Vec3(size[0] * std::sin(turn) + size[1] * std::sin(2.0 * turn),
                       size[2] * (1.0 - std::cos(turn)) + size[3] * std::sin(3.0 * turn),
                       size[4] * std::sin(turn) + size[5] * (1.0 - std::cos(2.0 * turn)));
}

TEST(LumpForce, IsMinusTheGradientOfTheEnergyForPointsAndBalls) {
  const auto lumps = twoLumps();
  const Surface plate = plateWith(lumps);
  Random random(3);
  for (const double radius_mm : {0.0, 8.0}) {
    for (int i = 0; i < 40; ++i) {
      const Vec3 tip(random.uniform(30, 75), random.uniform(30, 70), radius_mm - random.uniform(0.5, 7.0));
      FingerState state;
      step(plate, frictionless(radius_mm), state, {tip.x(), tip.y(), radius_mm + 1.0});
      const FingerOutput felt = step(plate, frictionless(radius_mm), state, tip);
      constexpr double kStep = 1e-4;
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 aside = kStep * Vec3::Unit(axis);
        const double slope =
            (storedAt(*lumps, tip + aside, radius_mm) - storedAt(*lumps, tip - aside, radius_mm)) / (2.0 * kStep);
        EXPECT_NEAR(felt.lump_force[axis], -slope, 1e-6)
            << radius_mm << " mm, axis " << axis << " at " << tip.transpose();
      }
      EXPECT_NEAR((felt.force - felt.lump_force - kTestStiffness * felt.depth_mm * Vec3::UnitZ()).norm(), 0.0, 1e-12);
      EXPECT_NEAR(felt.lump_share, felt.lump_force.z() / (kTestStiffness * felt.depth_mm), 1e-12);
    }
  }
}

TEST(LumpForce, AStifferLumpPushesTheTipOffAndASofterOneDrawsItIn) {
  Lump hard = test::inventedLump({50, 50, 0});
  tissue::LumpShape shape = hard.shape;
  shape.stiffness_ratio = 0.3;
  Lump soft = hard;
  soft.shape = shape;
  soft.energy = test::inventedEnergy(shape);
  for (const bool is_hard : {true, false}) {
    const Surface plate = plateWith(lumpsOf({is_hard ? hard : soft}));
    FingerTrack finger(plate, frictionless());
    finger.to({55, 50, 1});
    const FingerOutput felt = finger.to({55, 50, -5});
    EXPECT_EQ(felt.lump_force.z() > 0.0, is_hard);
    EXPECT_EQ(felt.lump_force.x() > 0.0, is_hard);
    EXPECT_GT(std::abs(felt.lump_force.x()), 1e-4);
  }
}

/// Work of the whole force along a closed path in so many steps, by the trapezium rule, over the most that was stored.
double workOfALoop(const Surface& surface, const Vec3& middle, const std::array<double, 6>& size, int steps) {
  FingerState state;
  step(surface, frictionless(), state, middle + Vec3(0, 0, 30));
  FingerOutput before = step(surface, frictionless(), state, onClosedPath(middle, size, 0.0));
  double work = 0.0;
  double most = 0.0;
  for (int i = 1; i <= steps; ++i) {
    const Vec3 tip = onClosedPath(middle, size, static_cast<double>(i) / steps);
    const FingerOutput felt = step(surface, frictionless(), state, tip);
    EXPECT_EQ(felt.status & kCatchingUp, 0u);
    work += 0.5 * (before.force + felt.force).dot(tip - before.tip);
    const LumpPress press{tip, felt.normal, felt.depth_mm, 1.0};
    most = std::max(most, lumpEnergy(*surface.lumps, {}, {&press, 1}));
    before = felt;
  }
  return std::abs(work) / most;
}

/// z = 0.001 r^2, seen from above: under it the nearest skin is one place, which moves without a leap.
Surface bowlWithLumps() {
  mesh::TriangleMesh mesh = zoo::dome({-60.0, -60.0}, 6.0, 0.0);
  for (Vec3& point : mesh.positions) point.z() = -point.z();
  Surface bowl = surfaceOf(mesh);
  const Vec3 aside(-0.03, -0.01, 1.0);
  bowl.lumps = lumpsOf({test::inventedLump({0, 0, 0}), test::inventedLump({15, 5, 0.25}, aside.normalized())});
  return bowl;
}

TEST(LumpForce, ClosedPathsWithoutFrictionCostNothing) {
  const Surface plate = plateWith(twoLumps());
  const Surface bowl = bowlWithLumps();
  Random random(7);
  for (int i = 0; i < 30; ++i) {
    const std::array<double, 6> size = {random.uniform(-7, 7), random.uniform(-3, 3), random.uniform(-5, 5),
                                        random.uniform(-2, 2), random.uniform(-1, 1), random.uniform(-1, 1)};
    for (const auto& [surface, middle] : {std::pair(&plate, Vec3(52, 48, -4)), std::pair(&bowl, Vec3(4, 1, -4))}) {
      const double coarse = workOfALoop(*surface, middle, size, 1000);
      const double fine = workOfALoop(*surface, middle, size, surface == &plate ? 8000 : 32000);
      EXPECT_LT(fine, 1e-5) << "path " << i << (surface == &plate ? ", plate" : ", bowl");
      if (surface == &plate && coarse > 1e-6) {
        EXPECT_LT(fine, coarse / 32.0) << "falls with the square";
      }
    }
  }
}

TEST(LumpForce, WithoutLumpsWithinReachNoBitChanges) {
  const Surface bare = plateWith(nullptr);
  const Surface empty = plateWith(lumpsOf({}));
  const Surface far = plateWith(lumpsOf({test::inventedLump({500, 0, 0})}));
  Random random(5);
  for (const Surface* other : {&empty, &far}) {
    FingerSettings settings;
    settings.relaxation.share = 0.2;
    FingerState one, two;
    Vec3 tip(40, 40, 1);
    for (int i = 0; i < 500; ++i) {
      tip += Vec3(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.25));
      const FingerOutput a = step(bare, settings, one, tip);
      const FingerOutput b = step(*other, settings, two, tip);
      for (int k = 0; k < 3; ++k) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(a.force[k]), std::bit_cast<std::uint64_t>(b.force[k])) << i;
      }
      ASSERT_EQ(a.hold, b.hold);
      ASSERT_TRUE(b.lump_force.isZero(0.0));
      ASSERT_EQ(b.lump_share, 0.0);
      ASSERT_EQ(b.lump, kNoIndex);
    }
  }
}

TEST(LumpForce, IsAddedAfterFrictionWhichKnowsThePressWithoutIt) {
  const Surface bare = plateWith(nullptr);
  const Surface plate = plateWith(twoLumps());
  FingerTrack without(bare), with(plate);
  for (double x = 40; x < 60; x += 0.25) {
    const Vec3 tip(x, 47, x < 42 ? 1.0 : -4.0);
    const FingerOutput a = without.to(tip);
    const FingerOutput b = with.to(tip);
    EXPECT_EQ(a.touch, b.touch);
    EXPECT_EQ(a.hold, b.hold);
    EXPECT_EQ(Vec3(a.force + b.lump_force), b.force);
  }
}

TEST(LumpForce, RelaxationTakesItsShareOfBothParts) {
  const Surface plate = plateWith(twoLumps());
  FingerSettings settings = frictionless();
  settings.relaxation = {.share = 0.25, .time_s = 0.05};
  FingerTrack finger(plate, settings);
  finger.to({54, 50, 1});
  const FingerOutput at_once = finger.to({54, 50, -5});
  FingerOutput later;
  for (int i = 0; i < 2000; ++i) later = finger.to({54, 50, -5});
  EXPECT_NEAR((later.lump_force - 0.75 * at_once.lump_force).norm(), 0.0, 1e-9);
  EXPECT_NEAR(later.lump_share, at_once.lump_share, 1e-9);
}

TEST(LumpForce, GrowsNoFasterThanTheSteepestPlacesOfItsLumps) {
  const auto lumps = twoLumps();
  const Surface plate = plateWith(lumps);
  double steepest = 0.0;
  for (const Lump& lump : lumps->all) {
    const tissue::LumpSteepness steepness = lump.energy.steepest();
    steepest += 2.0 * std::max(steepness.depth, steepness.rho);  // a mixed second derivative is below their sum
  }
  Random random(11);
  FingerState state;
  Vec3 tip(50, 50, 1);
  FingerOutput before = step(plate, {}, state, tip);
  for (int i = 0; i < 4000; ++i) {
    const Vec3 pull = Vec3(50, 50, -3) - tip;
    tip += 0.02 * pull + Vec3(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3));
    const FingerOutput felt = step(plate, {}, state, tip);
    const double most_mm = 3.0 * (tip - before.tip).norm() + 0.1;
    EXPECT_LE((felt.lump_force - before.lump_force).norm(), steepest * most_mm) << i;
    before = felt;
  }
}

TEST(LumpForce, IsNotFeltFromTheOtherSideOfAThinPart) {
  Surface plate = surfaceOf(zoo::plate(50.0, 8.0));
  plate.lumps = lumpsOf({test::inventedLump({25, 25, 8})});
  FingerTrack above(plate), below(plate);
  above.to({25, 25, 9});
  EXPECT_GT(above.slide({25, 25, 6}, 0.2).lump_share, 0.0);
  below.to({25, 25, -1});
  const FingerOutput felt = below.slide({25, 25, 2}, 0.2);
  EXPECT_TRUE(touches(felt));
  EXPECT_TRUE(felt.lump_force.isZero(0.0));
}

TEST(LumpForce, ATickAsksForNoMemory) {
  std::vector<Lump> all;
  for (int i = 0; i < 8; ++i) {
    all.push_back(test::inventedLump({30.0 + 5.0 * i, 50, 0}));
    all.back().mobility.spring_n_per_mm = 0.1;
    all.back().mobility.friction_n = 0.0;
  }
  const auto lumps = lumpsOf(std::move(all));
  const Surface plate = plateWith(lumps);
  FingerState state;
  LumpPlaces places;
  step(plate, {}, state, {40, 50, 1}, &places);
  support::expectNoAllocation([&] {
    for (int i = 0; i < 100; ++i) {
      step(plate, {}, state, {40 + 0.1 * i, 50, -3}, &places);
      moveLumps(*lumps, {&state.lumps, 1}, 0.001, places);
    }
  });
  EXPECT_GT(places.moved_mm[2].norm() + places.moved_mm[3].norm(), 0.0);
}

// ---- lumps that move

Lump mobile(const Vec3& foot, double spring_n_per_mm) {
  Lump lump = test::inventedLump(foot);
  lump.mobility.spring_n_per_mm = spring_n_per_mm;
  return lump;
}

LumpPress pressAt(double x_mm, double y_mm, double depth_mm) {
  return {{x_mm, y_mm, -depth_mm}, Vec3::UnitZ(), depth_mm, 1.0};
}

TEST(MobileLump, GivesWayToAPressBesideItAndStopsAtItsLimit) {
  Lump lump = mobile({50, 50, 0}, 0.01);
  lump.mobility.limit_mm = 3.0;
  lump.mobility.friction_n = 0.0;
  const Lumps lumps{.all = {lump}};
  LumpPlaces places;
  const LumpPress press = pressAt(46, 50, 7);
  double before = 0.0;
  for (int i = 0; i < 20000; ++i) {
    moveLumps(lumps, {&press, 1}, 0.001, places);
    EXPECT_LE(places.moved_mm[0].norm() - before, 0.5 + 1e-12) << "a tick";
    before = places.moved_mm[0].norm();
  }
  EXPECT_NEAR(places.moved_mm[0].x(), 3.0, 1e-9);
  EXPECT_NEAR(places.moved_mm[0].y(), 0.0, 1e-9);
}

TEST(MobileLump, ComesBackToWhereFrictionHoldsIt) {
  Lump lump = mobile({50, 50, 0}, 0.1);
  const Lumps lumps{.all = {lump}};
  LumpPlaces places;
  places.moved_mm[0] = {4.0, 0.0};
  for (int i = 0; i < 5000; ++i) moveLumps(lumps, {}, 0.001, places);
  EXPECT_NEAR(places.moved_mm[0].norm(), lump.mobility.friction_n / lump.mobility.spring_n_per_mm, 1e-6);
}

TEST(MobileLump, TwoFingersHoldItBetweenThem) {
  Lump lump = mobile({50, 50, 0}, 0.02);
  lump.mobility.friction_n = 0.0;
  const Lumps lumps{.all = {lump}};
  LumpPlaces alone, held;
  const std::array presses = {pressAt(45, 50, 6), pressAt(55, 50, 6)};
  for (int i = 0; i < 5000; ++i) {
    moveLumps(lumps, {presses.data(), 1}, 0.001, alone);
    moveLumps(lumps, presses, 0.001, held);
  }
  EXPECT_GT(alone.moved_mm[0].x(), 0.5);
  EXPECT_NEAR(held.moved_mm[0].norm(), 0.0, 1e-9);
}

TEST(MobileLump, NoStepMakesEnergy) {
  Random random(17);
  for (int i = 0; i < 300; ++i) {
    Lump lump = mobile({50, 50, 0}, random.uniform(0.01, 0.3));
    lump.mobility.friction_n = random.uniform(0.0, 0.05);
    const Lumps lumps{.all = {lump, mobile({62, 50, 0}, 0.1)}};
    LumpPlaces places;
    places.moved_mm[0] = {random.uniform(-6, 6), random.uniform(-6, 6)};
    std::array<LumpPress, 4> presses;
    for (LumpPress& press : presses) {
      press = pressAt(random.uniform(42, 58), random.uniform(42, 58), random.uniform(1, 9));
    }
    for (int tick = 0; tick < 50; ++tick) {
      const double before = lumpEnergy(lumps, places, presses);
      moveLumps(lumps, presses, random.uniform(0.0002, 0.02), places);
      EXPECT_LE(lumpEnergy(lumps, places, presses), before + 1e-12);
    }
  }
}

/// One finger on a mobile lump along a random smooth path that ends in the air: what the hand has put in at every
/// moment, less what is stored. Never below nothing.
TEST(MobileLump, APathGivesBackNoMoreThanIsStored) {
  Random random(23);
  for (int path = 0; path < 40; ++path) {
    Lump lump = mobile({50, 50, 0}, path % 2 == 0 ? 0.15 : 0.03);
    const auto lumps = lumpsOf({lump});
    const Surface plate = plateWith(lumps);
    std::array<double, 6> size;
    for (double& s : size) s = random.uniform(-6, 6);
    FingerState state;
    LumpPlaces places;
    FingerOutput before = step(plate, frictionless(), state, {50, 50, 1}, &places);
    double put_in = 0.0;
    double least = 0.0;
    for (int tick = 1; tick <= 4000; ++tick) {
      const double t = tick / 4000.0;
      const double depth = 6.0 * std::sin(std::numbers::pi * t) * std::sin(std::numbers::pi * t);
      const Vec3 tip = onClosedPath({50, 50, 0}, {size[0], size[1], 0.5 * size[2], 0.5 * size[3], 0, 0}, 2.0 * t) -
                       Vec3(0, 0, depth);
      moveLumps(*lumps, {&state.lumps, 1}, 0.001, places);
      // The force at the tick's beginning, with the lumps where they are now.
      const FingerOutput from = step(plate, frictionless(), state, before.tip, &places);
      const FingerOutput felt = step(plate, frictionless(), state, tip, &places);
      put_in -= 0.5 * (from.force + felt.force).dot(tip - before.tip);
      const double stored =
          0.5 * kTestStiffness * felt.depth_mm * felt.depth_mm + lumpEnergy(*lumps, places, {&state.lumps, 1});
      least = std::min(least, put_in - stored);
      before = felt;
    }
    EXPECT_GT(least, -1e-5) << "path " << path;
  }
}

}  // namespace
}  // namespace palpate::contact

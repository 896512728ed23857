// Lumps that move, in the loops that feel them: one state for all fingers of a rig, the same bits for the same tips.
#include "palpate/servo/lump_loop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/tests/scene/dome_scene.h"
#include "palpate/base/random.h"
#include "palpate/scene/world.h"
#include "palpate/servo/device_limits.h"
#include "palpate/servo/finger_solver.h"
#include "support/counted.h"
#include "support/lump_field.h"

namespace palpate::servo {
namespace {

contact::Lump mobileLump(const Vec3& foot, double spring_n_per_mm = 0.05) {
  contact::Lump lump = test::inventedLump(foot);
  lump.mobility.spring_n_per_mm = spring_n_per_mm;
  lump.mobility.friction_n = 0.01;
  return lump;
}

/// A flat plate at z = 0, 200 mm wide, 0.5 N/mm.
contact::Surface plateWith(std::vector<contact::Lump> lumps) {
  mesh::TriangleMesh mesh;
  mesh.positions = {Vec3(-100, -100, 0), Vec3(100, -100, 0), Vec3(100, 100, 0), Vec3(-100, 100, 0)};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  contact::SurfaceOptions options;
  options.lumps = std::make_shared<const contact::Lumps>(contact::Lumps{.all = std::move(lumps)});
  return contact::buildSurface(mesh, std::vector<double>(4, 0.5), options);
}

struct Hand {
  explicit Hand(const contact::Surface& surface, std::size_t fingers)
      : solvers(makeSolvers(surface, nullptr, fingers)), states(fingers) {
    settings.mu_static = settings.mu_dynamic = 0.0;
  }
  contact::FingerOutput feel(std::size_t finger, const Vec3& tip) {
    return touch(solvers[finger], settings, states[finger], tip);
  }
  contact::FingerSettings settings;
  FingerSolvers solvers;
  std::vector<contact::FingerState> states;
};

Vec3 pathOf(std::size_t finger, int tick) {
  const double t = 0.004 * tick;
  const double side = finger == 0 ? -4.0 : 5.0;
  return {side + 3.0 * std::sin(t), 2.0 * std::sin(1.7 * t), 1.0 - 7.0 * std::sin(0.5 * t) * std::sin(0.5 * t)};
}

TEST(LumpLoop, IsThereOnlyWhereALumpMoves) {
  EXPECT_EQ(makeSolvers(plateWith({}), nullptr, 2)[0].lumps, nullptr);
  const contact::Surface fixed = plateWith({test::inventedLump({0, 0, 0})});
  EXPECT_EQ(makeSolvers(fixed, nullptr, 2)[0].lumps, nullptr);
  const contact::Surface mobile = plateWith({mobileLump({0, 0, 0})});
  const FingerSolvers solvers = makeSolvers(mobile, nullptr, 2);
  EXPECT_NE(solvers[0].lumps, nullptr);
  EXPECT_EQ(solvers[0].lumps, solvers[1].lumps) << "two fingers feel one lump";
}

TEST(LumpLoop, TheLumpMovesOnceATickAndFingersOfATickFeelItInOnePlace) {
  const contact::Surface plate = plateWith({mobileLump({0, 0, 0})});
  Hand hand(plate, 2);
  for (int tick = 0; tick < 1000; ++tick) {
    const contact::FingerOutput left = hand.feel(0, pathOf(0, tick));
    const contact::FingerOutput right = hand.feel(1, pathOf(1, tick));
    if (left.lump == 0 && right.lump == 0) {
      ASSERT_EQ(left.lump_moved_mm, right.lump_moved_mm) << tick;
    }
  }
  EXPECT_GT(hand.solvers[0].lumps->places().moved_mm[0].norm(), 0.05);
}

TEST(LumpLoop, TheSameTipsGiveTheSameBits) {
  const contact::Surface plate = plateWith({mobileLump({0, 0, 0}), test::inventedLump({20, 0, 0})});
  Hand one(plate, 2), other(plate, 2);
  for (int tick = 0; tick < 2000; ++tick) {
    for (std::size_t i = 0; i < 2; ++i) {
      const contact::FingerOutput a = one.feel(i, pathOf(i, tick));
      const contact::FingerOutput b = other.feel(i, pathOf(i, tick));
      ASSERT_EQ(a.force, b.force) << tick;
      ASSERT_EQ(a.lump_moved_mm, b.lump_moved_mm) << tick;
    }
  }
}

TEST(LumpLoop, AFingerThatIsLiftedLetsGoOfTheLump) {
  const contact::Surface plate = plateWith({mobileLump({0, 0, 0}, 0.2)});
  Hand hand(plate, 2);
  for (int tick = 0; tick < 500; ++tick) {
    hand.feel(0, {-5, 0, tick == 0 ? 1.0 : -6.0});
    hand.feel(1, {50, 0, 1});
  }
  EXPECT_GT(hand.solvers[0].lumps->places().moved_mm[0].x(), 0.05);
  lift(hand.solvers[0], hand.states[0]);
  for (int tick = 0; tick < 500; ++tick) hand.feel(1, {50, 0, 1});
  EXPECT_LE(hand.solvers[0].lumps->places().moved_mm[0].norm(), 0.01 / 0.2 + 1e-9);
}

TEST(LumpLoop, ALumpStaysWhereItMovedToInAnotherWorldThatHasIt) {
  const contact::Surface plate = plateWith({mobileLump({0, 0, 0}), mobileLump({40, 0, 0})});
  const contact::Surface reordered = plateWith({mobileLump({-40, 0, 0}), mobileLump({0, 0, 0})});
  Hand hand(plate, 2);
  for (int tick = 0; tick < 900; ++tick) {
    for (std::size_t i = 0; i < 2; ++i) hand.feel(i, pathOf(i, tick));
  }
  const Vec2 moved = hand.solvers[0].lumps->places().moved_mm[0];
  ASSERT_GT(moved.norm(), 0.05);
  FingerSolvers next = makeSolvers(reordered, nullptr, 2);
  support::expectNoAllocation([&] {
    for (std::size_t i = 0; i < 2; ++i) exchange(hand.solvers[i], next[i], hand.states[i]);
  });
  EXPECT_EQ(hand.solvers[0].lumps, hand.solvers[1].lumps);
  EXPECT_EQ(hand.solvers[1].lumps->places().moved_mm[1], moved);
  EXPECT_TRUE(hand.solvers[1].lumps->places().moved_mm[0].isZero(0.0));
}

/// Both fingers on springs that a hand moves along random paths: what the springs have done on the tips, less what is
/// stored in skin and lumps, is what was lost.
TEST(LumpLoop, TwoFingersGetBackNoMoreThanIsStored) {
  Random random(31);
  for (int path = 0; path < 20; ++path) {
    const contact::Surface plate = plateWith({mobileLump({0, 0, 0}, random.uniform(0.02, 0.2))});
    Hand hand(plate, 2);
    std::array<contact::FingerOutput, 2> before;
    double put_in = 0.0, least = 0.0;
    for (std::size_t i = 0; i < 2; ++i) before[i] = hand.feel(i, pathOf(i, 0));
    const double slow = random.uniform(0.3, 1.0);
    for (int tick = 1; tick < 3000; ++tick) {
      double stored = 0.0;
      std::array<contact::LumpPress, 2> presses;
      for (std::size_t i = 0; i < 2; ++i) {
        const auto at = static_cast<int>(slow * tick);
        const Vec3 tip = pathOf(i, at) + (slow * tick - at) * (pathOf(i, at + 1) - pathOf(i, at));
        const Vec3 from = before[i].tip;
        const contact::FingerOutput felt = hand.feel(i, tip);
        // The force where the tip came from, with the lump where it is in this tick.
        contact::FingerState there = {};
        const contact::LumpPlaces places = hand.solvers[i].lumps->places();
        contact::step(plate, hand.settings, there, {from.x(), from.y(), 1.0}, &places);
        const Vec3 force = contact::step(plate, hand.settings, there, from, &places).force;
        put_in -= 0.5 * (force + felt.force).dot(tip - from);
        presses[i] = hand.states[i].lumps;
        stored += 0.25 * felt.depth_mm * felt.depth_mm;
        before[i] = felt;
      }
      stored += contact::lumpEnergy(*plate.lumps, hand.solvers[0].lumps->places(), presses);
      least = std::min(least, put_in - stored);
    }
    EXPECT_GT(least, -1e-5) << "path " << path;
  }
}

TEST(LumpLoop, ATickAsksForNoMemory) {
  const contact::Surface plate = plateWith({mobileLump({0, 0, 0})});
  Hand hand(plate, 2);
  support::expectNoAllocation([&] {
    for (int tick = 0; tick < 500; ++tick) {
      for (std::size_t i = 0; i < 2; ++i) hand.feel(i, pathOf(i, tick));
    }
  });
}

using DomeWithLumps = scene::DomeScene;

TEST_F(DomeWithLumps, ADevicesLimitsKnowTheSteepestLump) {
  writeDome("dome.obj");
  tissue::writeLayeredTable(folder_ / "back.json", test::inventedTable());
  const std::string tissue = "[tissue]\nlayer_table = \"back.json\"\n";
  const auto bare = scene::build(meshScene(tissue));
  const auto with =
      scene::build(meshScene(tissue + "[[lump]]\ndepth_mm = 2.5\ndiameter_mm = 20\nstiffness_ratio = 50\n"));
  EXPECT_GT(limiterSettings(*with).stiffness_n_per_mm, limiterSettings(*bare).stiffness_n_per_mm);
}

}  // namespace
}  // namespace palpate::servo

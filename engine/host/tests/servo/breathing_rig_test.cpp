// A body that breathes, as fingers feel it: judged against a body that was really built moved.
#include <gtest/gtest.h>

#include "palpate/contact/surface.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/world.h"
#include "palpate/servo/finger_solver.h"

namespace palpate::servo {
namespace {

constexpr const char* kScene = R"(
[body]
triangles = 20000
[breathing]
on = true
depth_mm = 2
per_minute = 15
[[finger]]
name = "index"
at = "T10"
script = [{ do = "hold", seconds = 1 }]
)";

std::shared_ptr<const scene::World> breathing(const std::string& more = "") {
  return scene::build(scene::parse(kScene + more, "breathing.toml"));
}

/// The skin of the world where its breath has taken it, built again.
contact::Surface movedSurface(const scene::World& world, double lift_mm) {
  mesh::TriangleMesh skin = world.body->skin;
  for (Vec3& p : skin.positions) p = world.breath->moved(p, lift_mm);
  contact::Surface surface =
      contact::buildSurface(skin, *world.surface.stiffness_n_per_mm, {world.surface.force_law, false});
  surface.tissue_mm = world.surface.tissue_mm;
  return surface;
}

/// From outside down to a place and there for a while; what is felt last.
template <class Touch>
contact::FingerOutput pressed(const Vec3& from, const Vec3& to, int ticks, const Touch& touch) {
  contact::FingerOutput felt;
  for (int tick = 0; tick < ticks; ++tick) {
    felt = touch(tick < 200 ? Vec3(from + tick / 200.0 * (to - from)) : to, tick);
  }
  return felt;
}

TEST(BreathingRig, FeelsWhatASkinThatWasBuiltMovedWouldGive) {
  const auto world = breathing();
  constexpr int kBreathedIn = 2001;  // ticks of 1 ms: the last at 2 s, half of a breath of 4 s
  for (const double radius_mm : {0.0, 8.0}) {
    contact::FingerSettings settings;
    settings.radius_mm = radius_mm;
    for (const Vec2& aside : {Vec2(0, 0), Vec2(60, 10), Vec2(-40, -60), Vec2(20, 90)}) {
      const Vec3 above(world->scene.fingers[0].at_mm.x() + aside.x(), world->scene.fingers[0].at_mm.y() + aside.y(),
                       400);
      const contact::Surface moved = movedSurface(*world, 2.0);
      const Vec3 skin = tree::firstFrontCrossing(moved.geometry->tree, above, above - Vec3(0, 0, 500)).point;
      const Vec3 tip = skin + Vec3(0, 0, radius_mm - 5.0);
      FingerSolvers solvers = makeSolvers(world->surface, nullptr, 1, world->breath);
      contact::FingerState state, other;
      const auto felt = pressed(above, tip, kBreathedIn, [&](const Vec3& at, int tick) {
        return touch(solvers[0], settings, state, at, static_cast<std::uint64_t>(tick));
      });
      const auto real = pressed(above, tip, kBreathedIn,
                                [&](const Vec3& at, int) { return contact::step(moved, settings, other, at); });
      ASSERT_GT(real.force.norm(), 1.0);
      // Within 3 % of the depth; layered tissue pushes back as its power of 1.5 to 1.8.
      EXPECT_LT((felt.force - real.force).norm(), 0.05 * real.force.norm());
      EXPECT_LT((felt.proxy - real.proxy).norm(), 0.1);
      EXPECT_EQ(felt.tip, tip);
    }
  }
}

TEST(BreathingRig, AFingerThatKeepsStillIsPressedHarderAsTheBodyBreathesIn) {
  const auto world = breathing("[tissue]\nforce_law = \"linear\"\n");
  FingerSolvers solvers = makeSolvers(world->surface, nullptr, 1, world->breath);
  const contact::FingerSettings settings;
  contact::FingerState state;
  const Vec2 at = world->scene.fingers[0].at_mm;
  const Vec3 above(at.x(), at.y(), 400);
  const Vec3 skin = tree::firstFrontCrossing(world->surface.geometry->tree, above, above - Vec3(0, 0, 500)).point;
  double least = 1e9, most = 0.0, step = 0.0, before = 0.0;
  for (std::uint64_t tick = 0; tick < 9000; ++tick) {
    const double share = std::min(1.0, static_cast<double>(tick) / 500.0);
    const auto felt = touch(solvers[0], settings, state, above + share * (skin - Vec3(0, 0, 3) - above), tick);
    const double force = felt.force.norm();
    if (tick > 1000) {
      least = std::min(least, force);
      most = std::max(most, force);
      step = std::max(step, std::abs(force - before));
    }
    before = force;
  }
  const double stiffness = most / 5.0;  // 3 mm pressed and 2 mm breathed
  EXPECT_NEAR(most - least, 2.0 * stiffness, 0.1 * stiffness);
  EXPECT_LT(step, 0.005 * most) << "never a step";
}

TEST(BreathingRig, GivesTheSameBitsTwiceAndNoForceInFreeSpace) {
  const auto world = breathing();
  const contact::FingerSettings settings;
  std::array<std::vector<double>, 2> forces;
  for (auto& run : forces) {
    FingerSolvers solvers = makeSolvers(world->surface, nullptr, 1, world->breath);
    contact::FingerState state;
    for (std::uint64_t tick = 0; tick < 3000; ++tick) {
      const Vec3 tip(30.0, -100.0, 300.0 - 0.1 * static_cast<double>(tick));
      const auto felt = touch(solvers[0], settings, state, tip, tick);
      if (felt.touch == contact::Touch::free) {
        EXPECT_EQ(felt.proxy, tip);
        EXPECT_EQ(felt.force, Vec3(Vec3::Zero()));
      }
      run.insert(run.end(), felt.force.data(), felt.force.data() + 3);
    }
  }
  EXPECT_EQ(forces[0], forces[1]);
  EXPECT_GT(*std::max_element(forces[0].begin(), forces[0].end()), 1.0);
}

TEST(BreathingRig, ALostTipIsNoPlace) {
  const auto world = breathing();
  FingerSolvers solvers = makeSolvers(world->surface, nullptr, 1, world->breath);
  contact::FingerState state;
  touch(solvers[0], {}, state, Vec3(0, 0, 300), 1500);
  const auto lost = touch(solvers[0], {}, state, Vec3::Constant(std::nan("")), 1501);
  EXPECT_NE(lost.status & contact::kTipLost, 0u);
  EXPECT_TRUE(lost.tip.allFinite());
  EXPECT_EQ(lost.force, Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace palpate::servo

#include "palpate/engine/simulator.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "host/tests/engine/small_worlds.h"
#include "palpate/base/error.h"
#include "palpate/contact/finger.h"
#include "palpate/engine/fingers.h"
#include "palpate/engine/live_simulator.h"
#include "palpate/scene/skin_contact.h"
#include "support/counted.h"

namespace palpate::engine {
namespace {

/// Down into the sheet, round a circle, and up again; every finger somewhere else.
Vec3 pathOf(std::size_t finger, int tick) {
  const double turn = 0.02 * tick + static_cast<double>(finger);
  const double down = 6.0 * std::sin(0.01 * tick);
  return {60.0 + 20.0 * static_cast<double>(finger) + 8.0 * std::cos(turn), 90.0 + 8.0 * std::sin(turn), 2.0 - down};
}

void expectSame(const contact::FingerOutput& a, const contact::FingerOutput& b) {
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.proxy, b.proxy);
  EXPECT_EQ(a.anchor, b.anchor);
  EXPECT_EQ(a.depth_mm, b.depth_mm);
  EXPECT_EQ(a.touch, b.touch);
  EXPECT_EQ(a.triangle, b.triangle);
  EXPECT_EQ(a.status, b.status);
}

scene::Scene fingersOf(std::initializer_list<double> radii_mm) {
  scene::Scene scene;
  for (const double radius_mm : radii_mm) scene.fingers.emplace_back().radius_mm = radius_mm;
  return scene;
}

TEST(Simulator, FeelsBitForBitWhatContactStepFeels) {
  const auto world = sheet(0.5, fingersOf({0.0, 8.0}));
  Simulator simulator(world);
  ASSERT_EQ(simulator.fingers(), 2u);
  contact::FingerState states[2];
  int touching = 0;
  for (int tick = 0; tick < 400; ++tick) {
    for (std::size_t i = 0; i < 2; ++i) {
      const auto expected = contact::step(world->surface, scene::contactSettings(world->scene, world->scene.fingers[i]),
                                          states[i], pathOf(i, tick));
      expectSame(simulator.feel(i, pathOf(i, tick)), expected);
      touching += expected.depth_mm > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(touching, 300);
}

TEST(Fingers, OnlySpheresKeepTheSkinNearThem) {
  const auto world = sheet(0.5, fingersOf({0.0, 8.0}));
  ASSERT_NE(world->surface.planes, nullptr);
  const std::vector<Finger> fingers = fingersOn(*world, fingerSettings(world->scene));
  EXPECT_EQ(fingers[0].solver.source.skin, nullptr);
  EXPECT_NE(fingers[1].solver.source.skin, nullptr);
}

TEST(Simulator, FeelsThroughTheDetectingBoxWhereTheWorldSaysSo) {
  scene::Scene scene;
  scene.contact.source = scene::ContactSource::hdb;
  scene.partition.hdb_edge_mm = 60.0;
  const auto world = sheet(0.5, scene);
  Simulator simulator(world);
  auto solvers = servo::makeSolvers(world->surface, world->hdb, 1);
  contact::FingerState state;
  int touching = 0;
  for (int tick = 0; tick < 300; ++tick) {
    const auto expected = servo::touch(solvers[0], fingerSettings(world->scene)[0], state, pathOf(0, tick));
    expectSame(simulator.feel(0, pathOf(0, tick)), expected);
    touching += expected.depth_mm > 0.0 ? 1 : 0;
  }
  EXPECT_GT(touching, 200);
}

/// Each alone on a simulator of its own: nothing that fingers might share can make the two agree.
TEST(Simulator, ABatchIsEveryFingerOnItsOwn) {
  const auto world = sheet(0.5, fingersOf({0.0, 8.0, 5.0}));
  const auto settings = fingerSettings(world->scene);
  std::vector<Simulator> alone;
  for (const contact::FingerSettings& finger : settings) alone.emplace_back(world, std::vector{finger});
  Simulator together(world);
  std::vector<Vec3> tips(3);
  std::vector<contact::FingerOutput> felt(3);
  std::array<int, 3> touching{};
  for (int tick = 0; tick < 300; ++tick) {
    for (std::size_t i = 0; i < 3; ++i) tips[i] = pathOf(i, tick);
    together.feel(tips, felt);
    for (std::size_t i = 0; i < 3; ++i) {
      expectSame(felt[i], alone[i].feel(0, tips[i]));
      touching[i] += felt[i].depth_mm > 0.0 ? 1 : 0;
    }
  }
  for (const int ticks : touching) EXPECT_GT(ticks, 100);
}

TEST(Simulator, ShowsTheSkinThatItsFingersLeave) {
  const auto world = sheet(0.5, fingersOf({0.0, 8.0}));
  Simulator simulator(world);
  std::vector<contact::FingerOutput> felt(2);
  for (int tick = 0; tick < 120; ++tick) {
    simulator.feel(std::vector<Vec3>{pathOf(0, tick), pathOf(1, tick)}, felt);
  }
  std::vector<deform::Contact> contacts;
  for (const auto& finger : felt) contacts.push_back(scene::contactOf(*world, finger).value());
  deform::FormSettings forms = world->deformation;
  forms.common.strain = true;
  deform::Deformer deformer(*world->deformable, forms);
  deform::DeformedSurface expected(*world->deformable);
  deformer.apply(contacts, expected);
  const deform::DeformedSurface& skin = simulator.skin();
  float deepest = 0.0f;
  for (Index v = 0; v < skin.vertices(); ++v) {
    ASSERT_EQ(skin.positionAt(v), expected.positionAt(v)) << v;
    ASSERT_EQ(skin.normalAt(v), expected.normalAt(v)) << v;
    ASSERT_EQ(skin.strain()[v], expected.strain()[v]) << v;
    deepest = std::min(deepest, skin.positionAt(v).z());
  }
  EXPECT_LT(deepest, -1.0f);
}

TEST(Simulator, TheSkinFollowsMoreFingersThanTheSceneHas) {
  const auto world = sheet(0.5);
  Simulator simulator(world, fingerSettings(world->scene, 20));
  for (const double z : {1.0, -3.0}) {
    for (std::size_t i = 0; i < 20; ++i) simulator.feel(i, Vec3(20.0 + 8.0 * static_cast<double>(i), 100.0, z));
  }
  const deform::DeformedSurface& skin = simulator.skin();
  for (Index v = 0; v < skin.vertices(); ++v) {
    const Vec3f rest = world->deformable->restPosition(v);
    const bool touched = rest.y() == 100.0f && rest.x() >= 20.0f && rest.x() <= 170.0f;
    EXPECT_LT(skin.positionAt(v).z(), touched ? -1.0f : 0.1f) << rest;
  }
}

TEST(Simulator, ALiftedFingerComesBackFromAnywhereWithoutTouchingTheWay) {
  const auto world = sheet(0.5);
  Simulator simulator(world);
  simulator.feel(0, Vec3(103, 101, 1));
  ASSERT_GT(simulator.feel(0, under(3.0)).depth_mm, 2.0);
  simulator.lift(0);
  EXPECT_EQ(simulator.skin().changed().empty(), true);
  EXPECT_EQ(simulator.feel(0, under(5.0)).touch, contact::Touch::free) << "it came from below";
}

TEST(Simulator, AFingerThatIsNotThereFeelsNothing) {
  Simulator simulator(sheet(0.5));
  const contact::FingerOutput felt = simulator.feel(7, under(3.0));
  EXPECT_EQ(felt.force, Vec3::Zero());
  EXPECT_EQ(felt.status, contact::kTipLost);
  simulator.lift(7);
  std::vector<contact::FingerOutput> places(3);
  simulator.feel(std::vector<Vec3>{under(-1.0)}, places);  // more places than tips
}

TEST(Simulator, GoesOnTouchingAWorldWithTheSameBody) {
  const auto world = sheet(0.5);
  Simulator simulator(world);
  simulator.feel(0, Vec3(103, 101, 1));
  simulator.feel(0, under(3.0));
  scene::Scene stiffer = world->scene;
  stiffer.stiffness.constant_n_per_mm = 2.0;
  simulator.change(scene::rebuilt(*world, stiffer));
  double last_n = 1.5;
  for (int tick = 0; tick < 100; ++tick) {
    const double force_n = simulator.feel(0, under(3.0)).force.z();
    EXPECT_LE(force_n - last_n, 1.1 * 0.2) << "2 N/mm and 0.1 mm a tick: no step";
    last_n = force_n;
  }
  EXPECT_NEAR(last_n, 6.0, 1e-9);
  simulator.change(sheet(2.0, {}, 30));
  EXPECT_EQ(simulator.feel(0, under(3.0)).touch, contact::Touch::free) << "another body: it has not come from above";
  EXPECT_EQ(simulator.skin().vertices(), 31u * 31u);
}

TEST(Simulator, RefusesFingersThatDoNotSuitTheWorld) {
  const auto world = sheet(0.5);
  auto fingers = fingerSettings(world->scene, 1);
  fingers[0].mu_static = -1.0;
  EXPECT_THROW(Simulator(world, fingers), Error);
  for (const auto member : {&contact::FingerSettings::radius_mm, &contact::FingerSettings::tick_s,
                            &contact::FingerSettings::stiffness_ratio, &contact::FingerSettings::max_depth_mm}) {
    for (const double value : {1e9, std::numeric_limits<double>::infinity(), std::nan(""), -1.0}) {
      auto wrong = fingerSettings(world->scene, 1);
      wrong[0].*member = value;
      EXPECT_THROW(Simulator(world, wrong), Error) << value;
      EXPECT_THROW(LiveSimulator(world, wrong), Error) << value;
    }
  }
  scene::Scene scene;
  scene.contact.source = scene::ContactSource::hdb;
  const auto boxed = sheet(0.5, scene);
  fingers = fingerSettings(world->scene, 1);
  fingers[0].radius_mm = 8.0;
  EXPECT_THROW(Simulator(boxed, fingers), Error);
  Simulator simulator(world, fingers);
  EXPECT_THROW(simulator.change(boxed), Error);
  EXPECT_EQ(&simulator.world(), world.get());
  EXPECT_THROW(Simulator("no/such/scene.toml"), Error);
}

TEST(Simulator, AWarmTickAllocatesAndLocksNothing) {
  const auto world = sheet(0.5, fingersOf({0.0, 8.0}));
  Simulator simulator(world);
  std::vector<Vec3> tips(2);
  std::vector<contact::FingerOutput> felt(2);
  simulator.skin();
  const auto run = [&] {
    for (int tick = 0; tick < 300; ++tick) {
      for (std::size_t i = 0; i < 2; ++i) tips[i] = pathOf(i, tick);
      simulator.feel(tips, felt);
      if (tick % 16 == 0) simulator.skin();
    }
  };
  run();
  const lab::ThreadCounts before = lab::countsOfThisThread();
  run();
  const lab::ThreadCounts asked = lab::countsSince(before);
  support::expectNone(asked.allocations, "allocations");
  support::expectNone(asked.locks, "locks");
}

}  // namespace
}  // namespace palpate::engine

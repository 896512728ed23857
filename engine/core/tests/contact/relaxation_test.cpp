// Skin that relaxes, judged by closed forms of the standard linear solid and by what a hand puts in and gets back.
#include "palpate/contact/relaxation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/tests/contact/finger_track.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "support/mesh_zoo.h"

namespace palpate::contact {
namespace {

FingerSettings relaxing(double share, double time_s, double share_2 = 0.0, double time_2_s = 1.0) {
  FingerSettings settings;
  settings.relaxation = {share, time_s, share_2, time_2_s};
  return settings;
}

Surface makePlate(const tissue::ForceLaw& law) {
  const mesh::RepairResult fit = mesh::repair(zoo::grid());
  SurfaceOptions options;
  options.force_law = law;
  return buildSurface(fit.mesh, std::vector<double>(fit.mesh.positions.size(), kTestStiffness), options);
}

Vec3 over(double height_mm) { return {50.2, 50.1, height_mm}; }

/// Ticks at this place; the last output.
FingerOutput held(FingerTrack& finger, const Vec3& tip, int ticks) {
  FingerOutput output;
  for (int i = 0; i < ticks; ++i) output = finger.to(tip);
  return output;
}

tissue::ForceLaw lawOf(tissue::ForceLaw::Kind kind) {
  tissue::ForceLaw law;
  law.kind = kind;
  if (kind == tissue::ForceLaw::Kind::table) {
    law.table.rows = 3;
    law.table.depth_mm = {2.0, 6.0, 8.0};
    law.table.effective_mm = {0.2, 4.0, 16.0};
  }
  return law;
}

constexpr std::array kLaws = {tissue::ForceLaw::Kind::linear, tissue::ForceLaw::Kind::power,
                              tissue::ForceLaw::Kind::stiffening, tissue::ForceLaw::Kind::table};

TEST(Relaxation, AHeldPressFallsAsTheExponentialAtAnyRate) {
  for (const double tick_s : {0.0001, 0.001, 0.05, 1.0}) {
    const Surface plate = surfaceOf(zoo::grid());
    FingerSettings settings = relaxing(0.15, 1.0, 0.3, 0.2);
    settings.tick_s = tick_s;
    FingerTrack finger(plate, settings);
    finger.to(over(1));
    for (int tick = 0; tick < 100; ++tick) {
      const double force = finger.to(over(-5)).force.z();
      const double t = tick * tick_s;
      const double share = 1.0 - 0.15 * (1.0 - std::exp(-t)) - 0.3 * (1.0 - std::exp(-t / 0.2));
      EXPECT_NEAR(force, kTestStiffness * 5.0 * share, 1e-12) << tick_s << " s, tick " << tick;
    }
  }
}

TEST(Relaxation, EveryLawFallsByTheSameShare) {
  for (const auto kind : kLaws) {
    const tissue::ForceLaw law = lawOf(kind);
    const Surface plate = makePlate(law);
    FingerTrack finger(plate, relaxing(0.15, 0.1));
    finger.to(over(1));
    const double at_once = finger.to(over(-7)).force.z();
    EXPECT_DOUBLE_EQ(at_once, tissue::normalForce(law, kTestStiffness, 7.0)) << static_cast<int>(kind);
    EXPECT_NEAR(held(finger, over(-7), 2000).force.z(), 0.85 * at_once, 1e-8) << static_cast<int>(kind);
  }
}

TEST(Relaxation, OffFeelsEveryTickToTheBitAndRemembersNothing) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack plain(plate);
  FingerTrack off(plate, relaxing(0.0, 0.01, 0.0, 0.01));
  Random random(7);
  for (int tick = 0; tick < 3000; ++tick) {
    const double t = 0.001 * tick;
    const Vec3 tip(50 + 20 * std::sin(2 * t), 50 + random.uniform(-0.1, 0.1), 5 * std::sin(7 * t));
    const FingerOutput a = plain.to(tip);
    const FingerOutput b = off.to(tip);
    ASSERT_EQ(a.force, b.force) << tick;
    const double depth = std::max(0.0, -tip.z());
    ASSERT_NEAR(a.force.z(), touches(a) ? kTestStiffness * depth : 0.0, 1e-12) << tick;
    ASSERT_EQ(b.rest_mm, 0.0);
    ASSERT_EQ(b.dent.rest_mm, 0.0);
  }
  EXPECT_FALSE(remembers(off.state().memory));
}

TEST(Relaxation, SettingsThatMakeNoSenseAreRefused) {
  EXPECT_NO_THROW(check(relaxing(0.45, 1.0, 0.45, 2.0)));
  for (const FingerSettings& settings : {relaxing(-0.1, 1.0), relaxing(0.5, 1.0, 0.5, 1.0), relaxing(0.1, 0.0),
                                         relaxing(0.1, 1.0, 0.1, -1.0), relaxing(NAN, 1.0), relaxing(0.1, NAN)}) {
    EXPECT_THROW(check(settings), Error);
  }
}

/// What the hand has put in, N mm: the least after any tick and after the last, along a path that starts and ends free.
struct Work {
  double least = 0.0;
  double last = 0.0;
  double most = 0.0;
};

Work measureWork(const Surface& plate, const FingerSettings& settings, int ticks,
                 const std::function<Vec3(double)>& tip_at_s) {
  FingerTrack finger(plate, settings);
  Work work;
  Vec3 tip = tip_at_s(0.0);
  Vec3 force = finger.to(tip).force;
  for (int tick = 1; tick <= ticks; ++tick) {
    const Vec3 next = tip_at_s(settings.tick_s * tick);
    const Vec3 felt = finger.to(next).force;
    work.last -= 0.5 * (force + felt).dot(next - tip);
    work.least = std::min(work.least, work.last);
    work.most = std::max(work.most, work.last);
    tip = next;
    force = felt;
  }
  return work;
}

/// Depths of random pace: at times faster than the skin comes back, at times slower; up at the end.
std::function<double(double)> randomDepth(Random& random, double seconds) {
  const double slow = random.uniform(0.2, 1.0);
  const double fast = random.uniform(2.0, 8.0);
  const double deep = random.uniform(2.0, 8.0);
  const double share = random.uniform(0.0, 0.8);
  const double phase = random.uniform(0.0, 6.28);
  return [=](double t) {
    const double wave = (1.0 - share) * std::sin(6.28 * slow * t) + share * std::sin(6.28 * fast * t + phase);
    return std::min({1.0, 10.0 * t, 10.0 * (seconds - t)}) * deep * (0.5 + wave);
  };
}

TEST(Relaxation, ReturnsNoMoreThanTheHandPutInHoweverItIsPressed) {
  Random random(20261122);
  double clipped_lost = 0.0;
  for (const auto kind : kLaws) {
    const Surface plate = makePlate(lawOf(kind));
    for (int path = 0; path < 60; ++path) {
      const bool two = path % 2 == 1;
      const double share = random.uniform(0.05, two ? 0.45 : 0.9);
      FingerSettings settings =
          relaxing(share, std::exp(random.uniform(-4.0, 1.0)), two ? share : 0.0, std::exp(random.uniform(-4.0, 1.0)));
      settings.tick_s = 0.0002;  // fine, so that what sampling itself gives is small
      const auto depth = randomDepth(random, 3.0);
      const auto straight = [&](double t) { return over(0.5 - depth(t)); };
      const Work work = measureWork(plate, settings, 15000, straight);
      EXPECT_GE(work.least, -2e-5 * work.most) << static_cast<int>(kind) << " " << path << " " << work.most;
      EXPECT_GE(work.last, 1e-3 * work.most) << "what relaxes is lost: " << static_cast<int>(kind) << " " << path;
      clipped_lost = std::max(clipped_lost, work.last / work.most);
    }
  }
  EXPECT_GT(clipped_lost, 0.3) << "some paths must leave the skin behind";
}

TEST(Relaxation, SlidingWithoutFrictionGivesNothingEither) {
  const Surface plate = surfaceOf(zoo::grid());
  Random random(5);
  for (int path = 0; path < 20; ++path) {
    FingerSettings settings = relaxing(0.6, 0.2, 0.2, 1.0);
    settings.mu_static = settings.mu_dynamic = 0.0;
    settings.tick_s = 0.0005;
    const auto depth = randomDepth(random, 3.0);
    const double speed = random.uniform(0.0, 6.0);
    const auto sliding = [&](double t) {
      return Vec3(50 + 30 * std::sin(speed * t), 50 + 20 * std::cos(1.7 * speed * t), 0.5 - depth(t));
    };
    const Work work = measureWork(plate, settings, 6000, sliding);
    EXPECT_GE(work.least, -1e-4 * work.most) << path;
  }
}

TEST(Relaxation, AFingerFasterThanTheSkinIsLetGoAtTheRestDepth) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate, relaxing(0.4, 0.5));
  finger.to(over(1));
  const FingerOutput deep = held(finger, over(-5), 5000);
  EXPECT_NEAR(deep.rest_mm, 2.0, 1e-3);
  double least = 0.0;
  for (double z = -5.0; z < 0.0; z += 0.05) {
    const FingerOutput output = finger.to(over(z));
    least = std::min(least, output.force.z());
    EXPECT_EQ(output.force.z() > 0.0, -z > output.rest_mm) << z;
    EXPECT_TRUE(touches(output));
  }
  EXPECT_EQ(least, 0.0) << "it never pulls";
}

TEST(Relaxation, SkinUnderAFingerThatPressesNothingComesBackAsFreeSkinDoes) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate, relaxing(0.4, 0.5));
  finger.to(over(1));
  held(finger, over(-5), 5000);
  for (double z = -5.0; z < -0.5; z += 0.1) finger.to(over(z));
  const double left = finger.to(over(-0.5)).rest_mm;
  ASSERT_GT(left, 1.5);
  for (int tick = 1; tick < 800; ++tick) {
    const FingerOutput output = finger.to(over(-0.5));
    EXPECT_NEAR(output.rest_mm, left * std::exp(-0.6 * 0.001 * tick / 0.5), 5e-3) << tick;
    EXPECT_EQ(output.force.norm(), 0.0);
  }
  EXPECT_GT(held(finger, over(-0.5), 2000).force.z(), 0.1) << "until it has reached the finger";
}

TEST(Relaxation, FrictionIsExactWhileTheForceFalls) {
  for (const double tick_s : {0.001, 0.01}) {
    const Surface plate = surfaceOf(zoo::grid());
    FingerSettings settings = relaxing(0.5, 0.05, 0.3, 1.0);
    settings.tick_s = tick_s;
    settings.catch_up_mm_per_s = 0.0;  // no step but the finger's own is allowed for
    // Not a FingerTrack: a force may fall here while nothing moves.
    FingerState state;
    step(plate, settings, state, over(2));
    for (double z = 2; z > -5; z -= 0.5) step(plate, settings, state, over(z));
    int slipping = 0;
    for (int tick = 0; tick < 400; ++tick) {
      const bool still = tick % 40 > 30;
      const double x = 50.2 + (still ? 0.0 : 0.05 * tick);
      const FingerOutput output = step(plate, settings, state, {still ? state.tip.x() : x, 50.1, -5});
      EXPECT_LE(frictionRatio(output), 0.46 + 1e-9) << tick;
      if (tick > 80) {
        EXPECT_NEAR(frictionRatio(output), 0.44, 1e-6) << "also where it stands still: " << tick;
      }
      if (output.touch != Touch::slip) continue;
      EXPECT_NEAR(frictionRatio(output), 0.44, 1e-9) << tick;
      ++slipping;
    }
    EXPECT_GT(slipping, 150);
    EXPECT_LT(state.force.norm(), 0.5 * std::hypot(1.0, 0.44) * kTestStiffness * 5.0);
  }
}

TEST(Relaxation, ADentComesBackWhereItWasAndIsForgotten) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate, relaxing(0.2, 0.1));
  finger.to(over(1));
  held(finger, over(-6), 2000);
  const FingerOutput left = finger.to(over(3));
  ASSERT_FALSE(touches(left));
  EXPECT_NEAR((left.dent.place - Vec3(50.2, 50.1, 0)).norm(), 0.0, 1e-9);
  EXPECT_LT(left.dent.triangle, plate.geometry->tree.source_triangle.size());
  for (int tick = 1; tick < 500; ++tick) {
    const FingerOutput output = finger.to({10, 10, 20});
    // Free skin: x' = (g x - x) / t.
    EXPECT_NEAR(output.dent.rest_mm, 1.2 * std::exp(-0.8 * 0.001 * (tick + 1) / 0.1), 5e-3) << tick;
    EXPECT_EQ(output.dent.place, left.dent.place);
    EXPECT_EQ(output.rest_mm, 0.0);
  }
  const FingerOutput rested = held(finger, over(20), 3000);
  EXPECT_EQ(rested.dent.rest_mm, 0.0);
  EXPECT_EQ(rested.dent.triangle, kNoIndex);
  EXPECT_FALSE(remembers(finger.state().memory));
}

TEST(Relaxation, TheFingerComesBackIntoItsDentAndFindsFreshSkinBesideIt) {
  const Surface plate = surfaceOf(zoo::grid());
  const auto pressed_at = [&](double x, bool after_a_press) {
    FingerTrack finger(plate, relaxing(0.3, 2.0));
    finger.to(over(1));
    if (after_a_press) held(finger, over(-6), 5000);
    finger.to(over(1));
    finger.to({x, 50.1, 1});
    return finger.to({x, 50.1, -4}).force.z();
  };
  const double fresh = pressed_at(50.2, false);
  EXPECT_NEAR(fresh, kTestStiffness * 4.0, 1e-12);
  EXPECT_NEAR(pressed_at(50.2, true), kTestStiffness * (4.0 - 0.3 * 6.0 * (1.0 - std::exp(-2.5))), 0.01);
  EXPECT_NEAR(pressed_at(56.7, true), fresh - 0.5 * (fresh - pressed_at(50.2, true)), 0.01) << "half a reach away";
  EXPECT_EQ(pressed_at(50.2 + kDentReachMm, true), fresh);
  EXPECT_EQ(pressed_at(75.0, true), fresh);
}

TEST(Relaxation, AnOldDentGoesOnComingBackWhileTheFingerIsElsewhere) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate, relaxing(0.3, 0.2));
  finger.to(over(1));
  held(finger, over(-6), 2000);
  finger.to(over(1));
  finger.to({20, 20, 1});
  const FingerOutput elsewhere = finger.to({20, 20, -2});
  EXPECT_NEAR((elsewhere.dent.place - Vec3(50.2, 50.1, 0)).norm(), 0.0, 1e-9);
  EXPECT_GT(elsewhere.dent.rest_mm, 1.0);
  EXPECT_LT(held(finger, {20, 20, -2}, 300).dent.rest_mm, 0.5 * elsewhere.dent.rest_mm);
}

TEST(Relaxation, SwitchedOffInMidPressFeelsTheInstantLawAndForgets) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerState state;
  FingerSettings settings = relaxing(0.3, 0.1);
  step(plate, settings, state, over(1));
  for (int tick = 0; tick < 1000; ++tick) step(plate, settings, state, over(-5));
  settings.relaxation = {};
  EXPECT_DOUBLE_EQ(step(plate, settings, state, over(-5)).force.z(), kTestStiffness * 5.0);
  EXPECT_FALSE(remembers(state.memory));
}

TEST(Relaxation, WithASphereAndForceShadingIsThatOfTheInstantForce) {
  for (const double radius : {0.0, 8.0}) {
    const Surface plate = surfaceOf(zoo::grid());
    FingerSettings settings = relaxing(0.15, 0.5);
    settings.radius_mm = radius;
    settings.force_shading = radius == 0.0;
    FingerTrack finger(plate, settings);
    finger.to(over(radius + 1));
    const double at_once = finger.to(over(radius - 5)).force.z();
    EXPECT_NEAR(at_once, kTestStiffness * 5.0, 1e-6) << radius;
    EXPECT_NEAR(held(finger, over(radius - 5), 501).force.z(), at_once * (1.0 - 0.15 * (1.0 - std::exp(-1.002))), 1e-5)
        << radius;
  }
}

}  // namespace
}  // namespace palpate::contact

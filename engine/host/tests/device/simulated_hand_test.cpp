// The mechanics of a simulated hand: friction that stops and sticks, and energy that is neither made nor lost.
#include "palpate/device/simulated_hand.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::device {
namespace {

/// Nobody holds it.
SimulatedHandSettings released() {
  SimulatedHandSettings settings;
  settings.device = profileOf(scene::DeviceModel::touch_x);
  settings.hand = handModel(HandKind::released);
  return settings;
}

TEST(SimulatedHand, WhatTheMotorGivesIsSwallowedOrMoves) {
  for (const bool shared : {false, true}) {
    SimulatedHandSettings settings = released();
    settings.shared_friction = shared;
    SimulatedHand hand(settings);
    for (int tick = 0; tick < 400; ++tick) {
      const double angle = 0.02 * tick;
      hand.writeForce({2.0 * std::cos(angle), 1.5 * std::sin(angle), 0.5});
    }
    const PortEnergy energy = hand.energy();
    EXPECT_GT(energy.motor, 10.0);
    EXPECT_GT(energy.friction, 0.2 * energy.motor);
    EXPECT_NEAR(energy.given(), 0.0, 0.02 * energy.motor) << shared;
  }
}

TEST(SimulatedHand, SharedFrictionStopsAThrowAsItsForceOnItsMassDoes) {
  SimulatedHandSettings settings = released();
  settings.shared_friction = true;
  settings.device.damping_n_s_per_mm = 0.0;
  const double slowing_mm_s2 = 1000.0 * settings.device.friction_n / settings.device.mass_kg;
  const Vec3 velocity(60.0, 80.0, 0.0);
  SimulatedHand hand(settings);
  hand.setVelocity(velocity);
  for (int tick = 0; tick < 500; ++tick) hand.writeForce(Vec3::Zero());
  EXPECT_EQ(hand.velocity(), Vec3::Zero()) << "it sticks";
  const Vec3 way = velocity.normalized() * velocity.squaredNorm() / (2.0 * slowing_mm_s2);
  EXPECT_LT((hand.place() - way).norm(), 0.05 * way.norm()) << "straight ahead";
}

}  // namespace
}  // namespace palpate::device

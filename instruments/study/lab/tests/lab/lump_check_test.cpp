// The judge of lumps: silent on what the engine does, and not on lumps that fail in known ways.
#include "lab/judges/lump_check.h"

#include <gtest/gtest.h>

#include "palpate/base/random.h"
#include "palpate/contact/finger.h"
#include "palpate/contact/surface.h"
#include "support/lump_field.h"
#include "support/mesh_zoo.h"

namespace palpate::lab {
namespace {

class JudgedLumps : public ::testing::Test {
 protected:
  JudgedLumps() {
    contact::Lump mobile = test::inventedLump({50, 50, 0});
    mobile.mobility.spring_n_per_mm = 0.05;
    mobile.mobility.friction_n = 0.01;
    plate_.lumps =
        std::make_shared<const contact::Lumps>(contact::Lumps{.all = {mobile, test::inventedLump({70, 50, 0})}});
  }
  /// A finger that wanders over the lumps; `spoil` may break what it felt and where the lumps are.
  template <class Spoil>
  HuntReport runCheck(const Spoil& spoil) {
    LumpCheck check(*plate_.lumps, settings_, 1);
    contact::FingerState state;
    contact::LumpPlaces places;
    Random random(4);
    Vec3 tip(46, 48, 1);
    for (int tick = 0; tick < 800; ++tick) {
      const contact::LumpPlaces before = places;
      contact::moveLumps(*plate_.lumps, {&state.lumps, 1}, settings_.tick_s, places);
      tip += 0.01 * (Vec3(52, 50, -5) - tip) + 0.05 * random.uniform3(-1.0, 1.0);
      contact::FingerOutput felt;
      if (tick == 400) {
        spoil(places, felt);
        const contact::FingerOutput change = felt;
        check.moved(before, places, {&state.lumps, 1});
        felt = contact::step(plate_, settings_, state, tip, &places);
        felt.lump_force += change.lump_force;
      } else {
        check.moved(before, places, {&state.lumps, 1});
        felt = contact::step(plate_, settings_, state, tip, &places);
      }
      check.add(0, state.lumps, places, felt);
    }
    HuntReport report;
    check.addTo(report);
    return report;
  }

  contact::Surface plate_ = contact::buildSurface(zoo::grid(), std::vector<double>(zoo::grid().positions.size(), 0.5));
  contact::FingerSettings settings_;
};

TEST_F(JudgedLumps, AreSilentAsTheyAre) {
  EXPECT_TRUE(runCheck([](contact::LumpPlaces&, contact::FingerOutput&) {}).clean());
}

TEST_F(JudgedLumps, AForceThatIsNotTheSlopeOfTheEnergyIsFound) {
  const HuntReport report =
      runCheck([](contact::LumpPlaces&, contact::FingerOutput& felt) { felt.lump_force.x() = 0.01; });
  EXPECT_EQ(report.of(Fault::lump_force).ticks, 1u);
  EXPECT_EQ(report.of(Fault::lump_force).first_tick, 400u);
}

TEST_F(JudgedLumps, AForceThatJumpsIsFound) {
  const HuntReport report =
      runCheck([](contact::LumpPlaces&, contact::FingerOutput& felt) { felt.lump_force.z() = 30.0; });
  EXPECT_EQ(report.of(Fault::lump_step).ticks, 2u) << "there and back";
}

TEST_F(JudgedLumps, ALumpThatLeapsOrClimbsIsFound) {
  const HuntReport leapt =
      runCheck([](contact::LumpPlaces& places, contact::FingerOutput&) { places.moved_mm[0].x() += 0.6; });
  EXPECT_GE(leapt.of(Fault::lump_moved).ticks, 1u);
  const HuntReport fixed =
      runCheck([](contact::LumpPlaces& places, contact::FingerOutput&) { places.moved_mm[1].x() += 0.01; });
  EXPECT_GE(fixed.of(Fault::lump_moved).ticks, 1u);
  std::size_t climbs = 0;  // to one side or the other
  for (const double aside : {-0.3, 0.3}) {
    climbs +=
        runCheck([aside](contact::LumpPlaces& places, contact::FingerOutput&) { places.moved_mm[0].x() += aside; })
            .of(Fault::lump_moved)
            .ticks;
  }
  EXPECT_GE(climbs, 1u);
}

}  // namespace
}  // namespace palpate::lab

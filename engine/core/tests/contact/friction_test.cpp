#include "palpate/contact/friction.h"

#include <cmath>

#include "core/tests/contact/finger_track.h"
#include "palpate/contact/felt_force.h"
#include "support/golden.h"
#include "support/mesh_zoo.h"

namespace palpate::contact {

TEST(Friction, TheAnchorOfAForceIsTheGoldenFiles) {  // (2.6), E1
  for (const auto& c : test::goldenRows("friction_anchor", "cases")) {
    const Vec3 anchor = anchorOfForce(test::vec3(c["P"]), test::vec3(c["D"]), test::vec3(c["n"]), test::vec3(c["F"]));
    EXPECT_LT((anchor - test::vec3(c["expected_A"])).norm(), 1e-9) << c;
  }
}

TEST(Friction, HeldAtTheGoldenFilesAnchorsAFingerFeelsItsForces) {
  FingerSettings settings;
  settings.mu_static = settings.mu_dynamic = 1e9;  // the file's forces know no slip
  int pressing = 0;
  for (const auto& c : test::goldenRows("friction_anchor", "cases")) {
    const Vec3 proxy = test::vec3(c["P"]), tip = test::vec3(c["D"]), normal = test::vec3(c["n"]);
    const Vec3 force = test::vec3(c["F"]);
    const double depth = (proxy - tip).dot(normal);
    const double normal_force = force.dot(normal);
    if (!(depth > 0.0) || !(normal_force > 0.0)) continue;  // without contact there is no anchor to be held at
    const Surface plate = surfaceOf(zoo::oneTriangle(), normal_force / depth);
    FingerState state;
    state.proxy = {plate.geometry->tree.records[0].corners[0], 0, tree::Feature::face};
    state.anchor = {test::vec3(c["expected_A"]), 0, tree::Feature::face};
    state.hold = state.anchor.position;
    const Press press{true, proxy, normal, depth, depth, 0};
    const double far_mm = 1000.0;  // as if the tip had come from there: the force may be anything
    const FingerOutput output = feltOutput(plate, settings, press, tip, far_mm, state);
    EXPECT_EQ(output.touch, Touch::stick) << c;
    EXPECT_NEAR((output.force - force).norm(), 0, 1e-9) << c;
    ++pressing;
  }
  EXPECT_EQ(pressing, 5);
}

TEST(Friction, TheFingersOwnForceLeadsBackToItsAnchor) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate);
  finger.to({50, 50, 5});
  finger.to({50, 50, -5});
  const FingerOutput output = finger.slide({51, 50.5, -5}, 0.1);
  const Vec3 anchor = anchorOfForce(output.proxy, output.tip, output.normal, output.force);
  EXPECT_NEAR((anchor - output.anchor).norm(), 0, 1e-9);
}

TEST(Friction, SticksThenSlipsAtItsTwoCoefficients) {
  const Surface plate = surfaceOf(zoo::grid());
  for (const double radius : {0.0, 5.0}) {
    for (const double step : {0.02, 0.05, 0.1, 0.2, 0.5}) {
      FingerTrack finger(plate, sphereSettings(radius));
      const double highest = highestRatioOfADrag(finger, radius, step);
      EXPECT_LE(highest, 0.46 + 1e-9);
      if (step <= 0.02) {
        EXPECT_GE(highest, 0.455);
      }
    }
  }
}

TEST(Friction, HoldsTheAnchorWhileSticking) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate);
  finger.to({50, 50, 5});
  const Vec3 anchor = finger.to({50, 50, -5}).anchor;
  for (int i = 0; i < 100; ++i) {
    const FingerOutput output = finger.to({50 + 2 * std::sin(0.1 * i), 50 + 0.5 * std::cos(0.1 * i), -5});
    ASSERT_EQ(output.touch, Touch::stick);
    EXPECT_EQ(output.anchor, anchor);
    EXPECT_NEAR(output.force.x(), kTestStiffness * (anchor.x() - output.tip.x()), 1e-9) << "k_t (A - P)";
  }
}

/// One law of every kind.
std::vector<tissue::ForceLaw> everyLaw() {
  std::vector<tissue::ForceLaw> laws(4);
  laws[1].kind = tissue::ForceLaw::Kind::power;
  laws[2].kind = tissue::ForceLaw::Kind::stiffening;
  laws[3].kind = tissue::ForceLaw::Kind::table;
  laws[3].table.rows = 2;
  laws[3].table.depth_mm = {3.0, 8.0};
  laws[3].table.effective_mm = {1.0, 9.0};
  return laws;
}

TEST(Friction, ItsCoefficientsHoldUnderEveryForceLawAtAnySpeed) {
  Surface plate = surfaceOf(zoo::grid());
  for (const tissue::ForceLaw& law : everyLaw()) {
    plate.force_law = law;
    for (const double radius : {0.0, 5.0}) {
      for (const double step : {0.02, 0.1, 0.5}) {
        FingerTrack finger(plate, sphereSettings(radius));
        finger.to({30, 50.3, radius + 2});
        finger.slide({30, 50.3, -5}, 0.05);
        double highest = 0.0;
        for (double x = 30 + step; x <= 60; x += step) {
          const FingerOutput output = finger.to({x, 50.3, -5 + 2 * std::sin(x)});  // pressing and easing
          highest = std::max(highest, frictionRatio(output));
          if (output.touch == Touch::slip) {
            ASSERT_NEAR(frictionRatio(output), 0.44, 1e-9) << static_cast<int>(law.kind) << " step " << step;
          }
        }
        EXPECT_LE(highest, 0.46 + 1e-9);
        EXPECT_GE(highest, 0.44 - 1e-9);
      }
    }
  }
}

TEST(Friction, TheForceLeadsBackToTheAnchorUnderEveryForceLaw) {
  Surface plate = surfaceOf(zoo::grid());
  for (const tissue::ForceLaw& law : everyLaw()) {
    plate.force_law = law;
    FingerTrack finger(plate);
    finger.to({50, 50, 5});
    finger.to({50, 50, -5});
    const FingerOutput output = finger.slide({51, 50.5, -6}, 0.1);
    EXPECT_EQ(output.touch, Touch::stick);
    const Vec3 anchor = anchorOfForce(output.proxy, output.tip, output.normal, output.force);
    EXPECT_NEAR((anchor - output.anchor).norm(), 0, 1e-9) << static_cast<int>(law.kind);
    EXPECT_NEAR(output.force.z(), normalForce(law, kTestStiffness, 6.0), 1e-9);
  }
}

TEST(Friction, ASofterTangentialSpringFollowsFarther) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerSettings soft;
  soft.stiffness_ratio = 0.23;
  FingerTrack finger(plate, soft);
  finger.to({30, 50, 5});
  finger.slide({30, 50, -10}, 0.5);
  const FingerOutput output = finger.slide({70, 50, -10}, 0.2);
  EXPECT_EQ(output.touch, Touch::slip);
  EXPECT_NEAR(frictionRatio(output), 0.44, 1e-9);
  EXPECT_NEAR((output.proxy - output.anchor).norm(), 0.44 * 10 / 0.23, 1e-6) << "19 mm at 10 mm depth (E2)";
  const Vec3 derived = anchorOfForce(output.proxy, output.tip, output.normal, output.force, soft.stiffness_ratio);
  EXPECT_NEAR((derived - output.anchor).norm(), 0, 1e-6);
}

TEST(Friction, NoneWithoutCoefficients) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerSettings slick;
  slick.mu_static = slick.mu_dynamic = 0.0;
  FingerTrack finger(plate, slick);
  finger.to({30, 50, 5});
  finger.slide({30, 50, -5}, 0.5);
  const FingerOutput output = finger.slide({60, 55, -5}, 0.3);
  EXPECT_NEAR((output.force - Vec3(0, 0, 2.5)).norm(), 0, 1e-12);
  EXPECT_NEAR((output.anchor - output.proxy).norm(), 0, 1e-12);
}

TEST(Friction, StretchesThePullToTheWholeOffset) {
  // The anchor on the far slope of a bump: its tangential share alone would hide most of the displacement.
  const Grip grip = gripOf({0, 0, 0}, Vec3::UnitZ(), {3, 0, -4}, {10.0, 10.0}, false);
  EXPECT_NEAR((grip.pull - Vec3(5, 0, 0)).norm(), 0, 1e-12);
  EXPECT_FALSE(grip.slipping);
  EXPECT_EQ(gripOf({0, 0, 0}, Vec3::UnitZ(), {0, 0, -4}, {10.0, 10.0}, false).pull, Vec3(0, 0, 0));
  // Of an offset along the normal nothing is tangential but rounding, which must not give the pull its direction.
  EXPECT_LT(gripOf({0, 0, 0}, Vec3::UnitZ(), {1e-9, 0, -4}, {10.0, 10.0}, false).pull.norm(), 1e-8);
}

TEST(Friction, HoldsAPointInSpaceAlsoWhereItIsOffTheSkin) {
  const Surface surface = surfaceOf(zoo::wavyGrid(24, 100.0, 6.0));
  FingerTrack finger(surface);
  finger.to({20, 50, 12});
  finger.slide({20, 50, -4}, 0.1);
  double farthest_off_mm = 0.0;
  for (double x = 20.0; x <= 32.0; x += 0.1) {
    const FingerOutput output = finger.to({x, 48.5, -4});
    const Vec3 held = finger.state().hold - output.proxy;
    if (output.touch == Touch::slip) {
      EXPECT_NEAR(held.dot(output.normal), 0.0, 1e-9) << x;
    }
    farthest_off_mm = std::max(farthest_off_mm, (finger.state().hold - output.anchor).norm());
  }
  EXPECT_GT(farthest_off_mm, 0.1);
}

TEST(Friction, FromSlipToStickThePullDoesNotJump) {
  // Over a coarse egg-crate the skin next to where the pull ends is often elsewhere; FingerTrack asks for the step.
  mesh::TriangleMesh bumps = zoo::wavyGrid(24, 100.0, 6.0);
  for (const double step_mm : {0.02, 0.1, 0.5}) {
    const Surface surface = surfaceOf(bumps);
    FingerTrack finger(surface);
    finger.to({20, 50, 12});
    finger.slide({20, 50, -4}, step_mm);
    for (int lap = 0; lap < 3; ++lap) {
      finger.slide({30, 47.0 + lap, -4}, step_mm);
      finger.slide({28, 50, -5}, step_mm);
      finger.slide({32, 52, -3}, step_mm);
      finger.slide({20, 50, -4}, step_mm);
    }
  }
}

}  // namespace palpate::contact

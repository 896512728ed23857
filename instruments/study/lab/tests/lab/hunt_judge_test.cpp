// The judge of the hunt is fed with fingers that are made to fail in known ways, and with one that does not.
#include "lab/judges/hunt_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/hunt/hunt_world.h"
#include "lab/workloads/heldout_meshes.h"
#include "lab/workloads/workload_meshes.h"

namespace palpate::lab {
namespace {

constexpr double kStiffness = 0.5;

contact::FingerOutput freeOutputAt(const Vec3& tip) {
  contact::FingerOutput o;
  o.tip = o.proxy = o.anchor = o.hold = tip;
  return o;
}

/// On a plate that is 100 x 100 mm and 30 mm thick, felt on its top at z = 30.
class HuntJudgement : public testing::Test {
 protected:
  static constexpr double kTop = 30.0;

  /// What a right finger says of a tip at that depth below the top.
  contact::FingerOutput pressed(double depth, double x = 51.0) {
    contact::FingerOutput o = freeOutputAt({x, 47.0, kTop - depth});
    o.proxy = o.anchor = o.hold = {x, 47.0, kTop};
    o.normal = Vec3::UnitZ();
    o.depth_mm = depth;
    o.force = kStiffness * depth * Vec3::UnitZ();
    o.touch = contact::Touch::stick;
    o.triangle = o.anchor_triangle = plate.nearest(o.proxy).triangle;
    return o;
  }
  /// A right sphere of 5 mm: its centre 5 mm over the top, pressed down by that much.
  contact::FingerOutput pressedSphere(double depth) {
    contact::FingerOutput o = pressed(depth);
    o.tip.z() += 5.0;
    return o;
  }
  static contact::FingerOutput above(double height) { return freeOutputAt({51.0, 47.0, kTop + height}); }

  HuntReport judged(const std::vector<contact::FingerOutput>& outputs, double radius = 0.0) {
    contact::FingerSettings finger;
    finger.radius_mm = radius;
    HuntOracle judge(plate, finger, kStiffness);
    for (const contact::FingerOutput& o : outputs) judge.add(o);
    return judge.report();
  }
  static std::size_t faultTicks(const HuntReport& report, Fault fault) { return report.of(fault).ticks; }

  OracleBody plate{plateMesh(100, kTop, 12), false};
};

TEST_F(HuntJudgement, ARightFingerIsRight) {
  EXPECT_TRUE(plate.closed());
  const HuntReport point =
      judged({above(1), above(0.2), pressed(0.3), pressed(0.9), pressed(0.4), above(0.1), above(2)});
  EXPECT_TRUE(point.clean()) << point.of(Fault::step).measured;
  EXPECT_EQ(point.ticks, 7u);
  EXPECT_EQ(point.touching_ticks, 3u);
  EXPECT_TRUE(judged({above(9), above(5.2), pressedSphere(0.1), pressedSphere(3), above(5.1)}, 5.0).clean());
}

TEST_F(HuntJudgement, AFreeTipInsideIsAFallFromItsFirstTickOn) {
  const HuntReport report = judged({above(1), pressed(2), pressed(3), freeOutputAt({51, 47, 26}),
                                    freeOutputAt({51, 47, 25}), freeOutputAt({51, 47, 15}), above(1), above(2)});
  EXPECT_EQ(faultTicks(report, Fault::fall), 3u);
  EXPECT_EQ(report.of(Fault::fall).first_tick, 3u);
  EXPECT_DOUBLE_EQ(report.of(Fault::fall).measured, 4.0);
  EXPECT_EQ(faultTicks(report, Fault::missed_contact), 0u) << "it was held";
}

TEST_F(HuntJudgement, ATipThatComesInUnfeltIsAMissedContactAndAFall) {
  const HuntReport report = judged({above(1), freeOutputAt({51, 47, 29}), freeOutputAt({51, 47, 28})});
  EXPECT_EQ(faultTicks(report, Fault::missed_contact), 1u);
  EXPECT_EQ(faultTicks(report, Fault::fall), 2u);
  contact::FingerOutput unfelt = pressed(1);
  unfelt.force.setZero();
  EXPECT_EQ(faultTicks(judged({above(1), unfelt}), Fault::missed_contact), 1u) << "touching, but without a force";
}

TEST_F(HuntJudgement, ATipThatBeginsInsideIsLetBeUntilItWasOutside) {
  const std::vector<contact::FingerOutput> inside{freeOutputAt({51, 47, 20}), freeOutputAt({51, 47, 25}), above(1)};
  EXPECT_TRUE(judged(inside).clean());
  std::vector<contact::FingerOutput> again = inside;
  again.push_back(freeOutputAt({51, 47, 29}));
  EXPECT_EQ(faultTicks(judged(again), Fault::fall), 1u);
}

TEST_F(HuntJudgement, ATipThatWentRightThroughIsOutsideAgain) {
  EXPECT_TRUE(judged({above(1), pressed(2), freeOutputAt({51, 47, -1})}).of(Fault::fall).ticks == 0);
}

/// A finger whose proxy is at the plate's upper rim, with its tip at `tip`.
TEST_F(HuntJudgement, AForceInFreeAirWithNothingBetweenIsAFault) {
  const auto held = [&](const Vec3& tip) {
    contact::FingerOutput o = pressed(1);
    o.tip = tip;
    o.proxy = o.anchor = o.hold = {100, 47, kTop};
    o.depth_mm = (o.proxy - tip).norm();
    o.normal = (o.proxy - tip) / o.depth_mm;
    o.force = kStiffness * o.depth_mm * o.normal;
    o.triangle = plate.nearest(o.proxy).triangle;
    return o;
  };
  const HuntReport in_air = judged({above(1), pressed(1), held({103, 47, 26})});
  EXPECT_EQ(faultTicks(in_air, Fault::held_in_air), 1u);
  EXPECT_EQ(in_air.held_through_ticks, 0u);
  EXPECT_EQ(faultTicks(judged({above(1), pressed(1), held({97, 47, 26})}), Fault::held_in_air), 0u) << "inside";
  EXPECT_EQ(faultTicks(judged({above(9), held({103, 47, 26})}, 5.0), Fault::held_in_air), 0u)
      << "a sphere is not clear";
  contact::FingerOutput fading = held({103, 47, 26});
  fading.status = contact::kCatchingUp | contact::kLettingGo;
  EXPECT_EQ(faultTicks(judged({above(1), pressed(1), fading}), Fault::held_in_air), 0u);
  const HuntReport through = judged({above(1), pressed(1), held({95, 47, -3})});
  EXPECT_EQ(faultTicks(through, Fault::held_in_air), 0u);
  EXPECT_EQ(through.held_through_ticks, 1u) << "behind the plate";
}

TEST_F(HuntJudgement, AFreeSphereMayNotOverlapTheSkin) {
  EXPECT_EQ(faultTicks(judged({above(9), above(4.9)}, 5.0), Fault::missed_contact), 1u);
  EXPECT_TRUE(judged({above(9), above(4.9999)}, 5.0).clean()) << "less than a thousandth of the radius";
}

TEST_F(HuntJudgement, ForcesThatAreNotFinitePullOrLeaveTheConeAreWrong) {
  contact::FingerOutput endless = pressed(1), pulling = pressed(1), dragging = pressed(1);
  endless.force.x() = std::numeric_limits<double>::quiet_NaN();
  pulling.force = -pulling.force;
  dragging.force.x() = 0.461 * dragging.force.z();
  for (const auto& wrong : {endless, pulling, dragging})
    EXPECT_EQ(faultTicks(judged({above(1), wrong}), Fault::wrong_force), 1u);
  dragging.force.x() = 0.4599 * dragging.force.z();
  EXPECT_EQ(faultTicks(judged({above(1), dragging}), Fault::wrong_force), 0u);
}

TEST_F(HuntJudgement, AForceIntoTheSkinIsWrongWhateverNormalTheFingerClaims) {
  contact::FingerOutput turned = pressed(1);
  turned.normal = -turned.normal;
  turned.force = -turned.force;
  EXPECT_EQ(faultTicks(judged({above(1), turned}), Fault::wrong_force), 1u);
  turned.status = contact::kCatchingUp;
  EXPECT_EQ(faultTicks(judged({above(1), turned}), Fault::wrong_force), 0u) << "on its way";
}

TEST_F(HuntJudgement, AProxyOffTheSkinAndASunkenSphereAreWrong) {
  contact::FingerOutput off = pressed(1);
  off.proxy.z() += 1e-5;
  EXPECT_EQ(faultTicks(judged({above(1), off}), Fault::wrong_force), 1u);
  contact::FingerOutput sunk = pressedSphere(1);
  sunk.proxy.z() -= 0.06;
  EXPECT_EQ(faultTicks(judged({above(9), sunk}, 5.0), Fault::wrong_force), 1u);
  sunk.status = contact::kStartedInside;
  EXPECT_EQ(faultTicks(judged({above(9), sunk}, 5.0), Fault::wrong_force), 0u);
  contact::FingerOutput swallowed = pressedSphere(1);
  swallowed.proxy.z() -= 15.0;
  EXPECT_EQ(faultTicks(judged({above(9), swallowed}, 5.0), Fault::wrong_force), 1u);
}

TEST_F(HuntJudgement, AForceStepIsHeldToTheTipsMotion) {
  contact::FingerOutput jumped = pressed(2.0), dragged = pressed(2.001);
  dragged.force.x() = 0.06;  // the bound is 1.1 * 0.5 N/mm * (3 * 0.001 + 0.1) mm
  const HuntReport report = judged({above(1), jumped, dragged});
  EXPECT_EQ(faultTicks(report, Fault::step), 1u);
  EXPECT_EQ(report.of(Fault::step).first_tick, 2u);
  EXPECT_NEAR(report.of(Fault::step).bound, 1.1 * 0.5 * 0.103, 1e-9);
  dragged.status = contact::kTipLost;
  const HuntReport event = judged({above(1), jumped, dragged});
  EXPECT_EQ(faultTicks(event, Fault::step), 0u);
  EXPECT_EQ(event.events, 1u);
}

TEST(HuntJudgementOfSheets, WhatComesThroughTheSkinIsMissedAndWhatComesRoundItIsNot) {
  OracleBody sheet(flatMesh(), false);
  contact::FingerSettings finger;
  const auto missed = [&](const std::vector<Vec3>& tips) {
    HuntOracle judge(sheet, finger, kStiffness);
    for (const Vec3& tip : tips) judge.add(freeOutputAt(tip));
    return judge.report().of(Fault::missed_contact).ticks;
  };
  EXPECT_EQ(missed({{50, 50, 1}, {50, 50, -1}}), 1u);
  EXPECT_EQ(missed({{50, 50, -1}, {50, 50, 1}}), 0u) << "from behind";
  EXPECT_EQ(missed({{90, 50, 1}, {120, 50, 1}, {120, 50, -1}, {50, 50, -1}}), 0u) << "round the border";
}

TEST(HuntJudgementOfTornBodies, WhatIsLetGoInsideFarFromTheHoleHasFallenAndWhatComesThroughItHasNot) {
  mesh::TriangleMesh torn = bumpyBallMesh(60, 0, 0, 4);
  const auto up = std::max_element(torn.triangles.begin(), torn.triangles.end(), [&](const auto& a, const auto& b) {
    return mesh::centreOf(torn, a).z() < mesh::centreOf(torn, b).z();
  });
  const Vec3 hole = mesh::centreOf(torn, *up);
  torn.triangles.erase(up);
  OracleBody ball(torn, false);
  ASSERT_FALSE(ball.closed());
  const auto falls = [&](const std::vector<contact::FingerOutput>& outputs) {
    HuntOracle judge(ball, {}, kStiffness);
    for (const contact::FingerOutput& o : outputs) judge.add(o);
    return judge.report().of(Fault::fall).ticks;
  };
  contact::FingerOutput held = freeOutputAt({0, 0, -50});
  held.touch = contact::Touch::stick;
  held.normal = {0, 0, -1};
  held.proxy = ball.nearest({0, 0, -50}).point;
  held.force = {0, 0, -5};
  EXPECT_EQ(falls({freeOutputAt({0, 0, -70}), held, freeOutputAt({0, 0, -45}), freeOutputAt({0, 0, -40})}), 2u);
  EXPECT_EQ(falls({freeOutputAt({0, 0, -70}), freeOutputAt({0, 0, -45})}), 1u);
  EXPECT_EQ(falls({freeOutputAt(hole + Vec3(0, 0, 9)), freeOutputAt(0.5 * hole), freeOutputAt({0, 0, -40})}), 0u);
  held.proxy = hole;
  EXPECT_EQ(falls({freeOutputAt({0, 0, 70}), held, freeOutputAt({0, 0, -49})}), 0u) << "let go at the hole";
}

/// A box of 100 x 100 x 30 mm without its face at y = 100.
mesh::TriangleMesh openBox() {
  mesh::TriangleMesh box = plateMesh(100, 30, 12);
  std::erase_if(box.triangles, [&](const Triangle& t) { return mesh::centreOf(box, t).y() > 99.9; });
  return box;
}

/// A finger in the air 80 mm from that opening.
TEST(HuntJudgementOfTornBodies, AForceInFreeAirFarFromTheOpeningIsAFaultAndOneBesideItOrWithinIsNot) {
  OracleBody box(openBox(), false);
  ASSERT_FALSE(box.closed());
  const auto held_in_air = [&](const Vec3& tip, double y) {
    contact::FingerOutput o = freeOutputAt(tip);
    o.touch = contact::Touch::stick;
    o.proxy = {100, y, 30};
    o.depth_mm = (o.proxy - tip).norm();
    o.normal = (o.proxy - tip) / o.depth_mm;
    o.force = kStiffness * o.depth_mm * o.normal;
    HuntOracle judge(box, {}, kStiffness);
    judge.add(freeOutputAt({90, y, 31}));
    judge.add(o);
    return judge.report().of(Fault::held_in_air).ticks;
  };
  EXPECT_EQ(held_in_air({103, 20, 26}, 20), 1u);
  EXPECT_EQ(held_in_air({97, 20, 26}, 20), 0u) << "inside";
  EXPECT_EQ(held_in_air({103, 97, 26}, 97), 0u) << "the border is nearer than the proxy";
}

contact::FingerOutput heldFrom(const Vec3& proxy, const Vec3& normal, const Vec3& tip, std::uint32_t status = 0) {
  contact::FingerOutput o = freeOutputAt(tip);
  o.touch = contact::Touch::stick;
  o.proxy = proxy;
  o.normal = normal;
  o.force = normal;
  o.status = status;
  return o;
}

std::size_t fallsIn(OracleBody& body, const std::vector<contact::FingerOutput>& outputs) {
  HuntOracle judge(body, {}, kStiffness);
  for (const contact::FingerOutput& o : outputs) judge.add(o);
  return judge.report().of(Fault::fall).ticks;
}

/// A part within the box holds a finger that began inside, while its tip leaves the box and comes back.
TEST(HuntJudgementOfTornBodies, ATipThatComesBackByTheOpeningWhileItIsHeldHasNotFallenAndOneThroughTheSkinHas) {
  mesh::TriangleMesh mesh = openBox();
  mesh::TriangleMesh part = plateMesh(10, 10, 2);
  for (Vec3& p : part.positions) p += Vec3(45, 55, 10);
  mesh::append(part, mesh);
  OracleBody body(mesh, false);
  const auto held = [](const Vec3& tip) { return heldFrom({50.1, 55, 15.3}, -Vec3::UnitY(), tip); };
  const Vec3 cavity(50.1, 50, 15.3), in_part(50.1, 62, 15.3);
  const auto falls = [&](const std::vector<Vec3>& outside) {
    std::vector<contact::FingerOutput> outputs{freeOutputAt(cavity), held(in_part)};
    for (const Vec3& tip : outside) outputs.push_back(held(tip));
    outputs.insert(outputs.end(), {held(in_part), freeOutputAt(cavity)});
    return fallsIn(body, outputs);
  };
  EXPECT_EQ(falls({{50.1, 130, 15.3}}), 0u);
  EXPECT_EQ(falls({{50.1, 62, -9}}), 1u);
  EXPECT_EQ(falls({{50.1, 62, -9}, {50.1, 62, 0}}), 1u) << "by way of a place on the skin";
}

TEST(HuntJudgementOfTornBodies, ATipThatIsFreeOnTheSkinWasHeldWhereItWasBefore) {
  OracleBody box(openBox(), false);
  const auto falls = [&](double y, std::uint32_t status) {
    return fallsIn(box, {freeOutputAt({51, 60, 31}), heldFrom({51, y, 30}, Vec3::UnitZ(), {51, 60, 29}, status),
                         freeOutputAt({51, 60, 30}), freeOutputAt({51, 60, 29.9})});
  };
  EXPECT_EQ(falls(60, 0), 1u);
  EXPECT_EQ(falls(100, 0), 0u) << "at the border";
  EXPECT_EQ(falls(60, contact::kCatchingUp), 0u);
}

std::size_t missedBy(OracleBody& body, const std::vector<Vec3>& tips) {
  HuntOracle judge(body, {}, kStiffness);
  for (const Vec3& tip : tips) judge.add(freeOutputAt(tip));
  return judge.report().of(Fault::missed_contact).ticks;
}

TEST(HuntJudgementOfTornBodies, APointThatLeavesAFoldWhichIsInsideOutIsInTheAir) {
  mesh::TriangleMesh mesh = openBox();
  mesh::TriangleMesh fold = plateMesh(20, 20, 2);  // beside the box
  for (Vec3& p : fold.positions) p.x() += 120.0;
  for (Triangle& t : fold.triangles) std::swap(t[1], t[2]);
  mesh::append(fold, mesh);
  OracleBody body(mesh, true);
  EXPECT_EQ(missedBy(body, {{131, 7, 6}, {145, 7, 6}}), 0u);
  EXPECT_EQ(missedBy(body, {{51, 27, 36}, {51, 27, 25}}), 1u) << "into the box";
}

TEST(HuntJudgementOfTornBodies, APointThatPassesByAnEdgeOrLeavesACornerDidNotComeIn) {
  mesh::TriangleMesh bowl = bumpyBallMesh(60, 0, 0, 2);
  std::erase_if(bowl.triangles, [&](const Triangle& t) { return mesh::centreOf(bowl, t).z() > 52.0; });
  OracleBody body(bowl, false);
  const Vec3 far(0, 0, -90);
  EXPECT_EQ(missedBy(body, {far,
                            {36.832799545121006, 24.223537217711794, -36.832799545121006},
                            {36.651892738374343, 24.766257637951767, -36.651892738374343}}),
            0u);
  EXPECT_EQ(missedBy(body, {far,
                            {0, 22.961005941905384, -55.432771950677207},
                            {0.0013813776164495399, 22.960464498570754, -55.432981644639526}}),
            0u);
  EXPECT_EQ(missedBy(body, {far, {38, 24, -38}, {34, 24, -34}}), 1u);
}

/// A sheet of 6 x 6 mm that is said to pierce itself: from 4.7 mm behind it takes less than a tenth of all
/// directions.
TEST(HuntJudgementOfSheets, AForceIsRightBehindASheetThatTakesFewOfAllDirections) {
  OracleBody sheet({{{0, 0, 0}, {0, 6, 0}, {0, 6, 6}, {0, 0, 6}}, {{0, 1, 2}, {0, 2, 3}}}, true);
  contact::FingerOutput held = freeOutputAt({-4.7, 3, 3});
  held.touch = contact::Touch::stick;
  held.proxy = {0, 3, 3};
  held.normal = Vec3::UnitX();
  held.depth_mm = 4.7;
  held.force = kStiffness * held.depth_mm * held.normal;
  HuntOracle judge(sheet, {}, kStiffness);
  judge.add(freeOutputAt({1, 3, 3}));
  judge.add(held);
  EXPECT_LT(sheet.winding(held.tip), 0.1);
  EXPECT_EQ(judge.report().of(Fault::held_in_air).ticks, 0u);
}

TEST(HuntJudgementOfSheets, APointThatIsFeltAsATinySphereIsOnTheSkinAgainBesideABorder) {
  OracleBody sheet(flatMesh(), true);
  const auto held = [](const Vec3& proxy, std::uint32_t status) {
    contact::FingerOutput o = freeOutputAt(proxy - Vec3(0, 0, 1));
    o.touch = contact::Touch::stick;
    o.proxy = proxy;
    o.normal = Vec3::UnitZ();
    o.force = kStiffness * o.normal;
    o.triangle = 0;
    o.status = status;
    return o;
  };
  const auto wrong = [&](double above) {
    HuntOracle judge(sheet, {}, kStiffness);
    judge.add(held({101, 50, 0}, contact::kAtBorder));
    for (int i = 0; i < 2; ++i) judge.add(held({50, 50, above}, 0));
    return judge.report().of(Fault::wrong_force).ticks;
  };
  EXPECT_EQ(wrong(0.002), 0u);
  EXPECT_EQ(wrong(1.0), 2u);
}

/// Over a sheet of 100 x 100 mm: where a sphere of 2 mm goes over the border, and from where it is let go under it.
TEST(HuntJudgementOfSheets, ASphereMayBeLetGoBeyondABorderThatItWentOverAndLeavesTheSkinNowhereElse) {
  OracleBody sheet(flatMesh(), false);
  contact::FingerSettings finger;
  finger.radius_mm = 2.0;
  const auto held = [](double x, std::uint32_t status) {
    contact::FingerOutput o = freeOutputAt({x, 50, 1});
    o.touch = contact::Touch::stick;
    o.proxy = {x, 50, 0};
    o.normal = Vec3::UnitZ();
    o.force = kStiffness * o.normal;
    o.status = status;
    return o;
  };
  const auto wrong = [&](const std::vector<contact::FingerOutput>& outputs) {
    HuntOracle judge(sheet, finger, kStiffness);
    for (const contact::FingerOutput& o : outputs) judge.add(o);
    return judge.report().of(Fault::wrong_force).ticks;
  };
  EXPECT_EQ(wrong({held(98, 0), held(105, contact::kAtBorder), held(112, contact::kAtBorder)}), 0u);
  EXPECT_EQ(wrong({held(50, 0), held(55, 0)}), 0u);
  contact::FingerOutput lifted = held(55, contact::kAtBorder);
  lifted.proxy.z() = 1.0;
  EXPECT_EQ(wrong({held(50, 0), lifted}), 1u);
}

TEST(HuntJudgementOfTornBodies, ASphereBeyondTheBorderIsNoFallUntilItsTipComesThroughTheSkin) {
  mesh::TriangleMesh open = bumpyBallMesh(60, 0, 0, 4);
  std::erase_if(open.triangles, [&](const Triangle& t) { return mesh::centreOf(open, t).z() > 40.0; });
  OracleBody bowl(open, false);
  contact::FingerSettings finger;
  finger.radius_mm = 2.0;
  contact::FingerOutput afloat = freeOutputAt({0, 0, -10});
  afloat.touch = contact::Touch::slip;
  afloat.normal = Vec3::UnitZ();
  afloat.proxy = {0, 0, 40};
  afloat.force = 0.01 * afloat.normal;
  afloat.status = contact::kAtBorder;
  const auto falls = [&](const contact::FingerOutput& before, const Vec3& tip) {
    HuntOracle judge(bowl, finger, kStiffness);
    judge.add(freeOutputAt({0, 0, 90}));
    judge.add(before);
    judge.add(freeOutputAt(tip));
    return judge.report().of(Fault::fall).ticks;
  };
  EXPECT_EQ(falls(afloat, {0, 0, -15}), 0u);
  contact::FingerOutput shallow = afloat;
  shallow.tip.z() = 12.0;
  EXPECT_EQ(falls(shallow, {0, 0, 11}), 1u) << "45 mm beyond the border, 30 mm deep: it ought to have faded before";
  contact::FingerOutput on_skin = afloat;
  on_skin.tip.z() = 20.0;
  on_skin.status = 0;
  on_skin.proxy = {0, 0, -60};
  on_skin.normal = -Vec3::UnitZ();
  EXPECT_EQ(falls(on_skin, {0, 0, 10}), 1u);
  contact::FingerOutput joined = shallow;
  joined.proxy.z() = -10.0;
  joined.tip.z() = -25.0;
  on_skin.tip = {0, 0, -50};
  const auto falls_after = [&](const contact::FingerOutput& over_border) {
    HuntOracle judge(bowl, finger, kStiffness);
    judge.add(freeOutputAt({0, 0, 90}));
    for (const auto& o : {afloat, over_border, on_skin}) judge.add(o);
    judge.add(freeOutputAt({0, 0, -40}));
    return judge.report().of(Fault::fall).ticks;
  };
  EXPECT_EQ(falls_after(afloat), 1u);
  EXPECT_EQ(falls_after(joined), 0u) << "the sphere went in by the opening, where its tip was";
  contact::FingerOutput beside = afloat;
  beside.tip = {90, 0, -10};
  EXPECT_EQ(falls(beside, {40, 0, -10}), 1u);
}

/// A box of 120 x 120 x 60 mm with a hole of 24 mm in its top.
mesh::TriangleMesh boxWithHole() {
  mesh::TriangleMesh box = plateMesh(120, 60, 30);
  std::erase_if(box.triangles, [&](const Triangle& t) {
    const Vec3 middle = mesh::centreOf(box, t);
    return middle.z() > 59.9 && std::abs(middle.x() - 60.0) < 12.0 && std::abs(middle.y() - 60.0) < 12.0;
  });
  return box;
}

TEST(HuntJudgementOfTornBodies, ASphereThatSlidOverAHoleMustNotBeLetGoOverTheOtherBank) {
  HuntWorld world = buildHuntWorld(boxWithHole());
  ASSERT_FALSE(world.body.closed());
  contact::FingerSettings finger;
  finger.radius_mm = 5.0;
  HuntOracle judge(world.body, finger, kHuntedStiffness);
  contact::FingerState state;
  const auto go = [&](const Vec3& from, const Vec3& to) {
    const int ticks = static_cast<int>((to - from).norm() / 0.5);
    for (int i = 1; i <= ticks; ++i) {
      judge.add(contact::step(world.surface, finger, state, from + (to - from) * (double(i) / ticks)));
    }
  };
  go({30, 60, 80}, {30, 60, 26});
  go({30, 60, 26}, {112, 60, 26});
  EXPECT_TRUE(judge.report().clean());
  EXPECT_EQ(judge.report().of(Fault::fall).ticks, 0u);
}

}  // namespace
}  // namespace palpate::lab

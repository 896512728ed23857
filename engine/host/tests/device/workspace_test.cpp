// Where a device's space lies in the body, and the clutch: closed forms, a force that is turned and not scaled, nothing
// that jumps at the release, and a hot path that asks for nothing.
#include "palpate/device/workspace.h"

#include <gtest/gtest.h>

#include "lab/counters/thread_counts.h"
#include "palpate/base/random.h"
#include "palpate/scene/scene_file.h"
#include "support/counted.h"

namespace palpate::device {
namespace {

Workspace turnedAndScaled() {
  Workspace workspace;
  workspace.frame.axes = rotationOf({0.0, 0.0, 90.0});  // its x is the body's y
  workspace.frame.mm = 2.0;
  workspace.frame.origin_mm = Vec3(100, 0, 50);
  workspace.clutch_buttons = 2;
  workspace.stop_buttons = 4;
  return workspace;
}

/// A device that a test moves.
struct Hand {
  Vec3 place = Vec3::Zero();
  Vec3 felt = Vec3::Zero();
  DeviceState state;
  std::shared_ptr<WorkspaceLink> link;
  Device device;

  explicit Hand(const Workspace& workspace) : link(std::make_shared<WorkspaceLink>(workspace)) {
    Device raw;
    raw.name = "hand";
    raw.capabilities.workspace_mm = Box3(Vec3(-10, -20, -30), Vec3(10, 20, 30));
    raw.read_tip = [this](std::uint64_t) { return place; };
    raw.write_force = [this](const Vec3& force) { felt = force; };
    raw.state = [this] { return state; };
    device = inWorkspace(raw, workspace, link);
  }
  Vec3 tick(const Vec3& force = Vec3::Zero()) {
    const Vec3 tip = device.read_tip(0);
    device.write_force(force);
    return tip;
  }
};

void expectNear(const Vec3& is, const Vec3& wanted, const char* what) {
  EXPECT_NEAR((is - wanted).norm(), 0.0, 1e-9)
      << what << ": " << is.transpose() << " instead of " << wanted.transpose();
}

TEST(Workspace, ScalesAndTurnsMotionsAndOnlyTurnsForces) {
  Hand hand(turnedAndScaled());
  hand.place = Vec3(3, 0, 1);
  hand.state.velocity = Vec3(0, 5, 0);
  expectNear(hand.tick(Vec3(0, 0.7, 0.1)), Vec3(100, 6, 52), "tip");
  expectNear(hand.device.state().velocity, Vec3(-10, 0, 0), "velocity");
  expectNear(hand.felt, Vec3(0.7, 0, 0.1), "a push along the body's y is along the device's x");
  EXPECT_EQ(hand.device.capabilities.motion_scale, 2.0);
  expectNear(hand.device.capabilities.workspace_mm.min(), Vec3(60, -20, -10), "reach");
  expectNear(hand.device.capabilities.workspace_mm.max(), Vec3(140, 20, 110), "reach");
}

TEST(Workspace, AnglesComeBackAsTheyWere) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 turn(random.uniform(-179, 179), random.uniform(-89.9, 89.9), random.uniform(-179, 179));
    EXPECT_LT((turnOf(rotationOf(turn)) - turn).norm(), 1e-6) << turn.transpose();
  }
  for (const double y : {90.0, -90.0}) {
    const Mat3 r = rotationOf({20, y, 35});
    EXPECT_LT((rotationOf(turnOf(r)) - r).norm(), 1e-9) << "x and z are one axis there";
  }
}

TEST(Workspace, OfAScene) {
  const scene::Scene scene = scene::parse(R"(
[[device]]
name = "openhaptics:Left"
scale = 1.5
turn_deg = [0, 0, 90]
origin_mm = [1, 2, 3]
clutch_button = 2
stop_button = 1
[[device]]
name = "openhaptics:Left"
finger = "right"
)",
                                          "s.toml");
  const auto left = settingsOf(scene, "openhaptics:Left", 0);
  ASSERT_TRUE(left);
  const Workspace workspace = workspaceOf(*left, Vec3(9, 9, 9));
  expectNear(workspace.frame.placeInBody({2, 0, 0}), Vec3(1, 5, 3), "tip");
  EXPECT_EQ(workspace.clutch_buttons, 2u);
  EXPECT_EQ(workspace.stop_buttons, 1u);
  const auto right = settingsOf(scene, "openhaptics:Left", 1);
  ASSERT_TRUE(right);
  expectNear(workspaceOf(*right, Vec3(9, 9, 9)).frame.origin_mm, Vec3(9, 9, 9), "origin that nobody named");
  EXPECT_FALSE(settingsOf(scene, "openhaptics", 0));
}

TEST(Clutch, HoldsTheFingerAndGoesOnFromThereWithoutAJump) {
  Hand hand(turnedAndScaled());
  hand.place = Vec3(4, 0, 0);
  const Vec3 before = hand.tick(Vec3(0, 0, 1));
  EXPECT_EQ(hand.felt.z(), 1.0);
  hand.state.buttons = 2;
  for (int i = 0; i < 100; ++i) {
    hand.place += Vec3(0.1, -0.2, 0.05);
    expectNear(hand.tick(Vec3(0, 0, 1)), before, "tip while clutched");
    EXPECT_TRUE(hand.device.state().clutched);
    EXPECT_EQ(hand.felt, Vec3(0, 0, 0)) << "no force while clutched";
  }
  hand.state.buttons = 0;
  hand.place += Vec3(0.1, -0.2, 0.05);
  expectNear(hand.tick(), before, "tip at the release");
  EXPECT_TRUE(hand.device.state().clutched) << "still without force";
  hand.place += Vec3(1, 0, 0);
  expectNear(hand.tick(), before + Vec3(0, 2, 0), "and on from there");
  EXPECT_FALSE(hand.device.state().clutched);
  expectNear(hand.link->reading().tip, before + Vec3(0, 2, 0), "as the display sees it");
}

TEST(Clutch, OfTheWindowIsTheSameAsThatOfTheDevice) {
  Hand hand(turnedAndScaled());
  const Vec3 before = hand.tick();
  hand.link->clutch(true);
  hand.place = Vec3(30, 0, 0);
  expectNear(hand.tick(), before, "tip");
  hand.link->clutch(false);
  expectNear(hand.tick(), before, "tip");
}

TEST(Clutch, OfADeviceThatIsLostMeanwhileIsKept) {
  Hand hand(turnedAndScaled());
  const Vec3 before = hand.tick();
  hand.link->clutch(true);
  hand.tick();
  hand.place = kNoPlace;
  EXPECT_FALSE(hand.tick().allFinite()) << "a fault must be seen, also while clutched";
  hand.link->clutch(false);
  EXPECT_FALSE(hand.tick().allFinite());
  hand.place = Vec3(50, 50, 50);
  expectNear(hand.tick(), before, "back elsewhere: the finger is where it was");
}

TEST(Workspace, AChangedOnePutsTheFingerElsewhereForOneTickWithoutForce) {
  Hand hand(turnedAndScaled());
  hand.tick();
  EXPECT_FALSE(hand.device.state().elsewhere);
  Workspace other = turnedAndScaled();
  other.frame.origin_mm.z() += 4.0;
  hand.link->place(other);
  expectNear(hand.tick(Vec3(0, 0, 1)), Vec3(100, 0, 54), "tip");
  EXPECT_TRUE(hand.device.state().elsewhere);
  EXPECT_EQ(hand.felt, Vec3(0, 0, 0));
  hand.tick(Vec3(0, 0, 1));
  EXPECT_FALSE(hand.device.state().elsewhere);
  EXPECT_EQ(hand.felt.z(), 1.0);
}

TEST(Workspace, TellsOfTheButtonThatStops) {
  Hand hand(turnedAndScaled());
  hand.state.buttons = 4;
  hand.tick();
  EXPECT_TRUE(hand.device.state().stops);
  EXPECT_FALSE(hand.device.state().clutched);
}

TEST(Workspace, AsksForNothingInAHundredThousandTicks) {
  Hand hand(turnedAndScaled());
  Workspace other = turnedAndScaled();
  hand.tick();
  const lab::ThreadCounts before = lab::countsOfThisThread();
  for (int i = 0; i < 100'000; ++i) {
    hand.place.x() = 0.001 * i;
    hand.state.buttons = i % 1000 < 100 ? 2 : 0;
    if (i % 5000 == 0) other.frame.origin_mm.x() += 1.0;
    hand.link->place(other);
    hand.tick(Vec3(0, 0, 1));
    hand.link->reading();
  }
  const lab::ThreadCounts asked = lab::countsSince(before);
  support::expectNone(asked.allocations, "allocations");
  support::expectNone(asked.locks, "locks");
}

}  // namespace
}  // namespace palpate::device

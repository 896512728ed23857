#include "view/viewer/editing/pointer.h"

#include <gtest/gtest.h>

#include "palpate/base/random.h"
#include "support/mesh_scene.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::viewer {
namespace {

using Kind = window::Command::Kind;
const Vec2 kSize(1000, 800);

class PointerOn : public testing::Test {
 protected:
  void SetUp() override {
    world = scene::build(support::meshScene(folder / "ball.ply", zoo::sphere(80.0, 4)));
    viewer.camera.distance_mm = 400.0;
    look();
  }
  void look() {
    const double aspect = kSize.x() / kSize.y();
    pointer.look({view::cameraScreen(viewer.camera, aspect), viewer.camera.eye(), kSize, view::StereoMode::mono},
                 world);
  }
  void send(Kind kind, const Vec2& at, double amount = 0.0, const Vec2& by = Vec2::Zero()) {
    window::Command command;
    command.kind = kind;
    command.at = at;
    command.by = by;
    command.amount = amount;
    pointer.apply(command, viewer, viewer.now_s);
  }

  const support::TemporaryFolder folder;
  std::shared_ptr<const scene::World> world;
  ViewerState viewer;
  Pointer pointer;
};

TEST_F(PointerOn, ThePlaceIsAlwaysOnTheSkinAtRest) {
  Random random(5);
  send(Kind::press, 0.5 * kSize);
  for (int i = 0; i < 500; ++i) {
    send(Kind::slide, Vec2(random.uniform(-100, 1100), random.uniform(-100, 900)));
    ASSERT_TRUE(pointer.placeOf(0));
    EXPECT_NEAR(pointer.placeOf(0)->point.norm(), 80.0, 0.5);
  }
}

TEST_F(PointerOn, AFingerBesideTheBodyIsNowhereUntilItComesOverIt) {
  send(Kind::hover, Vec2(5, 5));
  EXPECT_FALSE(pointer.target(0, viewer, viewer.scene).present);
  send(Kind::hover, 0.5 * kSize);
  EXPECT_TRUE(pointer.target(0, viewer, viewer.scene).present);
  EXPECT_FALSE(pointer.target(0, viewer, viewer.scene).pressed);
  send(Kind::hover, Vec2(5, 5));
  EXPECT_TRUE(pointer.target(0, viewer, viewer.scene).present) << "it waits where it last was";
}

TEST_F(PointerOn, ATapWithinOneFrameIsFeltUntilTheNext) {
  send(Kind::press, 0.5 * kSize);
  send(Kind::lift, 0.5 * kSize);
  EXPECT_TRUE(pointer.target(0, viewer, viewer.scene).pressed);
  pointer.targetsSent();
  EXPECT_FALSE(pointer.target(0, viewer, viewer.scene).pressed);
  send(Kind::press, 0.5 * kSize);
  pointer.targetsSent();
  send(Kind::lift, 0.5 * kSize);
  EXPECT_FALSE(pointer.target(0, viewer, viewer.scene).pressed) << "it was felt in the frame before";
}

TEST_F(PointerOn, APressBesideTheBodyPressesNothing) {
  send(Kind::press, Vec2(5, 5));
  EXPECT_FALSE(pointer.pressed(0));
}

TEST_F(PointerOn, AHeldFingerDoesNotFollowTheMouse) {
  send(Kind::press, 0.5 * kSize);
  const Vec3 place = pointer.placeOf(0)->point;
  send(Kind::hover, Vec2(600, 400));
  EXPECT_EQ(pointer.placeOf(0)->point, place);
}

TEST_F(PointerOn, ANamedPlaceIsPressedUntilTheMouseReallyMoves) {
  const Vec2 middle = 0.5 * kSize;
  send(Kind::hover, middle);
  const SkinPlace under_the_mouse = *pointer.placeOf(0);
  const SkinPlace named = *pointer.skinAt(Vec2(620, 330));
  pointer.put(0, named);
  send(Kind::hover, middle + Vec2(2, 1));  // the hand that typed touches the mouse
  send(Kind::hold, middle + Vec2(2, 1));
  EXPECT_TRUE(pointer.pressed(0));
  EXPECT_EQ(pointer.placeOf(0)->point, named.point);
  send(Kind::lift, middle);
  send(Kind::hover, middle + Vec2(9, 0));
  send(Kind::hover, middle);
  send(Kind::hold, middle);
  EXPECT_EQ(pointer.placeOf(0)->point, under_the_mouse.point);
}

TEST_F(PointerOn, ARingThatKeysHaveMovedIsPressedWhereItIs) {
  send(Kind::hover, 0.5 * kSize);
  pointer.step(window::Action::ring_right, false, viewer);
  const Vec3 stepped = pointer.placeOf(0)->point;
  send(Kind::hold, 0.5 * kSize);
  EXPECT_EQ(pointer.placeOf(0)->point, stepped);
}

TEST_F(PointerOn, NoPressGoesThroughAPanel) {
  send(Kind::hover, Vec2(600, 400));
  const Vec3 seen = pointer.placeOf(0)->point;
  window::Command command;
  command.kind = Kind::hold;
  command.at = 0.5 * kSize;  // the skin behind the panel
  command.over_gui = true;
  pointer.apply(command, viewer, viewer.now_s);
  EXPECT_TRUE(pointer.pressed(0));
  EXPECT_EQ(pointer.placeOf(0)->point, seen);
}

TEST_F(PointerOn, AKeyPressesWhatLiesUnderTheMouseOfABodyThatWasTurned) {
  send(Kind::hover, 0.5 * kSize);
  viewer.camera.yaw_rad += 1.0;
  look();
  const Vec3 now = pointer.skinAt(0.5 * kSize)->point;
  ASSERT_GT((now - pointer.placeOf(0)->point).norm(), 10.0);
  send(Kind::hold, 0.5 * kSize);
  EXPECT_EQ(pointer.placeOf(0)->point, now);
}

TEST_F(PointerOn, DepthAndForceStayWithinTheirLimits) {
  send(Kind::deepen, 0.5 * kSize, 1000.0);
  EXPECT_EQ(viewer.state.touch.depth_mm, kMaxDepthMm);
  send(Kind::deepen, 0.5 * kSize, -1000.0);
  EXPECT_EQ(viewer.state.touch.depth_mm, 0.0);
  viewer.state.touch.by = device::PressBy::force;
  const double force = viewer.state.touch.force_n;
  send(Kind::deepen, 0.5 * kSize, 2.0);
  EXPECT_DOUBLE_EQ(viewer.state.touch.force_n, force + 2.0 * kForcePerNotchN);
}

TEST_F(PointerOn, AResistingCursorGoesSlowerTheHarderTheSkinPushes) {
  const auto depth_after_drag = [&](double force) {
    viewer.state.touch.depth_mm = 5.0;
    viewer.fingers[0].force = Vec3(0, 0, force);
    send(Kind::deepen, 0.5 * kSize, 1.5);
    return viewer.state.touch.depth_mm;
  };
  EXPECT_GT(depth_after_drag(0.0), depth_after_drag(4.0));
  EXPECT_GT(depth_after_drag(4.0), depth_after_drag(12.0));
  viewer.state.touch.resisting_cursor = false;
  EXPECT_EQ(depth_after_drag(0.0), depth_after_drag(12.0));
}

TEST_F(PointerOn, TheKeyboardMovesTheFingerByTwoMillimetres) {
  send(Kind::hover, 0.5 * kSize);
  const Vec3 before = pointer.placeOf(0)->point;
  EXPECT_TRUE(pointer.step(window::Action::ring_right, false, viewer));
  EXPECT_NEAR(pointer.placeOf(0)->point.x() - before.x(), 2.0, 0.1);
  EXPECT_TRUE(pointer.step(window::Action::ring_left, true, viewer));
  EXPECT_NEAR(pointer.placeOf(0)->point.x() - before.x(), 1.8, 0.1);
  EXPECT_FALSE(pointer.step(window::Action::help, false, viewer));
}

TEST_F(PointerOn, ZoomsAndTurnsAboutWhatIsUnderTheCursor) {
  const Vec2 cursor(600, 350);
  const Vec3 held = pointer.skinAt(cursor)->point;
  send(Kind::zoom, cursor, 3.0);
  look();
  EXPECT_LT((pointer.skinAt(cursor)->point - held).norm(), 0.2);
  send(Kind::grab, cursor);
  send(Kind::orbit, cursor, 0.0, Vec2(40, 25));
  look();
  EXPECT_LT((pointer.skinAt(cursor)->point - held).norm(), 0.2);
}

TEST_F(PointerOn, TheOtherFingerKeepsItsDepth) {
  send(Kind::press, 0.5 * kSize);
  viewer.state.touch.depth_mm = 3.0;
  window::Command take;
  take.kind = Kind::take_finger;
  take.finger = 1;
  pointer.apply(take, viewer, viewer.now_s);
  viewer.state.touch.depth_mm = 9.0;
  EXPECT_EQ(pointer.target(0, viewer, viewer.scene).depth_mm, 3.0);
  EXPECT_EQ(pointer.target(1, viewer, viewer.scene).depth_mm, 9.0);
  EXPECT_TRUE(pointer.target(0, viewer, viewer.scene).pressed);
}

TEST_F(PointerOn, InAHalfOfAStereoPictureTheCursorIsFoldedBack) {
  const double aspect = kSize.x() / kSize.y();
  const Vec3 middle = pointer.skinAt(0.5 * kSize)->point;
  pointer.look({view::cameraScreen(viewer.camera, aspect), viewer.camera.eye(), kSize, view::StereoMode::sbs_half},
               world);
  EXPECT_LT((pointer.skinAt(Vec2(250, 400))->point - middle).norm(), 1e-6);
  EXPECT_LT((pointer.skinAt(Vec2(750, 400))->point - middle).norm(), 1e-6);
}

}  // namespace
}  // namespace palpate::viewer

#include "view/viewer/finger_form.h"

#include <gtest/gtest.h>

#include "stage.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {
namespace {

/// Frames of one kind for some seconds.
void pass(FingerForm& form, double seconds, double between_s, double cost_s) {
  for (double t = 0.0; t < seconds; t += between_s) form.frame(between_s, cost_s, true);
}

TEST(FingerForm, BeginsWithAFingerAndGoesOverToAHandWhereThereIsTime) {
  FingerForm form;
  EXPECT_FALSE(form.hand());
  pass(form, 2.5, 1.0 / 60.0, 0.006);
  EXPECT_FALSE(form.hand());
  pass(form, 1.0, 1.0 / 60.0, 0.006);
  EXPECT_TRUE(form.hand());
  pass(form, 60.0, 1.0 / 60.0, 0.012);
  EXPECT_TRUE(form.hand());
}

TEST(FingerForm, KeepsTheFingerWherePicturesCostMuch) {
  FingerForm form;
  pass(form, 600.0, 1.0 / 40.0, 0.022);
  EXPECT_FALSE(form.hand());
}

TEST(FingerForm, TakesAHandBackThatIsTooSlowButForgivesHitches) {
  FingerForm form;
  pass(form, 4.0, 1.0 / 60.0, 0.006);
  ASSERT_TRUE(form.hand());
  for (int i = 0; i < 20; ++i) {
    form.frame(0.1, 0.1, true);
    form.frame(2.0, 0.1, true);  // the program was stopped
    pass(form, 0.3, 1.0 / 60.0, 0.012);
  }
  EXPECT_TRUE(form.hand());
  pass(form, 1.2, 0.05, 0.045);
  EXPECT_FALSE(form.hand());
}

TEST(FingerForm, DoesNotSwayBackAndForth) {
  FingerForm form;
  // Hands are slow and fingers quick, for ever.
  int changes = 0;
  for (double t = 0.0; t < 3600.0;) {
    const bool hand = form.hand();
    const double between = hand ? 0.05 : 1.0 / 60.0;
    form.frame(between, hand ? 0.045 : 0.006, true);
    changes += form.hand() != hand ? 1 : 0;
    t += between;
  }
  EXPECT_LE(changes, 16) << "in an hour";
}

TEST(FingerForm, FollowsTheUserWhoChose) {
  FingerForm form;
  ViewerState viewer;
  viewer.finger_present[0] = true;
  viewer.performance.frame_ms = 5.0;
  const auto after = [&](double seconds) {
    view::FingerShape shape = view::FingerShape::none;
    for (double t = 0.0; t < seconds; t += 1.0 / 60.0) shape = fingerShapeNow(form, viewer, 1.0 / 60.0, true);
    return shape;
  };
  EXPECT_EQ(after(1.0), view::FingerShape::finger);
  EXPECT_EQ(after(5.0), view::FingerShape::hand);
  viewer.simple_shading = true;
  EXPECT_EQ(after(1.0), view::FingerShape::finger) << "pictures are slow";
  viewer.simple_shading = false;
  viewer.state.look.finger = view::FingerShape::ball;
  EXPECT_EQ(after(5.0), view::FingerShape::ball);
  viewer.state.look.finger = view::FingerShape::automatic;
  EXPECT_EQ(after(1.0), view::FingerShape::finger) << "begins again";
}

/// Pixels of the left finger's blue around the middle of the body.
int bluePixels(const view::Image& picture, const Vec2& middle) {
  constexpr int kReach = 120;
  int blue = 0;
  for (int y = -kReach; y < kReach; ++y) {
    for (int x = -kReach; x < kReach; ++x) {
      const view::Pixel& p = picture.at(static_cast<int>(middle.x()) + x, static_cast<int>(middle.y()) + y);
      blue += p[2] > p[0] + 60 ? 1 : 0;
    }
  }
  return blue;
}

TEST(LiveFinger, OfNoRadiusIsDrawnAsLargeAsAFingertip) {
  const support::TemporaryFolder folder;
  scene::Scene scene = sheetScene(folder);
  scene.contact.source = scene::ContactSource::hdb;  // it knows points only
  Stage stage(scene);
  stage.move(stage.middle());
  stage.button(true);
  ASSERT_TRUE(stage.until([&] { return stage.finger().touch != contact::Touch::free; }));
  EXPECT_GT(bluePixels(stage.picture(), stage.middle()), 1000) << "a ring alone has less than 200";
}

}  // namespace
}  // namespace palpate::viewer

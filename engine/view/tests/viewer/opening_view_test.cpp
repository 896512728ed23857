// The first second of the window: no press is lost while its body is still being built, or in its first frame.
#include "view/viewer/opening_view.h"

#include "stage.h"
#include "view/viewer/panels/panels.h"

namespace palpate::viewer {
namespace {

using window::InputEvent;
using EventList = std::vector<InputEvent>;

TEST(OpeningView, LeavesWhatComesAfterItsPageToTheBody) {
  const view::OffscreenContext context;
  ViewState state;
  OpeningView view(state, {});
  const OpeningView::Frame frame{kStageWidth, kStageHeight, 1.0, 0.1};
  EXPECT_TRUE(view.frame(frame, {}, {}).empty());
  const auto [left, top, right, below] = widgetPlaces().at("start/touch");
  const Vec2 touch(0.5 * (left + right), 0.5 * (top + below));
  EventList click;
  addButton(click, touch, true);
  EXPECT_TRUE(view.frame(frame, click, {}).empty());
  EXPECT_TRUE(view.isBeingClicked());
  EventList released;
  addButton(released, touch, false);
  addButton(released, Vec2(700, 300), true);
  const std::span<const InputEvent> left_over = view.frame(frame, released, {});
  EXPECT_FALSE(view.page());
  EXPECT_FALSE(view.isBeingClicked());
  ASSERT_EQ(left_over.size(), 2u);
  EXPECT_TRUE(left_over.back().down);
  EXPECT_EQ(view.frame(frame, click, {}).size(), click.size()) << "nor is what comes later";
}

TEST(Viewer, HearsAClickOnItsStartPageInItsFirstFrame) {
  Stage seen;
  seen.state().state.shown.start = true;
  seen.frame();
  seen.frame();
  const auto [left, top, right, below] = widgetPlaces().at("start/touch");
  const Vec2 touch(0.5 * (left + right), 0.5 * (top + below));
  Viewer viewer(scene::build(sheetScene(seen.folder)), Stage::quiet(), {}, {});
  viewer.state().state.shown.start = true;
  EventList click;
  addButton(click, touch, true);
  addButton(click, touch, false);
  viewer.frame(kStageWidth, kStageHeight, 1.0, 0.0, click);
  EXPECT_FALSE(viewer.state().state.shown.start);
}

TEST(Viewer, LooksHomeOnceHoweverMuchHappensInItsFirstFrame) {
  Stage seen;
  const double home_mm = seen.state().camera.distance_mm;
  Viewer viewer(scene::build(sheetScene(seen.folder)), Stage::quiet(), {}, {});
  EventList events;
  InputEvent wheel;
  wheel.kind = InputEvent::Kind::scroll;
  wheel.at = seen.middle();
  wheel.notches = 3.0;
  events.push_back(wheel);
  addButton(events, Vec2(5, 5), true);
  addButton(events, Vec2(5, 5), false);
  viewer.frame(kStageWidth, kStageHeight, 1.0, 0.0, events);
  EXPECT_LT(viewer.state().camera.distance_mm, 0.95 * home_mm);
}

}  // namespace
}  // namespace palpate::viewer

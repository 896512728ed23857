#include "view/viewer/editing/acts.h"

#include <gtest/gtest.h>

#include "view/viewer/panels/hints.h"

namespace palpate::viewer {
namespace {

using window::Action;

TEST(Acts, EverySwitchFlipsAndFlipsBack) {
  for (const window::KeyBinding& binding : window::keyTable()) {
    ViewerState viewer;
    const bool before = isOn(binding.action, viewer);
    perform(binding.action, viewer);
    if (isOn(binding.action, viewer) == before) continue;  // no switch
    perform(binding.action, viewer);
    EXPECT_EQ(isOn(binding.action, viewer), before) << binding.name;
  }
}

TEST(Acts, OneColouringAtATime) {
  ViewerState viewer;
  perform(Action::colour_strain, viewer);
  perform(Action::colour_ellipses, viewer);
  EXPECT_FALSE(isOn(Action::colour_strain, viewer));
  EXPECT_TRUE(isOn(Action::colour_ellipses, viewer));
  perform(Action::colour_ellipses, viewer);
  EXPECT_EQ(viewer.state.look.colouring, view::Colouring::plain);
}

TEST(Acts, TheSkinFadesInFourSteps) {
  EXPECT_DOUBLE_EQ(nextOpacity(1.0), 0.6);
  EXPECT_DOUBLE_EQ(nextOpacity(0.6), 0.3);
  EXPECT_DOUBLE_EQ(nextOpacity(0.45), 0.3);
  EXPECT_DOUBLE_EQ(nextOpacity(0.3), 0.0);
  EXPECT_DOUBLE_EQ(nextOpacity(0.0), 1.0);
}

TEST(Acts, TheStereoModesComeRoundAgain) {
  ViewerState viewer;
  viewer.quad_buffer_offered = true;
  for (std::size_t i = 0; i < view::kStereoModeNames.size(); ++i) perform(Action::stereo_mode, viewer);
  EXPECT_EQ(viewer.state.stereo.mode, view::StereoMode::mono);
}

TEST(Acts, AModeThatTheWindowCannotShowIsPassedOver) {
  ViewerState viewer;
  viewer.quad_buffer_offered = false;
  viewer.state.stereo.mode = view::StereoMode::interlaced;
  perform(Action::stereo_mode, viewer);
  EXPECT_EQ(viewer.state.stereo.mode, view::StereoMode::mono);
}

TEST(Acts, EscapeClosesOneThingAtATime) {
  ViewerState viewer;
  viewer.state.shown.help = true;
  viewer.editor.active = true;
  perform(Action::cancel, viewer);
  EXPECT_FALSE(viewer.state.shown.help);
  EXPECT_TRUE(viewer.editor.active);
  perform(Action::cancel, viewer);
  EXPECT_FALSE(viewer.editor.active);
  perform(Action::cancel, viewer);
  EXPECT_TRUE(viewer.output.requests.empty());
}

TEST(Hints, ComeOneAfterTheOtherAndThenNoMore) {
  ViewerState viewer;
  window::Command command;
  using Kind = window::Command::Kind;
  command.kind = Kind::orbit;
  countHint(command, viewer.hint, viewer.state.hints);
  EXPECT_EQ(viewer.hint, 0) << "that was not asked for yet";
  for (const Kind kind : {Kind::press, Kind::deepen, Kind::slide, Kind::orbit}) {
    EXPECT_FALSE(hintText(viewer.hint).empty());
    command.kind = kind;
    countHint(command, viewer.hint, viewer.state.hints);
  }
  EXPECT_EQ(hintText(viewer.hint), "F1: everything else");
  command.kind = Kind::act;
  command.action = Action::help;
  countHint(command, viewer.hint, viewer.state.hints);
  EXPECT_TRUE(hintText(viewer.hint).empty());
  EXPECT_FALSE(viewer.state.hints);
}

TEST(Hints, APressByAKeyIsOneAsWell) {
  ViewerState viewer;
  window::Command command;
  command.kind = window::Command::Kind::hold;
  countHint(command, viewer.hint, viewer.state.hints);
  EXPECT_EQ(viewer.hint, 1);
}

}  // namespace
}  // namespace palpate::viewer

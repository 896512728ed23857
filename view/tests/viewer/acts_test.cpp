#include "view/viewer/editing/acts.h"

#include <gtest/gtest.h>

#include "view/viewer/panels/hints.h"

namespace palpate::viewer {
namespace {

using window::Action;

TEST(Acts, EverySwitchFlipsAndFlipsBack) {
  for (const window::KeyBinding& binding : window::keyTable()) {
    Session session;
    const bool before = isOn(binding.action, session);
    perform(binding.action, session);
    if (isOn(binding.action, session) == before) continue;  // no switch
    perform(binding.action, session);
    EXPECT_EQ(isOn(binding.action, session), before) << binding.name;
  }
}

TEST(Acts, OneColouringAtATime) {
  Session session;
  perform(Action::colour_strain, session);
  perform(Action::colour_ellipses, session);
  EXPECT_FALSE(isOn(Action::colour_strain, session));
  EXPECT_TRUE(isOn(Action::colour_ellipses, session));
  perform(Action::colour_ellipses, session);
  EXPECT_EQ(session.state.look.colouring, view::Colouring::plain);
}

TEST(Acts, TheSkinFadesInFourSteps) {
  EXPECT_DOUBLE_EQ(nextOpacity(1.0), 0.6);
  EXPECT_DOUBLE_EQ(nextOpacity(0.6), 0.3);
  EXPECT_DOUBLE_EQ(nextOpacity(0.45), 0.3);
  EXPECT_DOUBLE_EQ(nextOpacity(0.3), 0.0);
  EXPECT_DOUBLE_EQ(nextOpacity(0.0), 1.0);
}

TEST(Acts, TheStereoModesComeRoundAgain) {
  Session session;
  session.quad_buffer_offered = true;
  for (std::size_t i = 0; i < view::kStereoModeNames.size(); ++i) perform(Action::stereo_mode, session);
  EXPECT_EQ(session.state.stereo.mode, view::StereoMode::mono);
}

TEST(Acts, AModeThatTheWindowCannotShowIsPassedOver) {
  Session session;
  session.quad_buffer_offered = false;
  session.state.stereo.mode = view::StereoMode::interlaced;
  perform(Action::stereo_mode, session);
  EXPECT_EQ(session.state.stereo.mode, view::StereoMode::mono);
}

TEST(Acts, EscapeClosesOneThingAtATime) {
  Session session;
  session.state.shown.help = true;
  session.editor.active = true;
  perform(Action::cancel, session);
  EXPECT_FALSE(session.state.shown.help);
  EXPECT_TRUE(session.editor.active);
  perform(Action::cancel, session);
  EXPECT_FALSE(session.editor.active);
  perform(Action::cancel, session);
  EXPECT_TRUE(session.asks.requests.empty());
}

TEST(Hints, ComeOneAfterTheOtherAndThenNoMore) {
  Session session;
  window::Command command;
  using Kind = window::Command::Kind;
  command.kind = Kind::orbit;
  countHint(command, session.hint, session.state.hints);
  EXPECT_EQ(session.hint, 0) << "that was not asked for yet";
  for (const Kind kind : {Kind::press, Kind::deepen, Kind::slide, Kind::orbit}) {
    EXPECT_FALSE(hintText(session.hint).empty());
    command.kind = kind;
    countHint(command, session.hint, session.state.hints);
  }
  EXPECT_EQ(hintText(session.hint), "F1: everything else");
  command.kind = Kind::act;
  command.action = Action::help;
  countHint(command, session.hint, session.state.hints);
  EXPECT_TRUE(hintText(session.hint).empty());
  EXPECT_FALSE(session.state.hints);
}

}  // namespace
}  // namespace palpate::viewer

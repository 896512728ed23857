#include "palpate/window/input.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/random.h"

namespace palpate::window {
namespace {

using Kind = window::Command::Kind;

class Hand {
 public:
  window::Situation situation{.on_skin = true};
  window::Input input;
  std::vector<window::Command> commands;

  Hand& move(double x, double y) { return send({.kind = window::InputEvent::Kind::move, .at = {x, y}}); }
  Hand& down(window::Button button = window::Button::left, window::Modifiers modifiers = {}) {
    return click(button, true, modifiers);
  }
  Hand& up(window::Button button = window::Button::left) { return click(button, false, {}); }
  Hand& scroll(double notches, window::Modifiers modifiers = {}) {
    return send({.kind = window::InputEvent::Kind::scroll, .at = at_, .modifiers = modifiers, .notches = notches});
  }
  Hand& type(window::Key k, window::Modifiers modifiers = {}) {
    send({.kind = window::InputEvent::Kind::key, .at = at_, .down = true, .key = k, .modifiers = modifiers});
    return send({.kind = window::InputEvent::Kind::key, .at = at_, .down = false, .key = k, .modifiers = modifiers});
  }
  Hand& loseFocus() { return send({.kind = window::InputEvent::Kind::focus, .down = false}); }
  Hand& leave() { return send({.kind = window::InputEvent::Kind::leave}); }
  Hand& wait(double seconds) {
    now_ += seconds;
    return *this;
  }
  Hand& send(window::InputEvent event) {
    event.time_s = now_ += 0.01;
    if (event.kind == window::InputEvent::Kind::move) at_ = event.at;
    input.handle(event, situation, commands);
    return *this;
  }
  std::vector<Kind> kinds() {
    std::vector<Kind> seen;
    for (const window::Command& command : commands) {
      if (command.kind != Kind::hover) seen.push_back(command.kind);
    }
    commands.clear();
    return seen;
  }

 private:
  Hand& click(window::Button button, bool pressed, window::Modifiers modifiers) {
    return send({.kind = window::InputEvent::Kind::button,
                 .at = at_,
                 .button = button,
                 .down = pressed,
                 .modifiers = modifiers});
  }
  Vec2 at_ = Vec2::Zero();
  double now_ = 0.0;
};

bool anyPressed(const window::Input& input) { return input.pressed(0) || input.pressed(1); }

/// A button that began something in the view is still down: moving the cursor then does more than hover.
bool dragging(window::Input input) {
  std::vector<window::Command> commands;
  input.handle({.kind = window::InputEvent::Kind::move, .at = {7.0, 7.0}}, {}, commands);
  return commands.size() != 1 || commands[0].kind != Kind::hover;
}

TEST(Input, LeftOnSkinPressesSlidesAndLifts) {
  Hand hand;
  hand.move(10, 10).down().move(20, 10).up();
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::press, Kind::slide, Kind::lift}));
  EXPECT_FALSE(anyPressed(hand.input));
}

TEST(Input, EmptySpaceRightAndCtrlTurn) {
  Hand hand;
  hand.situation.on_skin = false;
  hand.down().move(5, 0).up();
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::grab, Kind::orbit}));
  hand.situation.on_skin = true;
  hand.wait(1).down(window::Button::right).move(9, 0).up(window::Button::right);
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::grab, Kind::orbit}));
  hand.wait(1).down(window::Button::left, {true, false}).move(12, 0).up();
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::grab, Kind::orbit}));
}

TEST(Input, MiddleAndShiftPan) {
  Hand hand;
  hand.down(window::Button::middle).move(5, 0).up(window::Button::middle);
  hand.wait(1).down(window::Button::left, {false, true}).move(9, 0).up();
  hand.wait(1).down(window::Button::right, {false, true}).move(12, 0).up(window::Button::right);
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::grab, Kind::pan, Kind::grab, Kind::pan, Kind::grab, Kind::pan}));
}

TEST(Input, PresetsMoveTheTurning) {
  Hand hand;
  hand.input.settings.preset = window::MousePreset::blender;
  hand.down(window::Button::middle).move(5, 0).up(window::Button::middle);
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::grab, Kind::orbit}));
  hand.input.settings.preset = window::MousePreset::cad;
  hand.down(window::Button::right).move(15, 0).up(window::Button::right);
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::grab, Kind::pan}));
}

TEST(Input, SwappedButtonsPressWithTheRightOne) {
  Hand hand;
  hand.input.settings.swap_left_and_right = true;
  hand.down(window::Button::right).up(window::Button::right);
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::press, Kind::lift}));
}

TEST(Input, TheWheelZoomsUnlessAFingerIsDown) {
  Hand hand;
  hand.scroll(1);
  EXPECT_EQ(hand.kinds(), std::vector{Kind::zoom});
  hand.down().scroll(-1);
  EXPECT_DOUBLE_EQ(hand.commands.back().amount, 1.0) << "towards the user is deeper";
  hand.scroll(-1, {false, true});
  EXPECT_DOUBLE_EQ(hand.commands.back().amount, 0.2);
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::press, Kind::deepen, Kind::deepen}));
}

TEST(Input, TheRightButtonBesideAPressChangesDepth) {
  Hand hand;
  hand.move(10, 10).down().down(window::Button::right).move(10, 10 + window::kDepthDragPixels);
  ASSERT_EQ(hand.commands.back().kind, Kind::deepen);
  EXPECT_DOUBLE_EQ(hand.commands.back().amount, 1.0);
  hand.up(window::Button::right).move(30, 30);
  EXPECT_EQ(hand.commands.back().kind, Kind::slide);
}

TEST(Input, EnterHoldsTheFingerAndLiftsItAgain) {
  Hand hand;
  hand.down().type(window::Key::enter).up();
  EXPECT_TRUE(hand.input.pressed(0));
  EXPECT_EQ(hand.kinds(), std::vector{Kind::press});
  hand.type(window::Key::enter);
  EXPECT_EQ(hand.kinds(), std::vector{Kind::lift});
  hand.type(window::Key::enter);  // without any button: the keyboard's way to press
  EXPECT_EQ(hand.kinds(), std::vector{Kind::hold});
}

TEST(Input, EnterSaysWhetherTheMouseIsOverAPanel) {
  Hand hand;
  hand.type(window::Key::enter);
  EXPECT_FALSE(hand.commands.back().over_gui);
  hand.type(window::Key::enter);
  hand.situation.over_gui = true;
  hand.type(window::Key::enter);
  EXPECT_EQ(hand.commands.back().kind, Kind::hold);
  EXPECT_TRUE(hand.commands.back().over_gui);
}

TEST(Input, TheOtherFingerStaysWhereItWasPut) {
  Hand hand;
  hand.down().type(window::key('2')).up();
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::press, Kind::take_finger}));
  EXPECT_TRUE(hand.input.pressed(0));
  EXPECT_EQ(hand.input.activeFinger(), 1u);
  hand.wait(1).down().up();
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::press, Kind::lift}));
  hand.type(window::Key::backspace);
  EXPECT_FALSE(anyPressed(hand.input));
}

TEST(Input, LeavingTheWindowLiftsAPressingButtonButNotAHold) {
  Hand hand;
  hand.down().leave();
  EXPECT_FALSE(anyPressed(hand.input));
  hand.up().wait(1).type(window::Key::enter).leave();
  EXPECT_TRUE(anyPressed(hand.input));
}

TEST(Input, ASecondClickCentres) {
  Hand hand;
  hand.down().up().down().up();
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::press, Kind::lift, Kind::centre}));
  hand.down().up();
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::press, Kind::lift}));
}

TEST(Input, PanelsAndTextFieldsKeepWhatIsTheirs) {
  Hand hand;
  hand.situation.over_gui = true;
  hand.move(1, 1).down().up().scroll(1);
  EXPECT_TRUE(hand.kinds().empty());
  hand.situation.gui_wants_text = true;
  hand.type(window::key('W'));
  EXPECT_TRUE(hand.kinds().empty());
}

TEST(Input, WithoutShortcutsOnlyHelpAndEscapeRemain) {
  Hand hand;
  hand.input.settings.shortcuts = false;
  hand.type(window::key('W')).type(window::Key::enter).type(window::functionKey(1)).type(window::Key::escape);
  EXPECT_EQ(hand.kinds(), (std::vector{Kind::act, Kind::act}));
}

TEST(Input, ASwitchFlipsOnceWhileItsKeyIsHeldButStepsRepeat) {
  Hand hand;
  hand.send({.kind = window::InputEvent::Kind::key, .down = true, .repeat = true, .key = window::key('W')});
  EXPECT_TRUE(hand.kinds().empty());
  hand.send({.kind = window::InputEvent::Kind::key, .down = true, .repeat = true, .key = window::Key::page_down});
  EXPECT_EQ(hand.kinds(), std::vector{Kind::deepen});
}

TEST(Input, EditingPlacesInsteadOfTouching) {
  Hand hand;
  hand.situation.editing = true;
  hand.down().move(5, 5).up().scroll(1).scroll(1, {false, true});
  EXPECT_EQ(hand.kinds(),
            (std::vector{Kind::edit_grab, Kind::edit_move, Kind::edit_drop, Kind::edit_size, Kind::edit_strength}));
  EXPECT_FALSE(anyPressed(hand.input));
}

window::InputEvent randomEvent(Random& random) {
  static constexpr window::Key kKeys[] = {
      window::Key::enter, window::Key::escape, window::Key::backspace, window::Key::page_down, window::Key::up,
      window::key('1'),   window::key('2'),    window::key('W'),       window::key('Z'),       window::functionKey(11)};
  window::InputEvent event;
  event.kind = static_cast<window::InputEvent::Kind>(random.below(7));
  event.at = Vec2(random.uniform(-50, 1400), random.uniform(-50, 900));
  event.button = static_cast<window::Button>(random.below(3));
  event.down = random.below(2) == 0;
  event.repeat = random.below(4) == 0;
  event.key = kKeys[random.below(std::size(kKeys))];
  event.modifiers = {random.below(4) == 0, random.below(4) == 0};
  event.notches = random.uniform(-3, 3);
  return event;
}

window::Situation randomSituation(Random& random) {
  return {random.below(2) == 0, random.below(4) == 0, random.below(8) == 0, random.below(8) == 0};
}

/// What a viewer would believe that only sees the commands.
struct Believed {
  std::array<bool, window::kMouseFingers> pressed{};
  std::size_t active = 0;

  void apply(const window::Command& command) {
    if (command.kind == Kind::press || command.kind == Kind::hold) pressed[active] = true;
    if (command.kind == Kind::lift) pressed[active] = false;
    if (command.kind == Kind::lift_all) pressed.fill(false);
    if (command.kind == Kind::take_finger) active = command.finger;
  }
};

TEST(InputProperty, CommandsTellTheWholeStateAndFocusLossLiftsEverything) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    window::Input input;
    input.settings.preset = static_cast<window::MousePreset>(random.below(3));
    input.settings.swap_left_and_right = random.below(2) == 0;
    Believed believed;
    std::vector<window::Command> commands;
    double now = 0.0;
    for (int i = 0; i < 300; ++i) {
      window::InputEvent event = randomEvent(random);
      event.time_s = now += random.uniform(0, 0.2);
      commands.clear();
      input.handle(event, randomSituation(random), commands);
      for (const window::Command& command : commands) believed.apply(command);
      for (std::size_t f = 0; f < window::kMouseFingers; ++f) ASSERT_EQ(believed.pressed[f], input.pressed(f)) << seed;
      ASSERT_EQ(believed.active, input.activeFinger());
      if (event.kind == window::InputEvent::Kind::focus && !event.down) {
        ASSERT_FALSE(anyPressed(input)) << seed;
        ASSERT_FALSE(dragging(input)) << seed;
      }
    }
  }
}

TEST(InputProperty, NoDragSurvivesItsButton) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    window::Input input;
    std::vector<window::Command> commands;
    double now = 0.0;
    for (int i = 0; i < 200; ++i) {
      window::InputEvent event = randomEvent(random);
      event.time_s = now += random.uniform(0, 0.2);
      input.handle(event, randomSituation(random), commands);
    }
    for (std::size_t b = 0; b < window::kButtons; ++b) {
      input.handle({.kind = window::InputEvent::Kind::button, .time_s = now, .button = static_cast<window::Button>(b)},
                   {}, commands);
    }
    EXPECT_FALSE(dragging(input)) << seed;
    for (std::size_t f = 0; f < window::kMouseFingers; ++f) EXPECT_TRUE(!input.pressed(f) || input.held(f)) << seed;
    input.handle({.kind = window::InputEvent::Kind::key, .time_s = now, .down = true, .key = window::Key::backspace},
                 {}, commands);
    EXPECT_FALSE(anyPressed(input)) << seed;
  }
}

}  // namespace
}  // namespace palpate::window

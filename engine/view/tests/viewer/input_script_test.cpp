#include "view/viewer/files/input_script.h"

#include <gtest/gtest.h>

#include "support/error_message.h"
#include "support/expect_each.h"

namespace palpate::viewer {
namespace {

using window::InputEvent;

TEST(InputScript, ReadsWhatAHandDid) {
  const auto events = parseInputScript(
      "# a press\n0.5, move, 640, 400\n0.6, down, left, shift\n0.7, scroll, -3\n0.8, up, left\n"
      "1, key, Ctrl+S\n1.5, drop, a.obj\n2, size, 800, 600\n3, close\n",
      "folder/script.csv");
  ASSERT_EQ(events.size(), 9u) << "a key is pressed and released";
  EXPECT_EQ(events[1].input.kind, InputEvent::Kind::button);
  EXPECT_EQ(events[1].input.at, Vec2(640, 400));
  EXPECT_TRUE(events[1].input.modifiers.shift);
  EXPECT_EQ(events[2].input.notches, -3.0);
  EXPECT_EQ(events[4].input.key, window::key('S'));
  EXPECT_TRUE(events[4].input.modifiers.ctrl);
  EXPECT_TRUE(events[4].input.down);
  EXPECT_FALSE(events[5].input.down);
  EXPECT_FALSE(events[5].input.modifiers.ctrl) << "or no field takes what the script types next";
  EXPECT_EQ(events[6].input.text, "folder/a.obj");
  EXPECT_EQ(events[7].width, 800);
  EXPECT_EQ(events[8].kind, ScriptEvent::Kind::close);
}

TEST(InputScript, KnowsEveryKeyOfTheTableByItsName) {
  for (const window::KeyBinding& binding : window::keyTable()) {
    const auto events = parseInputScript("0, key, " + window::nameOf(binding.chord) + "\n", "s");
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[0].input.key, binding.chord.key) << binding.name;
    EXPECT_EQ(events[0].input.modifiers, binding.chord.modifiers) << binding.name;
  }
  EXPECT_TRUE(parseInputScript("0, key, Shift+PgDn\n", "s")[0].input.modifiers.shift);
}

TEST(InputScript, NamesTheLineOfWhatItDoesNotUnderstand) {
  const auto error = [](const std::string& text) {
    return support::thrownMessage([&] { parseInputScript(text, "s.csv"); });
  };
  support::expectEach(error, {{"0, wave\n", "s.csv:1: unknown event 'wave'"},
                              {"0, move, 1, 2\n1, down\n", "s.csv:2: 'down' needs a button: left, right or middle"},
                              {"0, down, thumb\n", "s.csv:1: 'thumb' is not a button: left, right or middle"},
                              {"0, key, F77\n", "s.csv:1: unknown key 'F77'; the F1 page lists the keys"},
                              {"1, close\n0, close\n", "s.csv:2: times must not go back"},
                              {"0, size, 3, 3\n", "s.csv:1: pixels = 3 is out of range: 16 to 16,384"}});
}

}  // namespace
}  // namespace palpate::viewer

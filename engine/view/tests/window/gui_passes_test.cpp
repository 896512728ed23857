// However slow the frames, no tap of a key and no click is lost: one pass of the gui shows each change once.
#include "palpate/window/gui_passes.h"

#include <gtest/gtest.h>

namespace palpate::window {
namespace {

InputEvent keyChange(Key key, bool down) {
  InputEvent event;
  event.kind = InputEvent::Kind::key;
  event.key = key;
  event.down = down;
  return event;
}

InputEvent letterTyped(const char* letter) {
  InputEvent event;
  event.kind = InputEvent::Kind::text;
  event.text = letter;
  return event;
}

InputEvent buttonChange(bool down, const Vec2& at) {
  InputEvent event;
  event.kind = InputEvent::Kind::button;
  event.down = down;
  event.at = at;
  return event;
}

std::vector<std::size_t> sizesOf(const std::vector<InputEvent>& events) {
  std::vector<std::size_t> sizes;
  for (const auto pass : guiPasses(events)) sizes.push_back(pass.size());
  return sizes;
}

using Sizes = std::vector<std::size_t>;

TEST(GuiPasses, AFrameWithoutEventsIsOnePass) { EXPECT_EQ(sizesOf({}), Sizes{0}); }

TEST(GuiPasses, ATapIsSeenDownAndThenUp) {
  EXPECT_EQ(sizesOf({keyChange(Key::escape, true), keyChange(Key::escape, false)}), (Sizes{1, 1}));
}

TEST(GuiPasses, TypedLettersShareAPassUntilAKeyRepeats) {
  EXPECT_EQ(sizesOf({keyChange(key('A'), true), letterTyped("a"), keyChange(key('B'), true), letterTyped("b")}),
            Sizes{4});
  EXPECT_EQ(sizesOf({keyChange(key('A'), true), letterTyped("a"), keyChange(key('A'), false)}), (Sizes{2, 1}));
}

TEST(GuiPasses, WhatIsTypedAfterAnEditingKeyComesAfterIt) {
  EXPECT_EQ(sizesOf({letterTyped("a"), keyChange(Key::backspace, true), letterTyped("b")}), (Sizes{2, 1}));
  EXPECT_EQ(sizesOf({keyChange(Key::backspace, true), keyChange(Key::enter, true)}), (Sizes{1, 1}));
}

TEST(GuiPasses, AClickIsSeenWhereItWasMade) {
  InputEvent moved;
  moved.at = Vec2(50, 50);
  EXPECT_EQ(sizesOf({buttonChange(true, Vec2(10, 10)), moved}), (Sizes{1, 1}));
  EXPECT_EQ(sizesOf({buttonChange(true, Vec2(10, 10)), buttonChange(false, Vec2(10, 10))}), (Sizes{1, 1}));
}

TEST(GuiPasses, AFloodOfEventsSharesTheLastPass) {
  std::vector<InputEvent> flood;
  for (int i = 0; i < 1000; ++i) flood.push_back(keyChange(Key::enter, i % 2 == 0));
  const auto passes = guiPasses(flood);
  EXPECT_EQ(passes.size(), kMaxGuiPasses);
  EXPECT_EQ(passes.back().data() + passes.back().size(), flood.data() + flood.size());
}

}  // namespace
}  // namespace palpate::window

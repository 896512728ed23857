#include "palpate/window/keys.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "palpate/base/text.h"
#include "support/places.h"

namespace palpate::window {
namespace {

/// Everything a row answers to, finer steps with Shift included.
std::vector<window::Chord> chordsOf(const window::KeyBinding& row) {
  std::vector<window::Chord> chords;
  for (window::Chord chord : {row.chord, row.also}) {
    if (chord.key == window::Key::none) continue;
    chords.push_back(chord);
    if (!row.fine_with_shift) continue;
    chord.modifiers.shift = true;
    chords.push_back(chord);
  }
  return chords;
}

TEST(Keys, EachKeyDoesOneThing) {
  std::map<std::string, std::string_view> owner;
  for (const window::KeyBinding& row : window::keyTable()) {
    for (const window::Chord& chord : chordsOf(row)) {
      const auto [place, fresh] = owner.emplace(window::nameOf(chord), row.name);
      EXPECT_TRUE(fresh) << window::nameOf(chord) << " is both " << place->second << " and " << row.name;
    }
  }
}

TEST(Keys, EachActionHasOneRowWithAKeyAndWords) {
  std::set<window::Action> seen;
  for (const window::KeyBinding& row : window::keyTable()) {
    EXPECT_TRUE(seen.insert(row.action).second) << row.name;
    EXPECT_FALSE(window::keysOf(row).empty()) << row.name;
    EXPECT_TRUE(row.does.ends_with('.')) << row.does;
    EXPECT_EQ(&window::findBinding(row.action), &row);
  }
  EXPECT_EQ(seen.size(), window::kActions);
}

TEST(Keys, ShiftMakesStepsFinerAndOtherKeysDoNothing) {
  const auto deeper = window::findAction({window::Key::page_down, {}});
  ASSERT_TRUE(deeper);
  EXPECT_EQ(deeper->action, window::Action::deeper);
  EXPECT_FALSE(deeper->fine);
  const auto finer = window::findAction({window::Key::page_down, {false, true}});
  ASSERT_TRUE(finer);
  EXPECT_TRUE(finer->fine);
  EXPECT_FALSE(window::findAction({window::key('W'), {false, true}}));
  EXPECT_FALSE(window::findAction({window::key('W'), {true, false}}));
  EXPECT_FALSE(window::findAction({window::Key::none, {}}));
}

TEST(Keys, OverlaysAndColouringsFollowTheirLists) {
  for (std::size_t i = 0; i < view::kOverlays; ++i) {
    const auto overlay = static_cast<view::Overlay>(i);
    EXPECT_EQ(window::overlayFor(window::actionFor(overlay)), overlay);
  }
  EXPECT_EQ(window::colouringFor(window::Action::colour_strain), view::Colouring::strain);
  EXPECT_EQ(window::colouringFor(window::Action::colour_ellipses), view::Colouring::ellipses);
  EXPECT_FALSE(window::overlayFor(window::Action::skin_opacity));
  EXPECT_FALSE(window::colouringFor(window::Action::freeze));
}

TEST(Keys, AreNamedAsOnAKeyboard) {
  EXPECT_EQ(window::nameOf({window::key('Z'), {true, true}}), "Ctrl+Shift+Z");
  EXPECT_EQ(window::localisedChordName({window::key('Z'), {true, true}}), "Ctrl+Shift+Z");
  EXPECT_EQ(window::nameOf({window::functionKey(11), {}}), "F11");
  EXPECT_EQ(window::keysOf(window::findBinding(window::Action::deeper)), "PgDn or ]");
}

TEST(Keys, AreDocumentedAsTheyAre) {
  const std::string page = readFile(support::sourceFolder() / "docs/reference/viewer.md", 1 << 20);
  EXPECT_NE(page.find("<!-- insert: palpate run --keys -->"), std::string::npos) << "tools/docs puts the keys there";
  EXPECT_NE(window::keysAsMarkdown().find("| F11 |"), std::string::npos);
}

}  // namespace
}  // namespace palpate::window

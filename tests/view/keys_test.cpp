#include "palpate/view/keys.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "palpate/base/text.h"

namespace palpate::view {
namespace {

/// Everything a row answers to, finer steps with Shift included.
std::vector<Chord> chordsOf(const KeyBinding& row) {
  std::vector<Chord> chords;
  for (Chord chord : {row.chord, row.also}) {
    if (chord.key == Key::none) continue;
    chords.push_back(chord);
    if (!row.fine_with_shift) continue;
    chord.modifiers.shift = true;
    chords.push_back(chord);
  }
  return chords;
}

TEST(Keys, EachKeyDoesOneThing) {
  std::map<std::string, std::string_view> owner;
  for (const KeyBinding& row : keyTable()) {
    for (const Chord& chord : chordsOf(row)) {
      const auto [place, fresh] = owner.emplace(nameOf(chord), row.name);
      EXPECT_TRUE(fresh) << nameOf(chord) << " is both " << place->second << " and " << row.name;
    }
  }
}

TEST(Keys, EachActionHasOneRowWithAKeyAndWords) {
  std::set<Action> seen;
  for (const KeyBinding& row : keyTable()) {
    EXPECT_TRUE(seen.insert(row.action).second) << row.name;
    EXPECT_FALSE(keysOf(row).empty()) << row.name;
    EXPECT_TRUE(row.does.ends_with('.')) << row.does;
    EXPECT_EQ(&bindingOf(row.action), &row);
  }
  EXPECT_EQ(seen.size(), kActions);
}

TEST(Keys, ShiftMakesStepsFinerAndOtherKeysDoNothing) {
  const auto deeper = actionOf({Key::page_down, {}});
  ASSERT_TRUE(deeper);
  EXPECT_EQ(deeper->action, Action::deeper);
  EXPECT_FALSE(deeper->fine);
  const auto finer = actionOf({Key::page_down, {false, true}});
  ASSERT_TRUE(finer);
  EXPECT_TRUE(finer->fine);
  EXPECT_FALSE(actionOf({key('W'), {false, true}}));
  EXPECT_FALSE(actionOf({key('W'), {true, false}}));
  EXPECT_FALSE(actionOf({Key::none, {}}));
}

TEST(Keys, OverlaysAndColouringsFollowTheirLists) {
  for (std::size_t i = 0; i < kOverlays; ++i) {
    const auto overlay = static_cast<Overlay>(i);
    EXPECT_EQ(overlayOf(actionFor(overlay)), overlay);
  }
  EXPECT_EQ(colouringOf(Action::colour_strain), Colouring::strain);
  EXPECT_EQ(colouringOf(Action::colour_ellipses), Colouring::ellipses);
  EXPECT_FALSE(overlayOf(Action::skin_opacity));
  EXPECT_FALSE(colouringOf(Action::freeze));
}

TEST(Keys, AreNamedAsOnAKeyboard) {
  EXPECT_EQ(nameOf({key('Z'), {true, true}}), "Ctrl+Shift+Z");
  EXPECT_EQ(nameOf({functionKey(11), {}}), "F11");
  EXPECT_EQ(keysOf(bindingOf(Action::deeper)), "PgDn or ]");
}

TEST(Keys, AreDocumentedAsTheyAre) {
  const std::string page = readFile(std::string(PALPATE_SOURCE_DIR) + "/docs/viewer.md", 1 << 20);
  EXPECT_NE(page.find(keysAsMarkdown()), std::string::npos)
      << "put the output of `palpate run --keys` into docs/viewer.md";
}

}  // namespace
}  // namespace palpate::view

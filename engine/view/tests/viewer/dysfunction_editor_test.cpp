// Dysfunctions are moved by hand and said in words.
#include "view/viewer/editing/dysfunction_editor.h"

#include <gtest/gtest.h>

namespace palpate::viewer {
namespace {

const std::vector<body::SkinLandmark> kTwoLevels = {{"spinous_T6", "", {2, 40, 100}, Vec3::UnitZ(), {2, 40, 92}},
                                                    {"spinous_T9", "", {0, -30, 100}, Vec3::UnitZ(), {0, -30, 92}}};

window::Command editCommand(window::Command::Kind kind) {
  window::Command made;
  made.kind = kind;
  return made;
}

struct Edited {
  std::vector<maps::Dysfunction> items;
  Editor editor = {};
  UiOutput output = {};

  void drag(const Vec2& from, const Vec2& to, std::span<const body::SkinLandmark> landmarks = kTwoLevels) {
    const DysfunctionEdit edit{items, editor, output, landmarks};
    applyEdit(editCommand(window::Command::Kind::edit_grab), from, edit);
    applyEdit(editCommand(window::Command::Kind::edit_move), to, edit);
    applyEdit(editCommand(window::Command::Kind::edit_drop), to, edit);
  }
};

TEST(DysfunctionEditor, ANewOneIsKeptInWordsToTheWholeMillimetre) {
  Edited edited{{}};
  edited.drag(Vec2(-51.4, -30.2), Vec2(-51.4, -30.2));
  ASSERT_EQ(edited.items.size(), 1u);
  EXPECT_EQ(edited.items[0].at, "T9 left 51 mm");
  EXPECT_EQ(edited.items[0].x_mm, -51.0);
  EXPECT_EQ(edited.items[0].y_mm, -30.0);
}

TEST(DysfunctionEditor, OneThatWordsPlacedStaysWhereItIsDragged) {
  Edited edited{{{.x_mm = 34, .y_mm = 40, .at = "T6 right 32 mm"}}};
  edited.drag(Vec2(34, 40), Vec2(0, -30));
  EXPECT_EQ(edited.items[0].at, "T9");
  EXPECT_EQ(edited.items[0].y_mm, -30.0);
}

TEST(DysfunctionEditor, WithoutNamesThereAreNumbers) {
  Edited edited{{}};
  edited.drag(Vec2(1.25, 2.5), Vec2(1.25, 2.5), {});
  EXPECT_EQ(edited.items[0].at, "");
  EXPECT_EQ(edited.items[0].x_mm, 1.25);
}

}  // namespace
}  // namespace palpate::viewer

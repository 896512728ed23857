#include "view/viewer/state/edit_history.h"

#include <gtest/gtest.h>

#include "palpate/base/random.h"

namespace palpate::viewer {
namespace {

TEST(EditHistory, GoesBackAndForthByNamedSteps) {
  EditHistory<int> history;
  history.add(1, "first");
  history.add(2, "second");
  EXPECT_EQ(history.undoLabel(), "second");
  EXPECT_EQ(history.undo(3), 2);
  EXPECT_EQ(history.undo(2), 1);
  EXPECT_FALSE(history.canUndo());
  EXPECT_EQ(history.undo(1), 1) << "there is nothing before it";
  EXPECT_EQ(history.redoLabel(), "first");
  EXPECT_EQ(history.redo(1), 2);
  history.add(2, "another way");
  EXPECT_FALSE(history.canRedo());
}

TEST(EditHistory, KeepsAHundredSteps) {
  EditHistory<int> history;
  for (int i = 0; i < 250; ++i) history.add(i, "count");
  int value = 250;
  int steps = 0;
  while (history.canUndo()) {
    value = history.undo(value);
    ++steps;
  }
  EXPECT_EQ(steps, static_cast<int>(kUndoSteps));
  EXPECT_EQ(value, 150);
}

TEST(EditHistory, UndoThenRedoIsTheIdentity) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    EditHistory<std::uint64_t> history;
    std::uint64_t value = 0;
    for (int i = 0; i < 300; ++i) {
      const auto what = random.below(3);
      if (what == 0) {
        history.add(value, "set");
        value = random.below(5);
      } else if (what == 1 && history.canUndo()) {
        const std::uint64_t before = value;
        const std::uint64_t undone = history.undo(value);
        EXPECT_EQ(history.redo(undone), before);
        value = history.undo(before);
      } else if (what == 2 && history.canRedo()) {
        value = history.redo(value);
      }
    }
  }
}

}  // namespace
}  // namespace palpate::viewer

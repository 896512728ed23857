#include "apps/viewer/editing/edit_history.h"

#include <gtest/gtest.h>

#include "palpate/base/random.h"

namespace palpate::viewer {
namespace {

TEST(EditHistory, MakesOneStepOfAGesture) {
  EditHistory<int> history;
  int value = 1;
  history.begin(value);
  for (value = 2; value < 50; ++value) history.begin(value);
  history.commit(value, "drag");
  EXPECT_EQ(history.undoWords(), "drag");
  value = history.undo(value);
  EXPECT_EQ(value, 1);
  EXPECT_FALSE(history.canUndo());
  EXPECT_EQ(history.redoWords(), "drag");
  EXPECT_EQ(history.redo(value), 50);
}

TEST(EditHistory, DropsGesturesThatChangedNothingAndAbandonedOnes) {
  EditHistory<int> history;
  history.begin(3);
  history.commit(3, "nothing");
  EXPECT_FALSE(history.canUndo());
  history.begin(3);
  EXPECT_EQ(history.abandon(9), 3);
  EXPECT_FALSE(history.canUndo());
  history.commit(4, "no gesture began");
  EXPECT_FALSE(history.canUndo());
}

TEST(EditHistory, KeepsAHundredSteps) {
  EditHistory<int> history;
  for (int i = 0; i < 250; ++i) {
    history.begin(i);
    history.commit(i + 1, "count");
  }
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
        history.begin(value);
        value = random.below(5);
        history.commit(value, "set");
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

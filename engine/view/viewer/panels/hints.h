// Shows how to use the window: hints that follow each other, each until its action was done (pure), and the finger of
// the first seconds.
//
//   Command ─ countHint ─► number of the present hint ─ hintText ─► the text over the picture (notices.cpp)
#pragma once

#include <string_view>

#include "palpate/window/input.h"
#include "view/viewer/editing/pointer.h"

namespace palpate::viewer {

/// In place of a number: no hints in this run.
inline constexpr int kNoHint = -1;

/// The text of hint number `i`, from 0; empty after the last.
std::string_view hintText(int i);

/// Goes to the next hint when the command does the present one; after the last, `wanted` becomes false.
void countHint(const window::Command& command, int& hint, bool& wanted);

/// The first seconds: a finger enters from the side and presses, to show what the mouse can do. Any movement of the
/// mouse ends it.
class Intro {
 public:
  /// Starts it: on the torso near T6, elsewhere in the middle of the side that faces the camera.
  void begin(const scene::World& world, double now_s);
  void end(Pointer& pointer);
  bool running() const { return running_; }
  void advance(Pointer& pointer, const scene::World& world, double now_s);

 private:
  Vec3 goal_ = Vec3::Zero();
  double began_s_ = 0.0;
  bool running_ = false;
};

}  // namespace palpate::viewer

// What shows how the window is used: hints that follow each other, one until what it says was done (pure), and the
// finger of the first seconds.
//
//   Command ─ countHint ─► number of the present hint ─ hintText ─► the words over the picture (notices.cpp)
#pragma once

#include <string_view>

#include "palpate/window/input.h"
#include "view/viewer/editing/pointer.h"

namespace palpate::viewer {

/// In place of a number: none is shown in this run.
inline constexpr int kNoHint = -1;

/// The words of hint number `i`, from 0; empty after the last.
std::string_view hintText(int i);

/// Goes to the next hint when the command is what the present one asks for; after the last, `wanted` becomes false.
void countHint(const window::Command& command, int& hint, bool& wanted);

// The first seconds: a finger comes from the side and presses, so that one sees what the mouse can do. Any movement of
// the mouse ends it.

class Intro {
 public:
  /// Where it presses: on the torso near T6, elsewhere in the middle of what faces the camera.
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

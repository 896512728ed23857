// The first seconds: a finger comes from the side and presses, so that one sees what the mouse can do. Any movement of
// the mouse ends it.
#pragma once

#include "view/viewer/editing/pointer.h"

namespace palpate::viewer {

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

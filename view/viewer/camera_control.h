// Where the body is looked at from because the user asked for it: standard views, home, a finger's place.
#pragma once

#include "view/viewer/editing/pointer.h"
#include "view/viewer/modes/mode.h"
#include "view/viewer/state/home_view.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

class CameraControl {
 public:
  /// All must outlive it.
  CameraControl(ViewerState& viewer, Pointer& pointer, const Modes& modes,
                const std::shared_ptr<const scene::World>& world)
      : viewer_(viewer), pointer_(pointer), modes_(modes), world_(world) {}

  /// True if the action was about the camera, and then it was done.
  bool act(window::Action action);
  /// Of the whole body, or of the part that a mode is about.
  void setView(view::StandardView side);
  void flyTo(const view::Camera& camera);
  /// Close to a place of the skin, from the side where it is seen. True if the active finger waits there from now on;
  /// one that presses stays where it is.
  bool flyToPlace(const Vec3& point);
  /// Another body is seen from its back, or as its scene says.
  void showBody(const view::Camera& camera);

 private:
  ViewerState& viewer_;
  Pointer& pointer_;
  const Modes& modes_;
  const std::shared_ptr<const scene::World>& world_;
  int standard_view_ = 0;
};

}  // namespace palpate::viewer

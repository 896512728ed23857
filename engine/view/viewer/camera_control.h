// The user's moves of the camera: standard views, home, a finger's place.
#pragma once

#include "view/viewer/editing/pointer.h"
#include "view/viewer/modes/mode.h"
#include "view/viewer/state/home_view.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

class CameraControl {
 public:
  /// All must outlive it.
  CameraControl(BodyView& seen, const double& now_s, Pointer& pointer, const Modes& modes,
                const std::shared_ptr<const scene::World>& world)
      : seen_(seen), now_s_(now_s), pointer_(pointer), modes_(modes), world_(world) {}

  /// Returns true if the action was about the camera, and then it is done.
  bool act(window::Action action);
  /// The view of the whole body, or of a mode's part of it.
  void setView(view::StandardView side);
  void flyTo(const view::Camera& camera);
  /// Flies close to a place of the skin, from the side where it is visible. True if the active finger waits there from
  /// now on; a pressing one stays.
  bool flyToPlace(const Vec3& point);
  /// Shows another body from its back, or as its scene says.
  void showBody(const view::Camera& camera);

 private:
  BodyView& seen_;
  const double& now_s_;
  Pointer& pointer_;
  const Modes& modes_;
  const std::shared_ptr<const scene::World>& world_;
  int standard_view_ = 0;
};

}  // namespace palpate::viewer

// How two eyes see the picture of this frame: the mode that can be shown here, the tracked head where it is now, and
// where a cursor in one half of the picture points. Knows no GL.
#pragma once

#include <span>
#include <vector>

#include "palpate/window/head_tracker.h"
#include "palpate/window/input.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

class Eyesight {
 public:
  /// Whether the window has a picture for each eye (StereoMode::quad_buffer).
  explicit Eyesight(bool quad_buffer_offered) : quad_buffer_offered_(quad_buffer_offered) {}

  /// Where the eyes were measured (HeadTracker::measured).
  void headAt(const Vec3& eyes_mm, double now_s) { head_.measured(eyes_mm, now_s); }

  /// Once a frame. A mode that is not offered is taken back, with a message; the viewer's state learns where the head
  /// is.
  view::StereoSettings settings(ViewerState& viewer);

 private:
  void keepUsable(ViewerState& viewer);

  bool quad_buffer_offered_;
  view::StereoMode last_usable_ = view::StereoMode::mono;
  window::HeadTracker head_;
};

/// Events whose places are in the whole picture, as one eye has them: panels are drawn once for each eye.
std::vector<window::InputEvent> mapEventsToEye(std::span<const window::InputEvent> events, view::StereoMode mode,
                                               int width, int height);

}  // namespace palpate::viewer

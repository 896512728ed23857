// Stereo of this frame: the available mode, the present tracked head, and the target of a cursor in one half of the
// picture. Knows no GL.
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

  /// A measured place of the eyes (HeadTracker::measured).
  void headAt(const Vec3& eyes_mm, double now_s) { head_.measured(eyes_mm, now_s); }

  /// Once a frame. Reverts a mode that is not available, with a message; updates the head's place in the viewer's
  /// state.
  view::StereoSettings settings(BodyView& seen, Conversation& user);

 private:
  void enforceUsableMode(view::StereoMode& mode, Conversation& user);

  bool quad_buffer_offered_;
  view::StereoMode last_usable_ = view::StereoMode::mono;
  window::HeadTracker head_;
};

/// Events with places in the whole picture, as one eye has them: panels are drawn once for each eye.
std::vector<window::InputEvent> mapEventsToEye(std::span<const window::InputEvent> events, view::StereoMode mode,
                                               int width, int height);

}  // namespace palpate::viewer

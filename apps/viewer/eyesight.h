// How two eyes see the picture of this frame: the mode that can be shown here, the tracked head where it is now, and
// where a cursor in one half of the picture points. Knows no GL.
#pragma once

#include <span>
#include <vector>

#include "apps/viewer/session.h"
#include "palpate/window/head_tracker.h"
#include "palpate/window/input.h"

namespace palpate::viewer {

class Eyesight {
 public:
  /// Whether the window has a picture for each eye (StereoMode::quad_buffer).
  explicit Eyesight(bool quad_buffer_offered) : quad_buffer_offered_(quad_buffer_offered) {}

  /// Where the eyes were measured (HeadTracker::measured).
  void headAt(const Vec3& eyes_mm, double now_s) { head_.measured(eyes_mm, now_s); }

  /// Once a frame. A mode that is not offered is taken back, with a message; the session learns where the head is.
  view::StereoSettings settings(Session& session);

 private:
  void keepUsable(Session& session);

  bool quad_buffer_offered_;
  view::StereoMode last_usable_ = view::StereoMode::mono;
  window::HeadTracker head_;
};

/// Events whose places are in the whole picture, as one eye has them: panels are drawn once for each eye.
std::vector<window::InputEvent> asOneEyeSees(std::span<const window::InputEvent> events, view::StereoMode mode,
                                             int width, int height);

// Draws the skin simpler while pictures come too slowly, and as it was wished again when there is time to spare. Pure.
//
//   time between frames, time that a frame took ─► ShadingGuard ─► simple or as wished, and a word to the user
//
// It never changes the user's choice: what it does lies over it, and choosing a shading switches it off
// (ViewState::simpler_when_slow).

struct ShadingGuardSettings {
  double slow_s = 1.0 / 30.0;  ///< between two pictures; beyond it a drag no longer looks like one motion
  double slow_for_s = 1.5;     ///< so long before it acts: a hitch is no reason
  /// Simple pictures take about half the time of others: below this share of `slow_s` there is time enough.
  double spare_share = 0.35;
  double spare_for_s = 8.0;  ///< so long before it goes back; twice as long after each time that was in vain
  double hitch_s = 0.5;      ///< between two pictures: the program was stopped, not slow
};

class ShadingGuard {
 public:
  using Settings = ShadingGuardSettings;
  explicit ShadingGuard(const Settings& settings = {}) : settings_(settings) {}

  enum class Change : unsigned char { none, simpler, as_wished };
  /// Once a frame: the time since the frame before and what this one cost to draw. `counts` is false for frames that
  /// say nothing: while another thread loads a body, or when nothing is gained by drawing simpler.
  Change frame(double between_s, double cost_s, bool counts);
  bool simple() const { return simple_; }
  /// The user chose: as wished at once, and no opinion any more.
  void reset() { *this = ShadingGuard(settings_); }

 private:
  Settings settings_;
  bool simple_ = false;
  double patience_ = 1.0;  ///< grows with every return that was in vain
  double slow_s_ = 0.0;
  double spare_s_ = 0.0;
};

}  // namespace palpate::viewer

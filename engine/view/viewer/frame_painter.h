// One frame of the viewer as a picture: the body with fingers, rings and overlays, two recordings side by side, or a
// mode's picture in place of the body; the panels over it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "palpate/contact/finger.h"
#include "palpate/view/finger_pose.h"
#include "palpate/view/image.h"
#include "palpate/view/offscreen.h"
#include "palpate/window/gui.h"
#include "view/viewer/editing/pointer.h"
#include "view/viewer/finger_form.h"
#include "view/viewer/modes/mode.h"
#include "view/viewer/picture_scale.h"
#include "view/viewer/replay_player.h"
#include "view/viewer/state/viewer_state.h"
#include "view/viewer/world/live_model.h"

namespace palpate::viewer {

// The maximum of a press, kept readable for a moment after the finger was lifted. Pure.

class PressPeak {
 public:
  /// Once a frame.
  void follow(const contact::FingerOutput& contact, double now_s);
  /// Empty while the finger touches, and long after the press.
  std::optional<view::Peak> shown(double now_s) const;

 private:
  view::Peak most_;
  std::optional<double> lifted_s_;
  bool touching_ = false;
};

/// The inputs of one frame.
struct FrameParts {
  ViewerState& viewer;
  LiveModel& model;
  const scene::World& world;
  const Pointer& pointer;
  const ReplayPlayer& replay;
  const Modes& modes;
  window::Gui& gui;
  view::Target& target;
  const view::StereoSettings& stereo;
  bool quad_buffer;  ///< framebuffer 0 has a picture for each eye
  double pixels_per_point;
  bool kept = false;  ///< the picture is saved: with all its pixels
};

/// Needs a current GL context.
class FramePainter {
 public:
  /// With the windows of the panels that `windows` chooses (default: all).
  void paint(const FrameParts& frame, window::Gui::Choice windows = nullptr);
  /// Body, fingers and overlays alone, by one eye, without background.
  view::CutOut paintClear(const FrameParts& frame);

 private:
  view::PictureSettings pictureSettings(const FrameParts& frame) const;
  void chooseEffort(const FrameParts& frame);
  bool inMotion(const FrameParts& frame);
  std::vector<view::FingerMark> fingerMarks(const FrameParts& frame);
  void paintBeside(const FrameParts& frame, window::Gui::Choice windows);
  void paintHalf(const FrameParts& frame, LiveModel& model, std::span<const view::FingerMark> fingers);

  std::array<PressPeak, kFingers> peaks_;
  FingerForm finger_form_;
  PictureScale scale_;
  bool moved_ = false;      ///< whether the frame before showed motion
  view::Camera seen_from_;  ///< in the frame before
  std::array<Vec3, kFingers> tips_ = {device::kNowhere, device::kNowhere};
  view::FingerShape finger_shape_ = view::FingerShape::finger;  ///< in this frame
  std::optional<double> painted_s_;                             ///< when the frame before was painted
  std::unique_ptr<view::Target> half_;                          ///< for a picture of two recordings
};

/// Whether it is drawn for both eyes into framebuffer 0.
bool drawsItself(const view::StereoSettings& stereo, bool quad_buffer);

}  // namespace palpate::viewer

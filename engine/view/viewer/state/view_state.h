// The user's choices about viewing and touching, kept from run to run (state/state_file.h); without the camera. Plain
// data.
#pragma once

#include <string>
#include <vector>

#include "palpate/base/words.h"
#include "palpate/device/mouse_finger.h"
#include "palpate/view/look.h"
#include "palpate/view/stereo.h"
#include "palpate/window/gui.h"
#include "palpate/window/input.h"

namespace palpate {

template <>
struct WordsOf<device::PressBy> {
  using V = device::PressBy;
  static constexpr std::array kAll = {Word{"depth", V::depth}, Word{"force", V::force}};
};

}  // namespace palpate

namespace palpate::viewer {

/// Settings of the mouse's press.
struct TouchSettings {
  device::PressBy by = device::PressBy::depth;
  double depth_mm = 6.0;
  double force_n = 3.0;
  bool resisting_cursor = true;  ///< a drag in depth is slower the harder the skin pushes back
};
inline constexpr double kMaxDepthMm = 25.0;
inline constexpr double kMaxForceN = 20.0;
inline constexpr double kDepthPerNotchMm = 0.5;
inline constexpr double kForcePerNotchN = 0.25;

/// Open parts of the window.
struct Shown {
  bool panel = true;
  bool panel_right = false;
  bool plots = true;
  bool performance = false;
  bool numbers = true;
  bool reach = true;  ///< the box of the devices' workspaces
  bool help = false;
  bool messages = false;
  bool open_dialog = false;
  bool save_dialog = false;
  bool picture_dialog = false;
  bool film_dialog = false;
  bool class_dialog = false;
  bool manual = false;
  bool start = false;  ///< the start page
};

/// A head before a real screen of known size (view::TrackedHead).
struct HeadSettings {
  bool on = false;
  Vec3 expected_mm = {0.0, 0.0, 600.0};  ///< assumed place of the eyes without a measurement
  Vec3 offset_mm = {0.0, 0.0, 0.0};      ///< from the middle of the screen to the origin of the tracker
  double screen_height_mm = 300.0;
};
inline constexpr double kNearestHeadMm = 100.0;
inline constexpr double kMinScreenMm = 20.0;
inline constexpr double kMaxScreenMm = 3000.0;

struct ViewState {
  view::Look look;
  bool adapts_resolution = true;  ///< fewer pixels while a finger touches and pictures are slow (picture_scale.h)
  bool simpler_when_slow = true;  ///< then draw the skin smooth (shading_guard.h)
  view::StereoSettings stereo;    ///< without the head, which is below
  HeadSettings head;
  TouchSettings touch;
  window::InputSettings input;
  Shown shown;
  window::Theme theme = window::Theme::dark;
  double text_size = 1.0;  ///< 0.75 to 2.5, on top of the screen's own scale
  bool reduced_motion = false;
  std::string language = {};    ///< "de"; empty: the system's. Effective from the next start
  bool keeps_last_hour = true;  ///< records the last hour automatically
  bool hints = true;
  bool start_page = true;           ///< when the window opens without a scene of the user's
  std::vector<std::string> recent;  ///< files, newest first
};

}  // namespace palpate::viewer

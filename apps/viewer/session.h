// Everything that the panels show and change, as plain data: the wished scene, how it is looked at, what was measured.
//
// Panels edit this and note what they touched; the viewer (viewer.h) looks once a frame at what was noted and does it.
// So a panel needs no servo, no window and no GL, and can be drawn in a test.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/editing/edit_history.h"
#include "apps/viewer/panels/messages.h"
#include "apps/viewer/plots/sample_history.h"
#include "palpate/device/mouse_finger.h"
#include "palpate/engine/world_builder.h"
#include "palpate/scene/scene.h"
#include "palpate/servo/loop.h"
#include "palpate/view/camera.h"
#include "palpate/view/look.h"
#include "palpate/view/stereo.h"
#include "palpate/window/gui.h"
#include "palpate/window/head_tracker.h"

namespace palpate::viewer {

/// How the mouse presses.
struct TouchSettings {
  device::PressBy by = device::PressBy::depth;
  double depth_mm = 6.0;
  double force_n = 3.0;
  bool resisting_cursor = true;  ///< a drag in depth goes slower the harder the skin pushes back
};
inline constexpr double kMostDepthMm = 25.0;
inline constexpr double kMostForceN = 20.0;
inline constexpr double kDepthPerNotchMm = 0.5;
inline constexpr double kForcePerNotchN = 0.25;

/// What is open. The order of `sections` is that of the panels from top to bottom.
struct Shown {
  bool panel = true;
  bool panel_right = false;
  bool plots = true;
  bool performance = false;
  bool numbers = true;
  bool help = false;
  bool messages = false;
  bool open_dialog = false;
};

/// A head before a real screen of known size (view::TrackedHead).
struct HeadSettings {
  bool on = false;
  Vec3 expected_mm = {0.0, 0.0, 600.0};  ///< where the eyes are taken to be while nothing measures them
  Vec3 offset_mm = {0.0, 0.0, 0.0};      ///< from the middle of the screen to the origin of what measures
  double screen_height_mm = 300.0;
};

inline constexpr double kNearestHeadMm = 100.0;
inline constexpr double kLeastScreenMm = 20.0;
inline constexpr double kMostScreenMm = 3000.0;

/// Kept between runs, apart from the camera.
struct ViewState {
  view::Look look;
  bool simpler_when_slow = true;  ///< draw the skin smooth while pictures come too slowly (shading_guard.h)
  view::StereoSettings stereo;    ///< without the head, which is below
  HeadSettings head;
  TouchSettings touch;
  window::InputSettings input;
  Shown shown;
  window::Theme theme = window::Theme::dark;
  double text_size = 1.0;  ///< 0.75 to 2.5, on top of the screen's own scale
  bool reduced_motion = false;
  bool hints = true;
  std::vector<std::string> recent;  ///< files, newest first
};

/// What a change of the scene has consequences for; bits.
enum Consequence : std::uint32_t {
  kNothing = 0,
  kFingerChange = 1,  ///< the servo's settings
  kMapChange = 2,     ///< what lies on the body: maps, laws, forms of the deformation
  kBodyChange = 4,    ///< the body itself
};

/// What a panel asks for beyond changing data.
struct Wish {
  enum class Kind : std::uint8_t {
    open,  ///< `file`
    save,  ///< the scene, to `file` or where it came from
    screenshot,
    plots_csv,
    record,    ///< start or stop
    sequence,  ///< PNG files: start or stop
    undo,
    redo,
    home,
    full_screen,
    cancel_build,
    copy_view,
    paste_view,
    default_scene,
    use_profile,  ///< the drawn curve: written to a file that the scene names
    quit,
  };
  Kind kind = Kind::open;
  std::string file = {};
};

/// Dysfunctions with the comparison that undo needs.
struct DysfunctionList {
  std::vector<maps::Dysfunction> items;
  friend bool operator==(const DysfunctionList& a, const DysfunctionList& b);
};

struct Editor {
  bool active = false;
  int selected = -1;
  EditHistory<DysfunctionList> history;
};

/// What is known about how fast everything is; a frame's times in ms.
struct Performance {
  servo::LoopVitals servo;
  std::size_t dropped_samples = 0;
  double deform_ms = 0.0;
  double upload_ms = 0.0;
  double draw_ms = 0.0;
  double frame_ms = 0.0;
  double frames_per_s = 0.0;
  std::string graphics;  ///< name of the GL renderer
};

/// Looking again at what was, while the picture is frozen; times are those of the plots.
struct Replay {
  double at_s = 0.0;  ///< the moment that is shown
  double from_s = 0.0;
  double to_s = 0.0;  ///< what there is to look at
  bool playing = false;
  std::string table;  ///< the recorded table that is looked at; empty: the last minute of this run
};

struct Recording {
  bool forces = false;
  std::string forces_file;
  double since_s = 0.0;
  bool sequence = false;
  std::string sequence_folder;
  std::size_t pictures = 0;
};

/// The world as the panels may know it.
struct WorldFacts {
  std::string name;
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  double width_mm = 0.0, height_mm = 0.0, depth_mm = 0.0;
  bool closed = false;
  bool has_bones = false;
  double softest_n_per_mm = 0.0, stiffest_n_per_mm = 0.0;
  std::vector<std::string> notes;
  bool has_picture = false;
};

struct Session {
  scene::Scene scene;  ///< as wished; the world at work may lag behind
  ViewState state;
  view::Camera camera;
  WorldFacts world;
  Editor editor;
  Messages messages;
  std::array<SampleHistory, 2> plots;
  bool frozen = false;
  Replay replay;
  double plot_window_s = 10.0;
  double plot_end_s = 0.0;  ///< of a paused plot
  bool plots_paused = false;
  Performance performance;
  bool simple_shading = false;       ///< drawn smooth for now, whatever state.look says
  bool quad_buffer_offered = false;  ///< the window has a picture for each eye
  Vec3 eyes_mm = Vec3::Zero();       ///< of the tracked head in this frame
  window::HeadTracker::State head = window::HeadTracker::State::waiting;
  Recording recording;
  std::optional<engine::BuildProgress> building;
  std::array<contact::FingerOutput, 2> fingers;
  std::array<bool, 2> finger_present{};
  std::size_t active_finger = 0;
  double device_limit_n = 3.3;
  double now_s = 0.0;
  int hint = 0;            ///< how many hints have been followed
  std::string scene_file;  ///< where save goes; empty: ask

  std::vector<tissue::ProfileKnot> profile_knots;  ///< of the user's displacement profile
  int profile_handle = -1;                         ///< the one that is being dragged

  std::uint32_t changed = 0;  ///< Consequence bits of this frame
  std::vector<Wish> wishes;

  void wish(Wish::Kind kind, std::string file = {}) { wishes.push_back({kind, std::move(file)}); }
  void report(Severity severity, std::string text) { messages.add(severity, std::move(text), now_s); }
};

/// What follows from a changed key of a table of the scene file.
std::uint32_t consequenceOf(std::string_view table);

/// The list of dysfunctions of the scene, and putting one back.
DysfunctionList dysfunctionsOf(const Session& session);
void setDysfunctions(Session& session, DysfunctionList list);

}  // namespace palpate::viewer

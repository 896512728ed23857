// The viewer: input events in, a picture out, sixty times a second; the servo on its own thread touches the body.
//
//   InputEvents ─► gui, Input ─► Commands ─► Pointer (fingers, camera), editor, acts ─► viewer state
//   state ─► servo (targets, plans), builder (worlds)          servo ─► contacts, samples ─► model, plots, files
//   model + state ─► Painter ─► Target ─► window │ image
//
// It does not depend on a window: a host feeds it events and shows its target, so that it runs and is tested without a
// display.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "palpate/view/offscreen.h"
#include "palpate/window/gui.h"
#include "view/viewer/camera_control.h"
#include "view/viewer/class_run.h"
#include "view/viewer/devices/device_control.h"
#include "view/viewer/editing/pointer.h"
#include "view/viewer/eyesight.h"
#include "view/viewer/files/outputs.h"
#include "view/viewer/files/recording_keeper.h"
#include "view/viewer/frame_painter.h"
#include "view/viewer/modes/mode.h"
#include "view/viewer/panels/hints.h"
#include "view/viewer/panels/preview_pane.h"
#include "view/viewer/panels/start_page.h"
#include "view/viewer/replay_player.h"
#include "view/viewer/request_handler.h"
#include "view/viewer/shading_guard.h"
#include "view/viewer/state/viewer_state.h"
#include "view/viewer/world/live_model.h"
#include "view/viewer/world/live_servo.h"
#include "view/viewer/world/world_swap.h"

namespace palpate::viewer {

struct ViewerSettings {
  bool intro = true;                              ///< a finger demonstrates a press, until the mouse moves
  std::filesystem::path output_folder = ".";      ///< for pictures, tables and scenes without a file
  SceneDocument document = {};                    ///< for the world's scene, as read
  scene::Scene default_scene;                     ///< for Reload without a file
  std::vector<OpenedDevice> devices;              ///< for the first fingers, instead of the mouse
  std::filesystem::path recording_folder = {};    ///< for automatic recordings; empty: off
  std::vector<std::unique_ptr<Mode>> modes = {};  ///< besides feeling the body; the first goes first
};

/// Needs a current GL context; belongs to its thread. Throws Error where the world cannot be drawn or felt.
class Viewer {
 public:
  Viewer(const std::shared_ptr<const scene::World>& world, ViewState state, ViewerSettings settings,
         ViewerHost host = {});
  /// Ends the servo thread and completes files that are being written.
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// One frame, `width` x `height` pixels, `scale` pixels per point of the screen, `now_s` on any steady clock.
  void frame(int width, int height, double scale, double now_s, std::span<const window::InputEvent> events);

  /// Measured place of the eyes, mm from the tracker's origin: right, up, towards the head, in the plane of the screen.
  /// Any number of times a second; `now_s` on the clock of `frame`. Used while state.head.on.
  void headAt(const Vec3& eyes_mm, double now_s) { eyesight_.headAt(eyes_mm, now_s); }

  const view::Target& target() const { return *target_; }
  /// Whether the last frame went to framebuffer 0: only the swap is left.
  bool drawsItself() const { return viewer::drawsItself(stereo_, host_.quad_buffer); }
  bool wantsToQuit() const { return quit_; }
  /// Press it from any thread or signal handler; lives as long as the viewer.
  servo::EmergencyStop& emergencyStop() { return servo_.thread().emergencyStop(); }
  ViewerState& state() { return viewer_; }
  const window::Input& input() const { return input_; }
  const Pointer& pointer() const { return pointer_; }
  const scene::World& world() const { return model_->world(); }
  /// For an end without questions: saves a changed scene next to its source. Returns the file, or empty. Throws Error.
  std::filesystem::path saveBackup() const { return outputs_.saveBackup(edited_, seen_); }
  /// Ends the servo and returns its report of the whole run. The recording notes what ended it. Call nothing
  /// afterwards.
  servo::LoopReport finish(std::string_view ended_by = "done");

 private:
  void makeTarget(int width, int height);
  void lookAround();
  void adoptWorld();
  void updateFacts();
  void beginScene();
  void followServo(double elapsed_s);
  void show(std::span<const trace::Sample> contacts);
  void drawGuiPasses(std::span<const window::InputEvent> events, double points, double elapsed_s);
  void drawGuiPass(std::span<const window::InputEvent> events, double points, double elapsed_s);
  void processSamples();
  void handle(std::span<const window::InputEvent> events);
  void handle(const window::Command& command);
  void actOn(const window::Command& command);
  void measure(const window::Command& command);
  view::Frustum frustum() const;
  void placeRulerLabel();
  void updateTitle();
  void useChanges(double elapsed_s);
  void pointServo();
  void showCursor();
  void paintAndKeep(double scale);

  ViewerSettings settings_;
  ViewerHost host_;
  ViewerState viewer_;
  EditedScene& edited_ = viewer_;
  BodyView& seen_ = viewer_;
  FingerHolders& holders_ = viewer_;
  PastTouches& past_ = viewer_;
  Conversation& user_ = viewer_;
  window::Input input_;
  Pointer pointer_;
  std::shared_ptr<const scene::World> world_;
  LiveServo servo_;
  std::unique_ptr<LiveModel> model_;
  WorldSwap world_swap_;
  DeviceControl devices_;
  RecordingKeeper keeper_;
  ReplayPlayer replay_;
  Outputs outputs_;
  Modes modes_;  ///< after the servo: their recordings end before it
  CameraControl camera_;
  ClassRun class_run_;
  RequestHandler requests_;
  Intro intro_;
  Eyesight eyesight_;
  view::StereoSettings stereo_;  ///< in this frame
  ExamplePictures example_pictures_;
  PreviewPane file_preview_;
  ShadingGuard shading_guard_;
  FramePainter painter_;
  window::Gui gui_;
  std::unique_ptr<view::Target> target_;
  view::Eyes eyes_;  ///< in this frame
  window::Theme theme_ = window::Theme::dark;
  double frame_s_ = 1.0 / 60.0;  ///< smoothed time between two frames
  bool looked_ = false;          ///< the first frame was handled
  bool own_cursor_ = false;      ///< drawn once for each eye, in place of the system's
  std::string title_;
  bool quit_ = false;
};

}  // namespace palpate::viewer

// The viewer: input events in, a picture out, sixty times a second; the servo thread beside it touches the body.
//
//   InputEvents ─► gui, Input ─► Commands ─► Pointer (fingers, camera), editor, acts ─► session
//   session ─► servo (targets, plans), builder (worlds)          servo ─► contacts, samples ─► model, plots, files
//   model + session ─► Painter ─► Target ─► window │ image
//
// It knows no window: a host feeds it events and shows its target, so that it runs and is tested without a display.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "view/viewer/devices/device_control.h"
#include "view/viewer/editing/pointer.h"
#include "view/viewer/eyesight.h"
#include "view/viewer/files/outputs.h"
#include "view/viewer/files/recorded_touch.h"
#include "view/viewer/files/session_keeper.h"
#include "view/viewer/live_model.h"
#include "view/viewer/live_servo.h"
#include "measure/window/measuring_desk.h"
#include "view/viewer/panels/intro.h"
#include "view/viewer/plots/press_peak.h"
#include "view/viewer/plots/touch_history.h"
#include "view/viewer/session.h"
#include "view/viewer/shading_guard.h"
#include "teach/window/training_desk.h"
#include "view/viewer/turnover.h"
#include "palpate/view/offscreen.h"
#include "palpate/window/gui.h"

namespace palpate::viewer {

struct ViewerSettings {
  bool intro = true;                              ///< a finger shows by itself how to press, until the mouse moves
  std::filesystem::path output_folder = ".";      ///< for pictures, tables and scenes without a file
  scene::Scene default_scene;                     ///< for "Built-in torso"
  std::vector<OpenedDevice> devices;              ///< that hold the first fingers instead of the mouse
  std::filesystem::path session_folder = {};      ///< for the session that is recorded by itself; empty: none is
  std::optional<TrainingSettings> training = {};  ///< in the place of menus and panels
};

/// What only a window can do; members may be empty.
struct ViewerHost {
  std::function<void()> toggle_full_screen;
  std::function<void(const std::string&)> set_clipboard;
  std::function<std::string()> clipboard;
  std::function<void(bool)> show_cursor;
  std::function<void(const std::string&)> set_title;
  /// Framebuffer 0 has a picture for each eye; the viewer then draws quad-buffer stereo into it (drawsItself).
  bool quad_buffer = false;
};

/// Needs a current GL context; belongs to its thread. Throws Error where the world cannot be drawn or felt.
class Viewer {
 public:
  Viewer(const std::shared_ptr<const scene::World>& world, ViewState state, ViewerSettings settings,
         ViewerHost host = {});
  /// Ends the servo thread and completes files that are being recorded.
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// One frame, `width` x `height` pixels, `scale` pixels a point of the screen, `now_s` on any steady clock.
  void frame(int width, int height, double scale, double now_s, std::span<const window::InputEvent> events);

  /// Where the eyes were measured, mm from the origin of what measures: right, up, towards the head, in the plane of
  /// the screen. Any number of times a second; `now_s` on the clock of `frame`. Used while state.head.on.
  void headAt(const Vec3& eyes_mm, double now_s) { eyesight_.headAt(eyes_mm, now_s); }

  const view::Target& target() const { return *target_; }
  /// The last frame went to framebuffer 0: nothing is left but to swap.
  bool drawsItself() const { return host_.quad_buffer && stereo_.mode == view::StereoMode::quad_buffer; }
  bool wantsToQuit() const { return quit_; }
  /// Press it from any thread or signal handler; lives as long as the viewer.
  servo::EmergencyStop& emergencyStop() { return servo_.thread().emergencyStop(); }
  Session& session() { return session_; }
  const window::Input& input() const { return input_; }
  const Pointer& pointer() const { return pointer_; }
  const scene::World& world() const { return model_->world(); }
  /// Null where nobody is trained.
  const TrainingDesk* training() const { return training_.get(); }
  /// For an end that cannot ask: a changed scene beside the one it came from; which, or empty. Throws Error.
  std::filesystem::path keepChanges() const { return outputs_.keepChanges(session_); }
  /// Ends the servo; its report of the whole run. The session says what ended it. Nothing may be called afterwards.
  servo::LoopReport finish(std::string_view ended_by = "done");

 private:
  void makeTarget(int width, int height);
  void lookAround();
  void takeWorld();
  void takeFacts();
  void followServo(double elapsed_s);
  void takeSamples();
  void plot(const trace::Sample& sample);
  void replay(const std::string& file, bool beside = false);
  void takeReplay();
  void takeBeside(RecordedTouch touch);
  void leaveReplay();
  void show(std::span<const trace::Sample> contacts);
  const TouchHistory& history() const { return recorded_ ? recorded_->history : history_; }
  void handle(std::span<const window::InputEvent> events);
  void obey(const window::Command& command);
  void actOn(const window::Command& command);
  void useChanges();
  void beginScene();
  void grant(const Wish& wish);
  bool grantOfScene(const Wish& wish);
  bool grantOfPicture(const Wish& wish);
  void answer(const std::string& chosen);
  void takeBack(bool undoes);
  void saveThen(Wish how, const std::optional<Wish>& then);
  void reload();
  void playScript();
  void copyScene();
  bool hearsOfMeasuring(const window::InputEvent& event);
  void train(double elapsed_s);
  void drawPanels();
  void measure(const window::Command& command);
  void flyTo(const view::Camera& camera);
  void placeRulerLabel();
  void tellTitle();
  void setView(view::StandardView side);
  void pointServo();
  void showCursor();
  void guardShading(double elapsed_s);
  std::vector<view::FingerMark> fingerMarks();
  const TouchHistory::Moment& momentBeside() const;
  std::vector<view::FingerMark> marksBeside() const;
  std::vector<view::Lines> rings() const;
  void addReach(std::vector<view::Lines>& lines) const;
  void paint(double scale, window::Gui::Choice windows = nullptr);
  void paintBeside(double scale, window::Gui::Choice windows);
  void paintHalf(LiveModel& model, std::span<const view::FingerMark> fingers, double scale);
  void paintMeasuring(window::Gui::Choice windows);
  void paintAndKeep(double scale);
  view::PictureSettings pictureSettings() const;
  void paintClear(double scale);

  ViewerSettings settings_;
  ViewerHost host_;
  Session session_;
  window::Input input_;
  Pointer pointer_;
  std::shared_ptr<const scene::World> world_;
  LiveServo servo_;
  std::unique_ptr<LiveModel> model_;
  Turnover turnover_;
  DeviceControl devices_;
  SessionKeeper keeper_;
  TouchHistory history_;
  ReplayLoader replay_loader_;
  bool loads_beside_ = false;
  std::optional<RecordedTouch> recorded_;  ///< looked at in place of the history
  std::optional<RecordedTouch> beside_;    ///< on the right of it
  std::unique_ptr<LiveModel> beside_model_;
  std::unique_ptr<view::Target> half_;  ///< of a picture of two sessions
  MeasuringDesk measuring_;
  Outputs outputs_;
  std::unique_ptr<TrainingDesk> training_;
  Intro intro_;
  Eyesight eyesight_;
  view::StereoSettings stereo_;  ///< of this frame
  ShadingGuard shading_guard_;
  std::array<PressPeak, kFingers> peaks_;
  window::Gui gui_;
  std::unique_ptr<view::Target> target_;
  view::Eyes eyes_;  ///< of this frame
  window::Theme theme_ = window::Theme::dark;
  int standard_view_ = 0;
  double frame_s_ = 1.0 / 60.0;  ///< smoothed time between two frames
  bool seen_ = false;            ///< a frame has been drawn
  bool own_cursor_ = false;      ///< drawn once for each eye, in place of the system's
  bool clear_picture_ = false;   ///< to be taken in this frame
  std::string title_;
  bool quit_ = false;
};

}  // namespace palpate::viewer

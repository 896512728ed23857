// The training window: what `palpate train` puts in the place of menus and panels. From events to acts, from acts to a
// session, from the session to the body that is felt, to the screen, to the voice and to the record.
//
//   InputEvent, click, device's button ─► act ─► SignIn │ Task ─► rows ─► Store
//   servo ─ samples ─► Task ─► Session (places) │ LumpSession
//
// During a session the window offers nothing that would reveal more than the finger does.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/view/painter.h"
#include "teach/window/session_run.h"
#include "teach/window/session_start.h"
#include "teach/window/voice.h"
#include "view/viewer/modes/mode.h"
#include "view/viewer/state/async_task.h"

namespace palpate::viewer {

class TrainingMode : public Mode {
 public:
  /// Opens the record. Throws Error.
  explicit TrainingMode(TrainingSettings settings);
  ~TrainingMode() override;

  /// The whole window, and the mouse too while a sheet lies over the body.
  Claims claims() const override {
    return {.window = true, .body = false, .touch = screen_.place != TrainingPlace::body};
  }
  /// Sites of this body, a plain look, a mouse that presses with a force. Throws Error for a body that does not have
  /// the places of the protocol.
  void begin(ViewerState& viewer, const scene::World& world, window::Gui& gui) override;
  void handleNewWorld(const scene::World& world) override;
  void feel(const trace::Sample& sample) override;
  /// The sites with room around them.
  std::optional<Eigen::AlignedBox3d> homeBox() const override { return roomAround(ground_.sites); }
  /// Where sites are seen, and the keyboard's finger.
  void look(const Sight& sight, const ViewerState& viewer) override;
  bool handle(const window::InputEvent& event, ViewerState& viewer, bool typing) override;
  /// Passes on to the viewer the commands of the mouse and the keys that a test allows.
  bool handle(const window::Command& command, ViewerState& viewer) override;
  void draw(const FreeArea& area) override;
  /// Handles a request to close the window: asks first while a block is running.
  bool handle(const Request& request, ViewerState& viewer) override;
  /// Handles pending acts, stores rows, and requests the world that a trial needs.
  void advance(const ModeWork& work) override;
  bool wantsToQuit() const override { return quit_; }
  /// To the start page, once the window is closed.
  bool returnsToStartPage() const { return goes_back_; }
  /// Skin as it is, and nothing that would give a place away.
  void adjust(view::PictureSettings& picture) const override;
  /// How far the mouse's finger sinks, as rings: a visual substitute for the hand.
  std::vector<view::Lines> marks(const scene::World& world, const ViewerState& viewer) const override;
  std::string finish(std::string_view ended_by) override;

  const TrainingScreen& screen() const { return screen_; }
  // The session that is under way, if it is of this kind.
  training::Session* session() const { return run_ ? run_->task().places() : nullptr; }
  const training::LumpSession* lumpSession() const { return run_ ? run_->task().lumps() : nullptr; }
  bool waiting() const { return world_.waiting(); }

 private:
  /// A question is open that must be answered before all else.
  bool isAsked() const { return over_ != TrainingOver::none; }
  bool mayQuit();
  void handle(const TrainingClick& click);
  void answerQuestion(TrainingAct act);
  void act(const TrainingClick& click);
  void handleButtons(std::uint32_t buttons);
  void beginSession(training::SessionKind kind, const ViewerState& viewer, LiveServo& servo);
  void endSession();
  void leaveNow();
  void report(std::string trouble);
  void storeNewRows();
  void followSafety(const ViewerState& viewer);
  void followClass();
  void requestBody(ViewerState& viewer, WorldSwap& world_swap);
  void compose();

  TrainingSettings settings_;
  training::Store store_;
  AsyncTask<int> tidying_;  ///< locks files that a killed run left open
  std::optional<training::ClassLink> class_;
  SignIn sign_in_;
  Voice voice_;
  TrainingGround ground_;
  TrialWorld world_;
  std::unique_ptr<SessionRun> run_;
  TrainingOver over_ = TrainingOver::none;  ///< not `paused`: that is the session's
  bool quits_ = false;                      ///< after leaving
  std::string message_;
  std::string trouble_;
  bool quit_ = false;
  bool goes_back_ = false;
  TrainingScreen screen_;
  std::vector<SeenSite> seen_;
  std::size_t focus_ = 0;
  std::string screen_title_;
  KeyboardFinger finger_;
  std::vector<TrainingClick> clicks_;
  std::uint32_t buttons_ = 0;
  Holder holder_;
  std::string familiar_;  ///< trainee and device of the familiarisation in this run
  bool stopped_ = false;
};

}  // namespace palpate::viewer

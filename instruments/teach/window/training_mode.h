// The training window: what `palpate train` puts in the place of menus and panels. From events to acts, from acts to a
// session, from the session to the body that is felt, to the screen, to the voice and to the record.
//
//   InputEvent, click, device's button ─► act ─► SignIn │ Session ─► rows ─► Store
//   Session::hidden ─ trialScene ─► WorldSwap (built aside, handed to the servo) ─► the trial's clock begins
//   servo ─ samples ─► Session::feel
//
// During a session the window offers nothing that would reveal more than the finger does.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/view/painter.h"
#include "teach/window/class_line.h"
#include "teach/window/lump_sitting.h"
#include "teach/window/session_run.h"
#include "teach/window/sign_in.h"
#include "teach/window/training_keys.h"
#include "teach/window/voice.h"
#include "view/viewer/modes/mode.h"
#include "view/viewer/state/async_task.h"

namespace palpate::viewer {

struct TrainingSettings {
  std::filesystem::path records;
  training::Protocol protocol = training::builtInProtocol();
  SignInSettings sign_in = {};
  std::string thimble = {};                      ///< worn with a device; empty: the trainee is asked
  std::optional<std::uint64_t> seed = {};        ///< nothing: the system's randomness, another one for each session
  bool recording_files = true;                   ///< trials are kept tick by tick
  std::optional<std::string> speech = {};        ///< program
  std::optional<classroom::Member> member = {};  ///< for a class with a live view
  bool leads_back = false;                       ///< to the start page, from the sign-in
};

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
  std::optional<Eigen::AlignedBox3d> homeBox() const override;
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
  const training::Session* session() const { return run_ ? &run_->session() : nullptr; }
  const training::LumpSession* lumpSession() const { return lumps_ ? &lumps_->session() : nullptr; }
  bool waiting() const { return world_.waiting(); }

 private:
  /// Question that blocks everything else.
  enum class State : std::uint8_t { going_on, leaving, quitting, trouble, message };
  /// A finger that no hand moves: it walks from site to site, where lumps are sought step by step over the skin, and
  /// presses by a key.
  struct KeyboardFinger {
    bool presses = false;
    bool moved = false;  ///< the pointer is still to be moved
    std::optional<SkinPlace> place = {};
    Vec2 step = Vec2::Zero();  ///< lumps: motion on the screen, points; y up
    void press(bool down) {
      presses = down;
      moved = true;
    }
  };
  /// Holder of the trained finger, and what it can render.
  struct Holder {
    bool mouse = true;
    std::string words = "mouse";
    double force_share = 1.0;
    double ratios_kept_to_n = 0.0;
    std::uint32_t ignored_buttons = 0;  ///< clutch and stop
  };
  static Holder makeHolder(const FingerHolders& holders, LiveServo& servo);

  bool mayQuit();
  training::Moment now() const;
  bool paused() const;
  bool clockRuns() const;
  TrainingOver over() const;
  TrainingView view() const;
  void handle(const TrainingClick& click, const FingerHolders& holders, LiveServo& servo);
  bool handleOver(TrainingAct act);
  void actOnSession(TrainingAct act, int value);
  void typed(const std::string& letters);
  void walk(const Vec2& by);
  void lookAtLumps(const Sight& sight, std::size_t active_finger);
  bool canPick(int site) const;
  void handleButtons(std::uint32_t buttons);
  void beginSession(const FingerHolders& holders, LiveServo& servo);
  void endSession();
  void leaveNow(bool quits);
  training::SessionPlan makeSessionPlan(training::SessionKind kind, const FingerHolders& holders);
  training::LumpSessionPlan makeLumpSessionPlan(const training::SessionPlan& plan);
  void actOnLumps(TrainingAct act, int value);
  bool asksBeforeLeaving() const;
  void storeNewRows();
  void followSafety(const DevicesShown& devices);
  void followClass();
  TrialWorld::Body wanted() const;
  void requestTrialBody(EditedScene& edited, WorldSwap& world_swap);
  void speak();
  void compose();

  TrainingSettings settings_;
  training::Store store_;
  AsyncTask<int> tidying_;  ///< locks files that a killed run left open
  std::unique_ptr<ClassLine> class_;
  SignIn sign_in_;
  Voice voice_;
  training::SiteSet sites_;
  scene::Scene base_;
  std::optional<training::SessionKind> kind_;  ///< chosen, waits for the thimble
  std::unique_ptr<SessionRun> run_;
  std::unique_ptr<LumpSessionRun> lumps_;                    ///< replaces the run in a session with lumps
  std::shared_ptr<const scene::World> body_;                 ///< lumps are hidden in it
  std::shared_ptr<const training::LumpBodies> lump_bodies_;  ///< filled on first use
  State state_ = State::going_on;
  std::string message_;
  std::string trouble_;
  bool quit_ = false;
  bool goes_back_ = false;
  TrainingScreen screen_;
  std::vector<SeenSite> seen_;
  std::size_t focus_ = 0;
  std::string screen_title_;
  int picked_ = 0;
  std::string digits_;
  std::int64_t digits_ms_ = 0;  ///< when the last of them came
  KeyboardFinger keyboard_;
  std::vector<TrainingClick> clicks_;
  // The trials' clock: stopped while the body is built and while a question is open.
  double clock_s_ = 0.0;
  std::uint64_t tick_ = 0;
  std::uint32_t buttons_ = 0;
  TrialWorld world_;
  std::uint64_t spoken_ = 0;
  std::string spoken_title_;
  double said_s_ = 0.0;
  std::uint64_t said_ = 0;
  Holder holder_;
  std::string thimble_;
  std::string familiar_;  ///< trainee and device of the familiarisation in this run
  bool stopped_ = false;
};

}  // namespace palpate::viewer

// The training window: what `palpate train` puts in the place of menus and panels. From events to acts, from acts to a
// sitting, from the sitting to the body that is felt, to the screen, to the voice and to the record.
//
//   InputEvent, click, device's button ─► act ─► FrontDesk │ Sitting ─► rows ─► Store
//   Sitting::hidden ─ trialScene ─► Turnover (built beside, handed to the servo) ─► the trial's clock begins
//   servo ─ samples ─► Sitting::feel
//
// While a sitting goes on nothing of the window can be reached that would tell more than the finger does.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "view/viewer/devices/beside.h"
#include "view/viewer/editing/pointer.h"
#include "view/viewer/session.h"
#include "teach/window/class_line.h"
#include "teach/window/front_desk.h"
#include "teach/window/sitting_run.h"
#include "teach/window/training_keys.h"
#include "teach/window/voice.h"
#include "view/viewer/turnover.h"
#include "palpate/view/painter.h"

namespace palpate::viewer {

struct TrainingSettings {
  std::filesystem::path records;
  training::Protocol protocol = training::builtInProtocol();
  FrontDeskSettings desk = {};
  std::string thimble = {};                      ///< of a device; empty: asked for
  std::optional<std::uint64_t> seed = {};        ///< nothing: the system's randomness, another one for each sitting
  bool session_files = true;                     ///< trials are kept tick by tick
  std::optional<std::string> speech = {};        ///< program
  std::optional<classroom::Member> member = {};  ///< of a class that is told live
};

class TrainingDesk {
 public:
  /// Opens the record. Throws Error.
  explicit TrainingDesk(TrainingSettings settings);
  ~TrainingDesk();
  TrainingDesk(const TrainingDesk&) = delete;
  TrainingDesk& operator=(const TrainingDesk&) = delete;

  // In the order in which the viewer calls them in a frame.

  /// Once, before the first frame: sites of this body, a plain look, a mouse that presses with a force. Throws Error
  /// for a body that does not have the places of the protocol.
  void begin(Session& session, const scene::World& world);
  /// The servo has taken a world.
  void worldCame(const scene::World& world);
  /// Every tick of every finger.
  void feel(const trace::Sample& sample);
  /// Where sites are seen, and the keyboard's finger.
  void look(const view::Frustum& frustum, const Vec2& size_points, double scale, Pointer& pointer,
            const Session& session);
  /// True: it was for the training alone.
  bool hears(const window::InputEvent& event);
  /// What the mouse and the keys that are left may do.
  bool allows(const window::Command& command) const;
  /// The body can be touched: no sheet lies over it.
  bool offersBody() const { return screen_.place == TrainingPlace::body; }
  /// Needs a Gui frame that has begun.
  void paint();
  /// Obeys what was asked for, keeps rows, has the world changed that a trial needs.
  void advance(Session& session, LiveServo& servo, Turnover& turnover, double elapsed_s);
  /// What of the body is looked at: the sites with room around them.
  Eigen::AlignedBox3d seenBox() const;
  /// Skin as it is, and nothing that would give a place away.
  void plain(view::PictureSettings& picture) const;

  /// The window is to be closed; true: at once, else it asks first.
  bool mayQuit();
  bool wantsToQuit() const { return quit_; }
  /// The run is over; the servo has stopped. Words about what was not kept; empty: all is well.
  std::string finish(std::string_view ended_by);

  const TrainingScreen& screen() const { return screen_; }
  const training::Sitting* sitting() const { return run_ ? &run_->sitting() : nullptr; }
  bool waiting() const { return waits_for_world_; }

 private:
  /// A body that is to be felt, and for which trial: another trial is another body, even if the place is the same, so
  /// that the time it takes tells nothing.
  struct Laid {
    std::optional<training::HiddenNow> hidden;
    int trial = 0;
    friend bool operator==(const Laid&, const Laid&) = default;
  };

  training::Moment now() const;
  bool clockRuns() const;
  TrainingView view() const;
  void obey(const TrainingClick& click, Session& session, LiveServo& servo);
  bool obeyOver(TrainingAct act);
  void actOnSitting(TrainingAct act, int value);
  void typed(const std::string& letters);
  void walk(const Vec2& by);
  void takeButton(std::uint32_t buttons);
  void beginSitting(Session& session, LiveServo& servo);
  void endSitting();
  void leaveNow();
  training::SittingPlan planOf(training::SittingKind kind, const Session& session);
  void keepRows();
  void followSafety(const Session& session);
  void followClass();
  Laid wanted() const;
  void layBody(Session& session, Turnover& turnover);
  void speak();
  void compose();

  TrainingSettings settings_;
  training::Store store_;
  Beside<int> tidying_;  ///< locks what a killed run left open
  std::unique_ptr<ClassLine> class_;
  FrontDesk desk_;
  Voice voice_;
  training::SiteSet sites_;
  scene::Scene base_;
  std::optional<training::SittingKind> kind_;  ///< chosen, waits for the thimble
  std::unique_ptr<SittingRun> run_;
  TrainingOver over_ = TrainingOver::none;
  std::string message_;
  std::string trouble_;
  bool quits_after_leaving_ = false;
  bool quit_ = false;
  TrainingScreen screen_;
  std::vector<SeenSite> seen_;
  std::size_t focus_ = 0;
  std::string screen_title_;
  int picked_ = 0;
  std::string digits_;
  std::int64_t digits_ms_ = 0;  ///< when the last of them came
  bool keyboard_presses_ = false;
  bool keyboard_moved_ = false;
  std::optional<SkinPlace> keyboard_place_;
  std::vector<TrainingClick> clicks_;
  // Clocks: of trials, which stands still while the body is made and while something is asked.
  double clock_s_ = 0.0;
  std::uint64_t tick_ = 0;
  std::uint32_t world_number_ = 0;
  std::uint32_t buttons_ = 0;
  std::uint32_t ignored_buttons_ = 0;  ///< clutch and stop
  // The body.
  std::optional<Laid> laid_;
  std::optional<Laid> ready_for_;  ///< whose clock has begun
  bool waits_for_world_ = false;
  bool world_came_ = false;
  std::uint32_t world_before_ = 0;
  std::uint64_t spoken_ = 0;
  std::string spoken_title_;
  double said_s_ = 0.0;
  std::uint64_t said_ = 0;
  bool by_mouse_ = true;
  double force_share_ = 1.0;
  double ratios_kept_to_n_ = 0.0;
  std::string device_ = "mouse";
  std::string thimble_;
  std::string familiar_;  ///< who has had the familiarisation with which device in this run
  bool stopped_ = false;
};

}  // namespace palpate::viewer

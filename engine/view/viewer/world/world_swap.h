// From a changed scene to a changed world in use: waits until the user has stopped dragging a slider, has the world
// built on its own thread, gives it to the servo, and reports when it may be shown.
//
//   UiOutput::changed ─ 250 ms of quiet ─► WorldBuilder ─► ServoThread::change ─ adopted between two ticks ─► shown
#pragma once

#include <memory>
#include <string>

#include "palpate/engine/world_builder.h"
#include "view/viewer/state/viewer_state.h"
#include "view/viewer/world/live_servo.h"

namespace palpate::viewer {

/// A slider sends sixty changes a second; only the last of them is built.
inline constexpr double kQuietS = 0.25;

/// The scene of a scene file, or one around a mesh file with the touch and tissue of `like`; without its fingers: their
/// paths belong to the body they were made for. Throws Error.
struct OpenedScene {
  scene::Scene scene;
  SceneDocument document;  ///< for a scene file
};
OpenedScene sceneFromFile(const std::string& file, const scene::Scene& like);

/// Everything that a changed scene affects, in a frame.
struct SwapWork {
  EditedScene& edited;
  FingerHolders& holders;
  Conversation& user;
  std::vector<std::string>& recent;  ///< files; an opened one goes first
  engine::ServoThread& servo;
};

class WorldSwap {
 public:
  explicit WorldSwap(std::shared_ptr<const scene::World> world);

  /// A scene or mesh file, or a whole scene, replaces the present one. `unit`: of a mesh file.
  void open(const std::string& file, EditedScene& edited, scene::Unit unit = scene::Unit::from_file);
  void open(const scene::Scene& scene, EditedScene& edited);
  void cancel(EditedScene& edited, Conversation& user);
  /// This scene on the present body, immediately and without a step: for changes that a trial hides. `failure` has the
  /// error of the newest one; empty: none so far.
  void showTemporarily(const scene::Scene& scene, EditedScene& edited);
  const std::string& failure() const { return failure_; }

  /// Once a frame: acts on UiOutput::changed. Settings of the fingers go to the servo at once.
  void advance(const SwapWork& work);

  /// The servo's present or next plan, with the limits of the holders; for changes of devices. Throws Error.
  engine::ServoPlan makePlan(const scene::Scene& scene, FingerHolders& holders, Conversation& user) const;

  struct Shown {
    std::shared_ptr<const scene::World> world;  ///< null: none
    bool other_body = false;
  };
  /// The world to show from now on, once the servo has adopted it.
  Shown popShown(engine::ServoThread& servo);

 private:
  void handleBuildResult(const SwapWork& work);
  void adopt(const engine::BuildResult& result, const SwapWork& work);
  void requestWhenQuiet(const scene::Scene& scene, double now_s);
  void changeFingers(const SwapWork& work) const;

  engine::WorldBuilder builder_;
  std::shared_ptr<SceneDocument> opening_document_;  ///< written by the builder until its result is taken
  std::shared_ptr<const scene::World> shown_;
  std::shared_ptr<const scene::World> coming_;  ///< given to the servo, not adopted yet
  std::uint32_t wanted_ = 0;                    ///< kMapChange, kBodyChange
  double wanted_since_s_ = 0.0;
  bool body_requested_ = false;  ///< the newest request makes another body: a request in its place must make it too
  std::string opening_;          ///< the file of the current work; empty: none
  bool other_body_ = false;
  std::string failure_;
};

}  // namespace palpate::viewer

// From a changed scene to a changed world at work: waits until the user has stopped pulling at a slider, has the world
// built beside the display, hands it to the servo, and says when it may be shown.
//
//   viewer.output.changed ─ 250 ms of quiet ─► WorldBuilder ─► ServoThread::change ─ taken between two ticks ─► shown
#pragma once

#include <memory>
#include <string>

#include "palpate/engine/world_builder.h"
#include "view/viewer/state/viewer_state.h"
#include "view/viewer/world/live_servo.h"

namespace palpate::viewer {

/// A slider sends sixty changes a second; only the last of them is built.
inline constexpr double kQuietS = 0.25;

/// The scene of a scene file, or one around a mesh file with the touch and tissue of `like`; its fingers stay out of
/// it: their paths belong to the body they were made for. Throws Error.
struct OpenedScene {
  scene::Scene scene;
  SceneDocument document;  ///< of a scene file
};
OpenedScene sceneFromFile(const std::string& file, const scene::Scene& like);

class WorldSwap {
 public:
  explicit WorldSwap(std::shared_ptr<const scene::World> world);

  /// A scene or mesh file, or a whole scene, takes the place of what there is. `unit`: of a mesh file.
  void open(const std::string& file, ViewerState& viewer, scene::Unit unit = scene::Unit::from_file);
  void open(const scene::Scene& scene, ViewerState& viewer);
  void cancel(ViewerState& viewer);
  /// This scene on the body at hand, at once and without a step: what a trial hides. Why the newest one could not be
  /// made is said by `failure`; empty: it could, or is under way.
  void lay(const scene::Scene& scene, ViewerState& viewer);
  const std::string& failure() const { return failure_; }

  /// Once a frame: acts on viewer.output.changed. Settings of the fingers go to the servo at once.
  void advance(ViewerState& viewer, engine::ServoThread& servo);

  /// What the servo has or is about to get, with the limits of viewer.held; for who changes devices. Throws Error.
  engine::ServoPlan planNow(ViewerState& viewer) const;

  struct Shown {
    std::shared_ptr<const scene::World> world;  ///< null: nothing new
    bool other_body = false;
  };
  /// The world to be shown from now on, once the servo has taken it.
  Shown takeShown(engine::ServoThread& servo);

 private:
  void takeResult(ViewerState& viewer, engine::ServoThread& servo);
  void adopt(ViewerState& viewer, const engine::BuildResult& result, engine::ServoThread& servo);
  void requestWhenQuiet(ViewerState& viewer);
  void changeFingers(ViewerState& viewer, engine::ServoThread& servo) const;

  engine::WorldBuilder builder_;
  std::shared_ptr<SceneDocument> opening_document_;  ///< written by the builder until its result is taken
  std::shared_ptr<const scene::World> shown_;
  std::shared_ptr<const scene::World> coming_;  ///< given to the servo, not taken yet
  std::uint32_t wanted_ = 0;                    ///< kMapChange, kBodyChange
  double wanted_since_s_ = 0.0;
  bool body_requested_ = false;  ///< the newest request makes another body: a request in its place must make it too
  std::string opening_;          ///< the file that the work under way began with; empty: none
  bool other_body_ = false;
  std::string failure_;
};

}  // namespace palpate::viewer

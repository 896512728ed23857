// Shown in place of the present: the last minute of this run, a recording, a table of forces that is felt again, the
// scene's own fingers; and a second recording next to it.
//
//   file ─ ReplayLoader, on its own thread ─► RecordedTouch ─► Recording::replay, plots, model ─ end ─► the present
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "view/viewer/files/recorded_touch.h"
#include "view/viewer/state/touch_history.h"
#include "view/viewer/state/viewer_state.h"
#include "view/viewer/world/live_model.h"

namespace palpate::viewer {

/// Needs a current GL context for the second recording's model.
class ReplayPlayer {
 public:
  /// The documents must outlive it.
  ReplayPlayer(double ticks_per_s, PastTouches& past, Conversation& user)
      : ticks_per_s_(ticks_per_s), past_(past), user_(user), history_(ticks_per_s) {}

  /// Begins to read a recording or a table of forces, to be shown alone or next to the shown one.
  void load(const std::string& file, bool beside, const std::shared_ptr<const scene::World>& world,
            const scene::Scene& scene);
  /// Starts or ends the scene's own fingers.
  void playScript(const std::shared_ptr<const scene::World>& world);
  /// Progress of the current reading, if any; a recording's body may be slow to build.
  std::optional<engine::BuildProgress> progress() const { return loader_.progress(); }
  void cancel();
  /// Shows the result of reading, frozen at its beginning. Plots mark forces beyond `device_limit_n`.
  void collectResult(const std::shared_ptr<const scene::World>& world, LiveModel& model, double device_limit_n);

  /// Adds a tick of a finger, while the present is shown.
  void add(const trace::Sample& sample) { history_.add(sample); }
  /// Call for another body: the history belongs to the one before.
  void clear() { history_.clear(); }

  /// Advances time, once per frame, and leaves a recording when it is unfrozen. Returns the moment to show; null: the
  /// present.
  const TouchHistory::Moment* advance(const std::shared_ptr<const scene::World>& world, LiveModel& model,
                                      double elapsed_s);

  /// Null: the history of this run, or the present.
  const RecordedTouch* recorded() const { return recorded_ ? &*recorded_ : nullptr; }

  /// The recording on the right.
  struct Beside {
    Beside(RecordedTouch touched, std::shared_ptr<const scene::World> world)
        : touch(std::move(touched)), model(std::move(world)) {}
    RecordedTouch touch;
    LiveModel model;
  };
  /// Null without one.
  Beside* beside() const { return beside_.get(); }
  /// The moment as long after its beginning as on the left.
  const TouchHistory::Moment& momentBeside(const Replay& replay) const;

 private:
  const TouchHistory& history() const { return recorded_ ? recorded_->history : history_; }
  void show(RecordedTouch touch, LiveModel& model, double device_limit_n);
  void leave(const std::shared_ptr<const scene::World>& world, LiveModel& model);

  double ticks_per_s_;
  PastTouches& past_;
  Conversation& user_;
  TouchHistory history_;  ///< history of this run
  ReplayLoader loader_;
  bool loads_beside_ = false;
  std::optional<RecordedTouch> recorded_;
  std::unique_ptr<Beside> beside_;
};

}  // namespace palpate::viewer

// A recorded table of forces, felt once more: its tips are pressed into the present body, tick by tick, as fast as the
// machine can. With the recorded body and settings, every force is reproduced.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/background.h"
#include "palpate/base/progress.h"
#include "palpate/base/stopwatch.h"
#include "palpate/engine/world_builder.h"
#include "palpate/scene/world.h"
#include "view/viewer/state/replay.h"
#include "view/viewer/state/touch_history.h"

namespace palpate::viewer {

/// Longer tables are cut to the newest part of this length, s.
inline constexpr double kLongestReplayS = 600.0;

struct RecordedTouch {
  std::string file;
  TouchHistory history;
  double ticks_per_s = 1000.0;
  std::vector<double> radius_mm;                        ///< per finger
  bool of_script = false;                               ///< from the scene's own fingers: it plays when ready
  std::shared_ptr<const scene::World> world = nullptr;  ///< the recorded world; null: the present one
  std::vector<ReplayMark> marks = {};
  std::vector<std::string> notes = {};  ///< differences from the recording
};

/// The first two fingers of the table. Throws Error when it cannot be read.
RecordedTouch touchedAgain(const std::shared_ptr<const scene::World>& world, const scene::Scene& scene,
                           const std::filesystem::path& table, const Progress& progress = {});

/// The motion and forces of the scene's first two fingers by their scripts and trajectories, as in `palpate simulate`
/// but for the device's limits. Throws Error without a path.
RecordedTouch touchOfScript(const std::shared_ptr<const scene::World>& world, const Progress& progress = {});

/// Loads on its own thread, one table at a time. Cancelled work stops at its next report of progress.
class ReplayLoader {
 public:
  ReplayLoader() = default;
  /// Cancels the current work and joins.
  ~ReplayLoader() { cancel(); }
  ReplayLoader(const ReplayLoader&) = delete;  // the work writes into this one
  ReplayLoader& operator=(const ReplayLoader&) = delete;
  /// False, with nothing done, while another table is loading.
  bool load(std::function<RecordedTouch(const Progress& progress)> read);
  /// Drops the current work's result.
  void cancel() { cancelled_ = true; }
  /// The progress of the current work, if any.
  std::optional<engine::BuildProgress> progress() const;
  struct Result {
    std::optional<RecordedTouch> touch;
    std::string error;
  };
  /// Returns the result once.
  std::optional<Result> collectResult();

 private:
  void note(std::string_view stage, double done);

  std::atomic<bool> cancelled_ = false;
  mutable std::mutex mutex_;  // guards the progress
  engine::BuildProgress progress_;
  Clock::time_point began_;
  Result result_;                   // the work's, until it is done
  std::optional<Background> work_;  // last: it uses the result
};

/// A recording as the window plays it: the forces, on the recorded body, with its marks.
///
///   NAME.session ─ read on its own thread ─► RecordedTouch ─► frozen picture, plots, marks on the bar
/// The newest part of it on one body, at most kLongestReplayS long, as recorded: only the body is computed. Throws
/// Error when the file cannot be read or the body cannot be built.
RecordedTouch touchOfSession(const std::filesystem::path& file, const Progress& progress = {});

}  // namespace palpate::viewer

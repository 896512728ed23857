// A recorded table of forces, felt once more: its tips are pressed into the body at hand, tick by tick, as fast as the
// machine can. On the body and with the settings it was recorded with, every force comes out as it was.
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

/// Longer tables are cut: the newest part of this length is kept, s.
inline constexpr double kLongestReplayS = 600.0;

struct RecordedTouch {
  std::string file;
  TouchHistory history;
  double ticks_per_s = 1000.0;
  std::vector<double> radius_mm;                        ///< of each finger
  bool of_script = false;                               ///< of the scene's own fingers: it plays when it is there
  std::shared_ptr<const scene::World> world = nullptr;  ///< it was felt on; null: the one at hand
  std::vector<ReplayMark> marks = {};
  std::vector<std::string> notes = {};  ///< what is not as it was, in words
};

/// The first two fingers of the table. Throws Error when it cannot be read.
RecordedTouch touchedAgain(const std::shared_ptr<const scene::World>& world, const scene::Scene& scene,
                           const std::filesystem::path& table, const Progress& progress = {});

/// What the first two fingers of the scene do and feel by their scripts and trajectories, as `palpate simulate` feels
/// it but for the device's limits. Throws Error where there is no path.
RecordedTouch touchOfScript(const std::shared_ptr<const scene::World>& world, const Progress& progress = {});

/// Does it beside the display, one table at a time. Work is given up at its next sign of life.
class ReplayLoader {
 public:
  ReplayLoader() = default;
  /// Gives up the work under way and joins.
  ~ReplayLoader() { cancel(); }
  ReplayLoader(const ReplayLoader&) = delete;  // the work writes into this one
  ReplayLoader& operator=(const ReplayLoader&) = delete;
  /// False, with nothing done, while another table is at work.
  bool load(std::function<RecordedTouch(const Progress& progress)> read);
  /// No result will come.
  void cancel() { cancelled_ = true; }
  /// Of the work under way, if any.
  std::optional<engine::BuildProgress> progress() const;
  struct Result {
    std::optional<RecordedTouch> touch;
    std::string error;
  };
  /// What became of it, once.
  std::optional<Result> take();

 private:
  void note(std::string_view stage, double done);

  std::atomic<bool> cancelled_ = false;
  mutable std::mutex mutex_;  // guards the progress
  engine::BuildProgress progress_;
  Clock::time_point began_;
  Result result_;                   // the work's, until it is done
  std::optional<Background> work_;  // last: it uses the result
};

// A recording as the window plays it: what was felt, on the body it was felt on, with its marks.
//
//   NAME.session ─ read beside the display ─► RecordedTouch ─► frozen picture, plots, marks on the bar

/// The newest part of it that is no longer than kLongestReplayS and was felt on one body, as it was recorded: nothing
/// is computed but the body. Throws Error when the file cannot be read or the body not be built.
RecordedTouch touchOfSession(const std::filesystem::path& file, const Progress& progress = {});

}  // namespace palpate::viewer

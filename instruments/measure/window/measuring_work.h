// Reads and measures photographs on its own thread, one job at a time: the newest request wins.
//
//   MeasuringJob ─ own thread: readPhotograph, measurePair │ measureDots, buildOverlay ─► MeasuringResult, taken by a
//   frame
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/measure/measurement.h"
#include "palpate/measure/overlay.h"
#include "palpate/view/image.h"
#include "view/viewer/state/async_task.h"

namespace palpate::viewer {

struct MeasuringJob {
  std::array<std::string, 2> files =
      {};  ///< photographs to be read, and if there are two measured; both empty: the marks
  measure::DotPair marks = {};
  measure::MeasureSettings settings = {};
  std::vector<measure::Finding> of_photographs = {};  ///< not visible from marks alone; goes to their result
  int width_px = 0;                                   ///< width of the photographs that the marks are in
  int height_px = 0;
  bool ofPhotographs() const { return !files[0].empty() || !files[1].empty(); }
};

/// The shown picture: halved until it is small enough to be uploaded within a frame.
struct ReadPhoto {
  std::string file = {};
  int width_px = 0;  ///< before that
  int height_px = 0;
  std::vector<std::string> notes = {};
  view::Image image = {};
};
inline constexpr int kMaxShownPx = 2048;

struct MeasuringResult {
  bool of_photographs = false;
  std::array<std::optional<ReadPhoto>, 2> photos = {};
  std::shared_ptr<const measure::Measurement> measured = nullptr;
  measure::Overlay overlay = {};
  std::vector<measure::Finding> of_photographs_alone = {};  ///< for the next measuring of marks
  std::vector<std::string> errors = {};
};

/// Rethrows the progress's exception; faults of files and marks become errors.
MeasuringResult measured(const MeasuringJob& job, const Progress& progress);

class MeasuringWork {
 public:
  /// Cancels the running job, and waits for its next progress report.
  ~MeasuringWork() { cancel(); }

  /// Starts at once, or when the running job is done or cancelled.
  void request(MeasuringJob job);
  /// No result will come.
  void cancel();
  bool busy() const { return work_.busy() || next_.has_value(); }
  struct State {
    std::string stage = {};
    double done = 0.0;
  };
  State state() const;
  /// A finished result, once. Begins what waits.
  std::optional<MeasuringResult> collectResult();

 private:
  void begin(MeasuringJob job);
  void note(std::string_view stage, double done);

  std::optional<MeasuringJob> next_;
  std::atomic<bool> give_up_{false};
  bool of_photographs_ = false;  ///< kind of the running work
  mutable std::mutex mutex_;     // guards the state
  State state_;
  AsyncTask<MeasuringResult> work_;  // last: it uses the above
};

}  // namespace palpate::viewer

// Measuring a person in the window, the part that the view cannot do itself: reads and measures on its own thread,
// uploads photographs to the graphics card, finds places on the body, writes accepted results into its table and has
// the scene use it.
//
//   MeasuringView ─ stale ─► MeasuringWork ─► taken ─► AcceptMeasurement ─► table ─► scene.ellipses.key_points
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "measure/window/measuring_view.h"
#include "palpate/base/progress.h"
#include "palpate/body/torso.h"
#include "palpate/measure/measurement.h"
#include "palpate/measure/overlay.h"
#include "palpate/view/image.h"
#include "palpate/view/offscreen.h"
#include "view/viewer/modes/mode.h"
#include "view/viewer/state/async_task.h"

namespace palpate::viewer {

// Reads and measures photographs on its own thread, one job at a time: the newest request wins.
//
//   MeasuringJob ─ own thread: readPhotograph, measurePair │ measureDots, buildOverlay ─► MeasuringResult, taken by a
//   frame

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

class MeasuringMode : public Mode {
 public:
  MeasuringView& view() { return view_; }
  const MeasuringView& view() const { return view_; }
  /// Handled with the next frame.
  void request(MeasuringRequest request) { requests_.push_back(std::move(request)); }

  Claims claims() const override { return {.window = false, .body = view_.open, .touch = view_.open}; }
  /// A key that means something to the photographs alone.
  bool handle(const window::InputEvent& event, ViewerState& viewer, bool typing) override;
  /// Opens and closes by its key, closes by Escape after everything that lies over it.
  bool handle(const window::Command& command, ViewerState& viewer) override;
  std::optional<ModeMenuItem> menuItem() const override;
  void draw(const FreeArea& area) override;
  /// A photograph that is opened, corrections that are taken back, and those that would be lost by leaving.
  bool handle(const Request& request, ViewerState& viewer) override;
  bool answer(const Question& question, std::string_view chosen, ViewerState& viewer) override;
  void advance(const ModeWork& work) override { advance(work.viewer, work.world.body->anatomy.landmarks); }

  /// Once a frame; the landmarks are those of the current body.
  void advance(ViewerState& viewer, std::span<const body::SkinLandmark> landmarks);

  enum class Accepting : std::uint8_t { done, asked, failed };
  /// Unless `sure`, asks first if the measuring refused it or a row of the file would be replaced.
  Accepting accept(ViewerState& viewer, bool sure);

 private:
  /// Request that waits for an answer.
  using Waiting = std::variant<Request, MeasuringRequest>;

  void handle(const MeasuringRequest& request, ViewerState& viewer);
  bool asksFirst(Waiting waiting, Conversation& user);
  void undoOrRedo(bool undoes, Conversation& user);
  void startMeasuring();
  void collectResult(Conversation& user);

  MeasuringView view_;
  MeasuringRequests requests_;
  std::optional<Waiting> waiting_;
  std::array<std::optional<view::FlatPicture>, 2> pictures_;
  std::vector<measure::Finding> of_photographs_;  ///< not visible from marks alone
  MeasuringWork work_;
};

}  // namespace palpate::viewer

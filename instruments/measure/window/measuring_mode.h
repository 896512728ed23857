// Measuring a person in the window, the part that the view cannot do itself: reads and measures on its own thread,
// uploads photographs to the graphics card, finds places on the body, writes accepted results into its table and has
// the scene use it.
//
//   MeasuringView ─ stale ─► MeasuringWork ─► taken ─► AcceptMeasurement ─► table ─► scene.ellipses.key_points
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "measure/window/measuring_view.h"
#include "measure/window/measuring_work.h"
#include "palpate/body/torso.h"
#include "palpate/measure/measurement.h"
#include "palpate/view/offscreen.h"
#include "view/viewer/modes/mode.h"

namespace palpate::viewer {

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

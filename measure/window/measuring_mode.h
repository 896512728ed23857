// Measuring a person in the window. What the view cannot do itself: reads and measures beside the display, brings
// photographs to the graphics card, finds places on the body, writes what was accepted into its table and has the scene
// use it.
//
//   MeasuringView ─ stale ─► MeasuringWork ─► taken ─► AcceptMeasurement ─► table ─► scene.ellipses.key_points
#pragma once

#include <array>
#include <optional>
#include <span>
#include <variant>

#include "measure/window/measuring_view.h"
#include "measure/window/measuring_work.h"
#include "palpate/body/torso.h"
#include "palpate/view/flat_picture.h"
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
  bool handle(const window::InputEvent& event, Session& session, bool typing) override;
  /// Opens and closes by its key, closes by Escape after everything that lies over it.
  bool handle(const window::Command& command, Session& session) override;
  std::optional<ModeMenuItem> menuItem() const override;
  void draw(const FreeArea& area) override;
  /// A photograph that is opened, corrections that are taken back, and those that would be lost by leaving.
  bool handle(const Request& request, Session& session) override;
  bool answer(const Question& question, std::string_view chosen, Session& session) override;
  void advance(const ModeWork& work) override { advance(work.session, work.world.body->anatomy.landmarks); }

  /// Once a frame; the landmarks are those of the body at hand.
  void advance(Session& session, std::span<const body::SkinLandmark> landmarks);

  enum class Accepting : std::uint8_t { done, asked, failed };
  /// Asks first where the measuring refused it and where something in the file would be replaced, unless `sure`.
  Accepting accept(Session& session, bool sure);

 private:
  /// What waits for an answer.
  using Waiting = std::variant<Request, MeasuringRequest>;

  void handle(const MeasuringRequest& request, Session& session);
  bool asksFirst(Waiting waiting, Session& session);
  void takeBack(bool undoes, Session& session);
  void startMeasuring();
  void take(Session& session);

  MeasuringView view_;
  MeasuringRequests requests_;
  std::optional<Waiting> waiting_;
  std::array<std::optional<view::FlatPicture>, 2> pictures_;
  std::vector<measure::Finding> of_photographs_;  ///< what marks alone cannot tell
  MeasuringWork work_;
};

}  // namespace palpate::viewer

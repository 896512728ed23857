// What the measuring view cannot do itself: reads and measures beside the display, brings photographs to the graphics
// card, finds places on the body, writes what was accepted into its table and has the scene use it.
//
//   MeasuringView ─ stale ─► MeasuringWork ─► taken ─► Wish accept_measurement ─► table ─► scene.ellipses.key_points
#pragma once

#include <array>
#include <optional>
#include <span>

#include "measure/window/measuring_work.h"
#include "view/viewer/session.h"
#include "palpate/body/torso.h"
#include "palpate/view/flat_picture.h"

namespace palpate::viewer {

class MeasuringDesk {
 public:
  /// True if it was about measuring, and then it was done.
  bool grant(const Wish& wish, Session& session);
  /// Once a frame; the landmarks are those of the body at hand.
  void advance(Session& session, std::span<const body::SkinLandmark> landmarks);

  enum class Accepting : std::uint8_t { done, asked, failed };
  /// Asks first where the measuring refused it and where something in the file would be replaced, unless `sure`.
  Accepting accept(Session& session, bool sure);

 private:
  void begin(MeasuringView& view);
  void take(Session& session);

  std::array<std::optional<view::FlatPicture>, 2> pictures_;
  std::vector<measure::Finding> of_photographs_;  ///< what marks alone cannot tell
  MeasuringWork work_;
};

}  // namespace palpate::viewer

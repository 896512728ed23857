// Draws the skin simpler while pictures are too slow, and as requested again when there is time to spare. Pixels are
// reduced first (picture_scale.h). Pure.
//
//   time between frames, cost of a frame ─► ShadingGuard ─► simple or as requested, and a message to the user
//
// It never changes the user's choice but overrides it, and choosing a shading switches it off
// (ViewState::simpler_when_slow).
#pragma once

namespace palpate::viewer {

struct BodyView;
struct Conversation;

struct ShadingGuardSettings {
  double slow_s = 1.0 / 20.0;  ///< between two pictures, as in PictureScaleSettings
  double slow_for_s = 1.5;     ///< time before it acts: a hitch does not count
  /// Simple pictures take about half the time of others: below this share of `slow_s` there is time to spare.
  double spare_share = 0.35;
  double spare_for_s = 8.0;  ///< time before it returns; doubled after each failed return
  double hitch_s = 0.5;      ///< between two pictures: the program was stopped, not slow
};

class ShadingGuard {
 public:
  using Settings = ShadingGuardSettings;
  explicit ShadingGuard(const Settings& settings = {}) : settings_(settings) {}

  enum class Change : unsigned char { none, simpler, as_requested };
  /// Once a frame: the time since the frame before and the cost of drawing this one. `counts` is false for irrelevant
  /// frames: another thread loads a body, or simpler drawing would gain nothing.
  Change frame(double between_s, double cost_s, bool counts);
  bool simple() const { return simple_; }
  /// The user chose: as requested immediately, and starts over.
  void reset() { *this = ShadingGuard(settings_); }

 private:
  Settings settings_;
  bool simple_ = false;
  double patience_ = 1.0;  ///< grows with every failed return
  double slow_s_ = 0.0;
  double spare_s_ = 0.0;
};

/// Once a frame: lets the guard choose the drawing of the viewer's skin, and notifies the user. `counts`: simpler
/// drawing would gain something.
void guardShading(ShadingGuard& guard, BodyView& seen, double elapsed_s, bool counts, Conversation& user);

}  // namespace palpate::viewer

// Draws the skin simpler while pictures come too slowly, and as it was requested again when there is time to spare.
// Pixels are given up before (picture_scale.h). Pure.
//
//   time between frames, time that a frame took ─► ShadingGuard ─► simple or as requested, and a word to the user
//
// It never changes the user's choice: what it does lies over it, and choosing a shading switches it off
// (ViewState::simpler_when_slow).
#pragma once

namespace palpate::viewer {

struct ViewerState;

struct ShadingGuardSettings {
  double slow_s = 1.0 / 20.0;  ///< between two pictures, as in PictureScaleSettings
  double slow_for_s = 1.5;     ///< so long before it acts: a hitch is no reason
  /// Simple pictures take about half the time of others: below this share of `slow_s` there is time enough.
  double spare_share = 0.35;
  double spare_for_s = 8.0;  ///< so long before it goes back; twice as long after each time that was in vain
  double hitch_s = 0.5;      ///< between two pictures: the program was stopped, not slow
};

class ShadingGuard {
 public:
  using Settings = ShadingGuardSettings;
  explicit ShadingGuard(const Settings& settings = {}) : settings_(settings) {}

  enum class Change : unsigned char { none, simpler, as_requested };
  /// Once a frame: the time since the frame before and what this one cost to draw. `counts` is false for frames that
  /// say nothing: while another thread loads a body, or when nothing is gained by drawing simpler.
  Change frame(double between_s, double cost_s, bool counts);
  bool simple() const { return simple_; }
  /// The user chose: as requested at once, and no opinion any more.
  void reset() { *this = ShadingGuard(settings_); }

 private:
  Settings settings_;
  bool simple_ = false;
  double patience_ = 1.0;  ///< grows with every return that was in vain
  double slow_s_ = 0.0;
  double spare_s_ = 0.0;
};

/// Once a frame: has the guard decide how the viewer's skin is drawn, and the user told. `counts`: something is gained
/// by drawing simpler.
void guardShading(ShadingGuard& guard, ViewerState& viewer, double elapsed_s, bool counts);

}  // namespace palpate::viewer

// Draws the body with fewer pixels while a finger touches or the view turns and pictures come too slowly. Pure.
//
//   time between frames in motion ─► PictureScale ─► pixels along each side of the body's picture, a share of all
//
// Software OpenGL pays for pixels. Fewer of them are given up before the shading is (shading_guard.h), and at rest all
// of them are drawn. Panels and labels always have all.
#pragma once

namespace palpate::viewer {

/// Of the pixels along each side of the picture.
inline constexpr double kMinPictureShare = 0.5;

struct PictureScaleSettings {
  double goal_s = 1.0 / 20.0;  ///< between two pictures; slower ones are not felt as touch
  /// A new share is meant to bring pictures in this part of the goal.
  double aim = 0.85;
  double spare_for_s = 2.0;      ///< so long before more pixels are tried
  double in_vain_s = 4.0;        ///< more pixels taken back within this time: the next try waits twice as long
  double max_patience_s = 60.0;  ///< and no longer than this
};

class PictureScale {
 public:
  using Settings = PictureScaleSettings;
  explicit PictureScale(const Settings& settings = {}) : settings_(settings), patience_s_(settings.spare_for_s) {}

  /// Once a frame that follows another in motion: the time between them, which the share of the earlier one cost.
  void frame(double between_s);
  /// kMinPictureShare to 1, in eighths. Kept from one touch to the next.
  double share() const { return eighths_ / 8.0; }
  void reset() { *this = PictureScale(settings_); }

 private:
  void slow(double between_s);
  void spare(double between_s);

  Settings settings_;
  int eighths_ = 8;
  double last_slow_s_ = 0.0;  ///< of the frame before, if it was slow; one slow frame is a hitch
  double spare_s_ = 0.0;
  double patience_s_;
  double since_raised_s_ = 1e9;
};

}  // namespace palpate::viewer

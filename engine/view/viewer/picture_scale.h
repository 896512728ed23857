// Draws the body with fewer pixels while a finger touches or the view turns and pictures come too slowly. Pure.
//
//   time between frames in motion ─► PictureScale ─► pixels along each side of the body's picture, a share of all
//
// Software OpenGL pays for pixels. They are reduced before the shading is (shading_guard.h), and at rest all of them
// are drawn. Panels and labels always have all.
#pragma once

namespace palpate::viewer {

/// Least share of the pixels along each side of the picture.
inline constexpr double kMinPictureShare = 0.5;

struct PictureScaleSettings {
  double goal_s = 1.0 / 20.0;  ///< between two pictures; slower ones break the feeling of touch
  /// Aim of a new share, as a part of the goal.
  double aim = 0.85;
  double spare_for_s = 2.0;      ///< time before more pixels are tried
  double in_vain_s = 4.0;        ///< more pixels withdrawn within this time: the next try waits twice as long
  double max_patience_s = 60.0;  ///< and no longer than this
};

class PictureScale {
 public:
  using Settings = PictureScaleSettings;
  explicit PictureScale(const Settings& settings = {}) : settings_(settings), patience_s_(settings.spare_for_s) {}

  /// Once per frame after another one in motion: the time between them, which is the cost of the earlier one's share.
  void frame(double between_s);
  /// kMinPictureShare to 1, in eighths. Kept from one touch to the next.
  double share() const { return eighths_ / 8.0; }
  void reset() { *this = PictureScale(settings_); }

 private:
  void slow(double between_s);
  void spare(double between_s);

  Settings settings_;
  int eighths_ = 8;
  double last_slow_s_ = 0.0;  ///< duration of the frame before, if it was slow; one slow frame is a hitch
  double spare_s_ = 0.0;
  double patience_s_;
  double since_raised_s_ = 1e9;
};

}  // namespace palpate::viewer

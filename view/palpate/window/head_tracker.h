// Where the eyes are, from measurements of a head that come now and then, tremble, and sometimes stop. Pure; one
// thread.
//
//   camera │ tracker │ script ─ measured() ─► HeadTracker ─ eyesAt(now) ─► TrackedHead (stereo.h), once a picture
//
// Places are in mm in the frame of the screen: origin in its middle, x right, y up, z towards the head. A low-pass of
// 50 ms takes the trembling away, a prediction of one picture takes back some of its delay. When nothing is heard for
// 200 ms the picture stands still where it was, and after a while it glides to where a head is expected: it never
// jumps, neither when the head is lost nor when it is found again.
#pragma once

#include <optional>

#include "palpate/base/vec.h"

namespace palpate::window {

struct HeadTrackerSettings {
  Vec3 expected_mm = {0.0, 0.0, 600.0};  ///< where the eyes are taken to be while none are seen; z > 0
  Vec3 offset_mm = {0.0, 0.0, 0.0};      ///< from the middle of the screen to the origin of what measures
  double smoothing_s = 0.050;            ///< time constant
  double prediction_s = 1.0 / 60.0;      ///< one picture
  double lost_after_s = 0.200;
  double stand_still_s = 1.0;  ///< lost: before it begins to glide
  double glide_s = 0.5;        ///< time constant of the glide
  double nearest_mm = 100.0;   ///< nearer to the screen nobody looks; keeps the frusta sound
};

class HeadTracker {
 public:
  explicit HeadTracker(const HeadTrackerSettings& settings = {});

  HeadTrackerSettings settings;

  /// Between the eyes, in the frame of what measures. Numbers that are not finite count as not seen.
  void measured(const Vec3& eyes_mm, double now_s);

  /// For the picture that is drawn now; `now_s` must not go back.
  Vec3 eyesAt(double now_s);

  enum class State : unsigned char { waiting, tracking, standing_still, gliding };
  State stateAt(double now_s) const;

 private:
  Vec3 kept(Vec3 eyes) const;
  void follow(const Vec3& place, double elapsed_s);

  Vec3 smooth_;
  Vec3 speed_ = Vec3::Zero();  // mm/s, smoothed as well
  Vec3 shown_;                 // by the last picture
  std::optional<double> heard_s_;
  std::optional<double> asked_s_;
};

}  // namespace palpate::window

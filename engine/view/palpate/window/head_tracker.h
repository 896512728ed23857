// Estimates the eyes from measurements of a head that are irregular, tremble, and sometimes stop. Pure; one thread.
//
//   camera │ tracker │ script ─ measured() ─► HeadTracker ─ eyesAt(now) ─► TrackedHead (stereo.h), once a picture
//
// Places are in mm in the frame of the screen: origin in its middle, x right, y up, z towards the head. A low-pass of
// 50 ms removes the trembling, a prediction of one picture makes up for some of its delay. After 200 ms of silence the
// picture freezes, and after a while it glides to the expected head: it never jumps, neither when the head is lost nor
// when it is found again.
#pragma once

#include <optional>

#include "palpate/base/vec.h"

namespace palpate::window {

struct HeadTrackerSettings {
  Vec3 expected_mm = {0.0, 0.0, 600.0};  ///< assumed place of the eyes while none are seen; z > 0
  Vec3 offset_mm = {0.0, 0.0, 0.0};      ///< from the middle of the screen to the origin of the tracker
  double smoothing_s = 0.050;            ///< time constant
  double prediction_s = 1.0 / 60.0;      ///< one picture
  double lost_after_s = 0.200;
  double stand_still_s = 1.0;  ///< after a loss, before it begins to glide
  double glide_s = 0.5;        ///< time constant of the glide
  double nearest_mm = 100.0;   ///< eyes are never nearer to the screen; keeps the frusta sound
};

class HeadTracker {
 public:
  explicit HeadTracker(const HeadTrackerSettings& settings = {});

  HeadTrackerSettings settings;

  /// Between the eyes, in the frame of the tracker. Numbers that are not finite count as not seen.
  void measured(const Vec3& eyes_mm, double now_s);

  /// For the present picture; `now_s` must not go back.
  Vec3 eyesAt(double now_s);

  enum class State : unsigned char { waiting, tracking, standing_still, gliding };
  State stateAt(double now_s) const;

 private:
  Vec3 kept(Vec3 eyes) const;
  void follow(const Vec3& place, double elapsed_s);

  Vec3 smooth_;
  Vec3 speed_ = Vec3::Zero();  // mm/s, smoothed as well
  Vec3 shown_;                 // in the last picture
  std::optional<double> heard_s_;
  std::optional<double> asked_s_;
};

}  // namespace palpate::window

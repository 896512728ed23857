// Where the skin is pale because a finger pressed the blood away, and for how long.
//
// A finger that presses makes a mark where its anchor is and leaves marks behind as it slides; each refills after the
// finger has gone. No GL: numbers in, numbers out.
//
//   presses of this picture, time ─► Blanching ─► marks, the strongest first ─► SkinPaint, where the skin is drawn
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::view {

/// In coordinates of the skin at rest.
struct PressMark {
  Vec3f place = Vec3f::Zero();
  float radius_mm = 8.0f;
  float strength = 0.0f;  ///< 0 to 1
};

/// A finger that presses now.
struct Press {
  Vec3 anchor = Vec3::Zero();  ///< on the skin at rest
  double radius_mm = 8.0;
  double depth_mm = 0.0;
};

inline constexpr std::size_t kMostMarks = 8;
/// Skin of a healthy back has its colour again after this time.
inline constexpr double kRefillS = 1.5;

class Blanching {
 public:
  /// The marks at this time, the strongest first, at most kMostMarks. The same presses and time again change nothing;
  /// a time before the last one forgets everything (a replay that was wound back).
  std::span<const PressMark> at(double time_s, std::span<const Press> presses);

 private:
  struct Trace {
    PressMark mark;
    double last_pressed_s = 0.0;
  };
  void press(const Press& press, double time_s);

  std::vector<Trace> traces_;
  std::vector<PressMark> marks_;
  double time_s_ = 0.0;
};

}  // namespace palpate::view

// Objects before the back in the second picture: a stick, the hand that holds it, the forearm, and their shadow.
// Private to the folder: nothing outside it sees OpenCV.
#pragma once

#include <opencv2/core.hpp>

#include "palpate/base/vec.h"
#include "palpate/measure/synthesis/synthetic_case.h"

namespace palpate::measure {

struct StickPicture {
  cv::Mat cover;   ///< CV_8U of the whole picture: 255 where the skin is hidden; empty without a stick
  cv::Mat colour;  ///< CV_8UC3, linear light as the square of its value / 255
  cv::Mat shadow;  ///< CV_8U: how much of the light is taken away
};

/// `tip_px`: where it touches; `away_px`: from there along the stick, of length 1; sizes by `px_per_mm`.
StickPicture drawStick(const SyntheticCase& made, const Vec2& tip_px, const Vec2& away_px, double px_per_mm);

}  // namespace palpate::measure

// The skin of a synthetic back, painted flat on its chart: colour, blotches, moles, pimples, hairs, and the ink.
// Private to the folder: nothing outside it sees OpenCV.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/measure/dot_grid.h"
#include "palpate/measure/synthesis/synthetic_case.h"

namespace palpate::measure {

/// One mark of the stencil: where the hand set it.
struct InkMark {
  GridSite site;  ///< a stray's: 0, 0
  Vec2 skin_mm = Vec2::Zero();
  double radius_mm = 0.0;
};

struct InkMarks {
  std::vector<InkMark> dots;  ///< without those that are missing
  std::vector<InkMark> strays;
};

InkMarks makeInkMarks(const DotMarks& marks);

/// Share of light given back by the skin, linear, red, green, blue, as 16 bits (65535: all).
struct SkinTexture {
  cv::Mat albedo;  ///< CV_16UC3; row 0 is the head's end
  double texels_per_mm = 4.0;

  /// A place of the skin, in texels from the centre of the first.
  cv::Point2f toTexel(const Vec2& skin_mm) const;
};

SkinTexture paintSkin(const SyntheticCase& made, const InkMarks& marks, double texels_per_mm);

/// From screen values, 0 to 1, to light.
double decodeSrgb(double shown);
/// Linear, of the skin colours 0 to 3.
cv::Vec3f skinColour(int colour);

}  // namespace palpate::measure

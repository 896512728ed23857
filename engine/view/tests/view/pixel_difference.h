// How far two pictures are apart, pixel by pixel.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "palpate/view/image.h"

namespace palpate::view {

/// Of the channel that differs most, in levels of 256.
inline int difference(const Pixel& a, const Pixel& b) {
  int largest = 0;
  for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(int{a[i]} - int{b[i]}));
  return largest;
}

/// Of the pixel that differs most. Both pictures have the same size.
inline int largestDifference(const Image& a, const Image& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) largest = std::max(largest, difference(a.pixels[i], b.pixels[i]));
  return largest;
}

}  // namespace palpate::view

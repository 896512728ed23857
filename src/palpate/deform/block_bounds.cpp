#include "palpate/deform/block_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/deform/skin.h"

namespace palpate::deform {

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
/// A few roundings of a float: boxes are that much wider, so that what holds for the box holds for every vertex as the
/// kernels round it.
constexpr float kRounding = 1e-6f;

struct Interval {
  float centre;
  float half;
};

Interval intervalOf(std::span<const float> values) {
  if (!std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); })) return {kNan, kNan};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const float centre = 0.5f * *low + 0.5f * *high;
  const float half = std::max(*high - centre, centre - *low);
  return {centre, half + kRounding * (half + std::abs(centre))};
}

}  // namespace

FloatStreams boundsOfBlocks(const Skin& skin) {
  FloatStreams bounds(12, std::size_t{blocksFor(skin.blocks)} * kTileBlocks, 0);
  for (Index block = 0; block < skin.blocks; ++block) {
    const RestBlock rest = skin.restBlock(block);
    const Index count = std::min(kBlockVertices, skin.vertices - block * kBlockVertices);
    for (std::size_t i = 0; i < 6; ++i) {
      const auto [centre, half] = intervalOf({rest.values[i], count});
      const std::size_t first = i < 3 ? 0 : 6;
      bounds[first + i % 3][block] = centre;
      bounds[first + 3 + i % 3][block] = half;
    }
  }
  return bounds;
}

}  // namespace palpate::deform

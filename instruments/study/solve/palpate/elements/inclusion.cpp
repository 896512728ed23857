// Mesh lines follow a wanted size of elements: as without lump, but no larger than a twelfth of the lump in it and
// growing slowly away from it.
#include "palpate/elements/inclusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "palpate/base/error.h"

namespace palpate::elements {

namespace {

constexpr double kElementsAcross = 12.0;
constexpr double kGrowthAway = 0.2;  // mm of size per mm of distance

/// Adds borders after the last one up to `to`, at least `fewest` steps, each about `size` long there.
void addBorders(std::vector<double>& borders, double to, int fewest, const std::function<double(double)>& size) {
  constexpr int kSamples = 200;
  const double from = borders.back();
  std::vector<double> steps = {0.0};
  for (int i = 0; i < kSamples; ++i) {
    steps.push_back(steps.back() + (to - from) / kSamples / size(from + (to - from) * (i + 0.5) / kSamples));
  }
  const int count = std::max(fewest, static_cast<int>(std::ceil(steps.back() - 0.05)));
  std::size_t sample = 0;
  for (int i = 1; i < count; ++i) {
    const double wanted = steps.back() * i / count;
    while (steps[sample + 1] < wanted) ++sample;
    const double share = (wanted - steps[sample]) / (steps[sample + 1] - steps[sample]);
    borders.push_back(from + (to - from) * (static_cast<double>(sample) + share) / kSamples);
  }
  borders.push_back(to);
}

/// 1 inside, 0 outside, smooth between where the edge is soft. `s`: 1 on the lump's surface.
double fullness(double s, double edge) {
  if (s >= 1.0) return 0.0;
  if (s <= 1.0 - edge) return 1.0;
  const double out = (s - (1.0 - edge)) / edge;
  return 1.0 - out * out * (3.0 - 2.0 * out);
}

}  // namespace

double youngModulusAt(const Inclusion& lump, double radius_mm, double depth_mm, double layer_kpa) {
  if (!lump.young_kpa) return layer_kpa;
  const double s = std::hypot(radius_mm / lump.across_mm, (depth_mm - lump.centreMm()) / lump.into_mm);
  return layer_kpa + (*lump.young_kpa - layer_kpa) * fullness(s, lump.edge);
}

void check(const Inclusion& lump, const tissue::LayerStack& stack) {
  const double total = tissue::totalThickness(stack);
  if (!(lump.top_mm > 0.0 && lump.into_mm > 0.0 && lump.across_mm > 0.0 && lump.bottomMm() < total)) {
    throw Error(fmt::format("a lump from {:g} to {:g} mm under the skin must be within the layers, {:g} mm",
                            lump.top_mm, lump.bottomMm(), total));
  }
  if (lump.across_mm > 50.0)
    throw Error(fmt::format("a lump {:g} mm across is too wide; it must be at most 100 mm", 2.0 * lump.across_mm));
  if (!(lump.edge >= 0.0 && lump.edge <= 1.0))
    throw Error(fmt::format("the lump's edge is {:g}; it must be 0 to 1", lump.edge));
  if (lump.young_kpa && !(*lump.young_kpa >= 0.01 && *lump.young_kpa <= 1e6)) {
    throw Error(fmt::format("the lump's modulus is {:g} kPa; it must be 0.01 to 1e6", *lump.young_kpa));
  }
}

std::vector<double> bordersAlong(const Spacing& spacing, const Inclusion& lump) {
  const double inside = 2.0 * lump.across_mm / kElementsAcross;
  const auto size = [&](double r) {
    const double away = std::max(0.0, r - spacing.uniform_to_mm);
    const double without = std::min(spacing.first_mm + (spacing.growth - 1.0) * away, spacing.widest_mm);
    return std::min(without, inside + kGrowthAway * std::max(0.0, r - lump.across_mm));
  };
  std::vector<double> borders = {0.0};
  addBorders(borders, lump.across_mm, 3, size);
  addBorders(borders, spacing.to_mm, 1, size);
  return borders;
}

LayerRows layerRows(const tissue::LayerStack& stack, const RowFineness& fineness, const Inclusion& lump) {
  constexpr double kHeightADepth = 0.15;  // as without lump (grid_borders.cpp)
  constexpr double kGrowthInLayer = 0.2;
  const double inside = 2.0 * lump.into_mm / kElementsAcross;
  LayerRows rows{{0.0}, {}};
  double top = 0.0;
  for (std::size_t layer = 0; layer < stack.layers.size(); ++layer) {
    const double bottom = top + stack.layers[layer].thickness_mm;
    const auto size = [&](double depth) {
      const double first = std::max(fineness.first_mm, kHeightADepth * top);
      const double away = std::max({0.0, lump.top_mm - depth, depth - lump.bottomMm()});
      return std::min(first + kGrowthInLayer * (depth - top), inside + kGrowthAway * away);
    };
    std::vector<double> ends;
    for (const double line : {lump.top_mm, lump.centreMm(), lump.bottomMm()}) {
      constexpr double kApart = 0.05;  // mm; a border of the layer is nearly there already
      if (line > top + kApart && line < bottom - kApart) ends.push_back(line);
    }
    ends.push_back(bottom);
    const int fewest = ends.size() == 1 ? fineness.fewest : 1;
    for (const double end : ends) addBorders(rows.depths_mm, end, fewest, size);
    rows.layers.resize(rows.depths_mm.size() - 1, static_cast<int>(layer));
    top = bottom;
  }
  return rows;
}

}  // namespace palpate::elements

#include "palpate/elements/grid_borders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"

namespace palpate::elements {

void checkSize(const char* what, double value, double least, double most) {
  if (value >= least && value <= most) return;
  throw Error(fmt::format("{} is {:g}; it must be {:g} to {:g}", what, value, least, most));
}

std::vector<double> bordersAlong(const Spacing& spacing) {
  std::vector<double> borders = {0.0};
  const double uniform_to = std::min(spacing.uniform_to_mm, spacing.to_mm);
  const int uniform = std::max(1, static_cast<int>(std::lround(uniform_to / spacing.first_mm)));
  for (int i = 1; i <= uniform; ++i) borders.push_back(uniform_to * i / uniform);
  double step = uniform_to / uniform;
  constexpr double kNearlyThere = 1e-9;
  while (borders.back() < spacing.to_mm - kNearlyThere) {
    step = std::min(step * spacing.growth, spacing.widest_mm);
    borders.push_back(borders.back() + step);
  }
  const double scale = spacing.to_mm / borders.back();
  for (double& border : borders) border *= scale;
  return borders;
}

namespace {

/// Heights of the rows of one layer whose top lies at `depth`, from the top.
std::vector<double> rowHeights(double thickness, double depth, const RowFineness& fineness) {
  constexpr double kHeightADepth = 0.15;  // far below the surface nothing is small
  constexpr double kGrowth = 1.25;
  const double first = std::max(fineness.first_mm, kHeightADepth * depth);
  const bool thick = thickness > 3.0 * first;
  std::vector<double> heights;
  double sum = 0.0;
  double height = first;
  while (sum < thickness - 1e-9 && static_cast<int>(heights.size()) < fineness.most) {
    heights.push_back(height);
    sum += height;
    if (thick) height *= kGrowth;
  }
  if (static_cast<int>(heights.size()) < fineness.fewest) {
    heights.assign(static_cast<std::size_t>(fineness.fewest), 1.0);
    sum = fineness.fewest;
  }
  for (double& one : heights) one *= thickness / sum;
  return heights;
}

}  // namespace

LayerRows layerRows(const tissue::LayerStack& stack, const RowFineness& fineness) {
  LayerRows rows{{0.0}, {}};
  double depth = 0.0;
  for (std::size_t layer = 0; layer < stack.layers.size(); ++layer) {
    const double thickness = stack.layers[layer].thickness_mm;
    double within = 0.0;
    for (const double height : rowHeights(thickness, depth, fineness)) {
      within += height;
      rows.depths_mm.push_back(depth + within);
      rows.layers.push_back(static_cast<int>(layer));
    }
    depth += thickness;
    rows.depths_mm.back() = depth;
  }
  return rows;
}

}  // namespace palpate::elements

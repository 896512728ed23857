#include "palpate/elements/probe_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/elements/hex_block.h"

namespace palpate::elements {

namespace {

/// A line on the probe's edge, and from there both ways in growing steps: the pressure has no bounds at the edge.
std::vector<double> linesTo(double half_probe_mm, double half_block_mm, double fineness) {
  const double growth = 1.0 + 0.5 / fineness;
  std::vector<double> inwards = {0.0};
  for (double step = 0.6 / fineness; inwards.back() < half_probe_mm; step *= growth) {
    inwards.push_back(inwards.back() + step);
  }
  std::vector<double> lines;
  for (auto way = inwards.rbegin(); way != inwards.rend(); ++way) {
    lines.push_back(half_probe_mm * (1.0 - *way / inwards.back()));
  }
  const double first = lines.back() - lines[lines.size() - 2];
  const double widest = 14.0 / fineness;
  for (double step = first; lines.back() + step < half_block_mm; step = std::min(step * growth, widest)) {
    lines.push_back(lines.back() + step);
  }
  // No sliver at the end.
  if (half_block_mm - lines.back() < lines.back() - lines[lines.size() - 2] && lines.back() > half_probe_mm) {
    lines.back() = half_block_mm;
  } else {
    lines.push_back(half_block_mm);
  }
  return lines;
}

/// The deepest layer continues down to the middle of the bone.
tissue::LayerStack withBone(tissue::LayerStack stack, double bone_radius_mm) {
  if (bone_radius_mm > 0.0) {
    tissue::Layer around = stack.layers.back();
    around.thickness_mm = bone_radius_mm;
    stack.layers.push_back(around);
  }
  return stack;
}

HexBlock blockUnder(const tissue::LayerStack& stack, double half_width_mm, const ProbeSettings& settings) {
  const double fineness = settings.fineness;
  return {stack, linesTo(0.5 * settings.length_mm, settings.half_length_mm, fineness),
          linesTo(0.5 * settings.width_mm, half_width_mm, fineness),
          layerRows(stack, {.first_mm = 0.8 / fineness,
                            .fewest = static_cast<int>(std::ceil(2.0 * fineness)),
                            .most = static_cast<int>(std::ceil(9.0 * fineness))})};
}

/// Depth of the bone at `y` to the side; infinite where it does not reach.
double boneDepth(double y, double cover_mm, double bone_radius_mm) {
  if (bone_radius_mm == 0.0) return cover_mm;
  if (y >= bone_radius_mm) return std::numeric_limits<double>::infinity();
  return cover_mm + bone_radius_mm - std::sqrt(bone_radius_mm * bone_radius_mm - y * y);
}

/// The row nearest to the bone's surface; those below are in the bone. `deep()` if the block ends above it.
int boneRow(const HexBlock& block, double bone_depth_mm) {
  const std::vector<double>& rows = block.rows.depths_mm;
  if (bone_depth_mm > rows.back()) return block.deep();
  int row = 0;
  while (row + 1 < block.deep() && std::abs(rows[static_cast<std::size_t>(row) + 1] - bone_depth_mm) <
                                       std::abs(rows[static_cast<std::size_t>(row)] - bone_depth_mm)) {
    ++row;
  }
  return row;
}

HexBoundary boundaryUnder(const HexBlock& block, double cover_mm, const ProbeSettings& settings) {
  constexpr double kOnTheEdge = 1e-9;
  const bool plane = settings.bone_radius_mm == 0.0;
  HexBoundary boundary(block);
  for (int j = 0; j < block.alongY(); ++j) {
    const double y = block.y_mm[static_cast<std::size_t>(j)];
    const int bone_row = boneRow(block, boneDepth(y, cover_mm, settings.bone_radius_mm));
    for (int i = 0; i < block.alongX(); ++i) {
      const double x = block.x_mm[static_cast<std::size_t>(i)];
      const bool under = x < 0.5 * settings.length_mm + kOnTheEdge && y < 0.5 * settings.width_mm + kOnTheEdge;
      for (int k = 0; k < block.deep(); ++k) {
        const int place = 3 * block.node(i, j, k);
        const bool held = k >= bone_row || i + 1 == block.alongX() || (plane && j + 1 == block.alongY());
        const bool moved = k == 0 && under;
        if (held || i == 0) boundary.hold(place);
        if (held || j == 0) boundary.hold(place + 1);
        if (held || moved) boundary.hold(place + 2);
        if (moved) boundary.given[place + 2] = 1.0;
      }
    }
  }
  return boundary;
}

void checkProbe(const tissue::LayerStack& stack, const ProbeSettings& settings) {
  tissue::check(stack);
  checkSize("the probe's length (mm)", settings.length_mm, 2.0, 200.0);
  checkSize("the probe's width (mm)", settings.width_mm, 2.0, 200.0);
  checkSize("the bone's radius (mm)", settings.bone_radius_mm, 0.0, 100.0);
  checkSize("half the block's length (mm)", settings.half_length_mm, settings.length_mm, 2000.0);
  checkSize("the mesh's fineness", settings.fineness, 0.5, 4.0);
  if (settings.bone_radius_mm == 0.0) return;
  checkSize("half the limb's width (mm)", tissue::totalThickness(stack) + settings.bone_radius_mm,
            0.5 * settings.width_mm + 1.0, 2000.0);
}

}  // namespace

double probeStiffness(const tissue::LayerStack& stack, const ProbeSettings& settings) {
  checkProbe(stack, settings);
  const double cover = tissue::totalThickness(stack);
  const tissue::LayerStack whole = withBone(stack, settings.bone_radius_mm);
  const double half_width = settings.bone_radius_mm > 0.0 ? cover + settings.bone_radius_mm : settings.half_length_mm;
  const HexBlock block = blockUnder(whole, half_width, settings);
  return solveHexBlock(block, boundaryUnder(block, cover, settings), "press of the probe").n_per_mm;
}

}  // namespace palpate::elements

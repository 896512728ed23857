#include "palpate/elements/drag_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/elements/hex_block.h"

namespace palpate::elements {

namespace {

enum class Load { drag, press };

/// The same lines along x and along y.
HexBlock blockOf(const tissue::LayerStack& stack, const DragSettings& settings) {
  const std::vector<double> lines = bordersAlong({.first_mm = 1.5 / settings.fineness,
                                                  .uniform_to_mm = 12.0,
                                                  .growth = 1.0 + 0.22 / settings.fineness,
                                                  .widest_mm = 12.0 / settings.fineness,
                                                  .to_mm = settings.half_width_mm});
  return {stack, lines, lines,
          layerRows(stack, {.first_mm = 2.5 / settings.fineness,
                            .fewest = static_cast<int>(std::ceil(2.0 * settings.fineness)),
                            .most = static_cast<int>(std::ceil(6.0 * settings.fineness))})};
}

HexBoundary makeBoundary(const HexBlock& block, double patch_radius_mm, Load load) {
  HexBoundary boundary(block);
  const int last = block.alongX() - 1;
  for (int i = 0; i <= last; ++i) {
    for (int j = 0; j <= last; ++j) {
      const double from_middle =
          std::hypot(block.x_mm[static_cast<std::size_t>(i)], block.y_mm[static_cast<std::size_t>(j)]);
      for (int k = 0; k < block.deep(); ++k) {
        const int x = 3 * block.node(i, j, k);
        const bool patch = k == 0 && from_middle <= patch_radius_mm;
        const bool held = i == last || j == last || k == block.deep() - 1;
        // Seen in the plane x = 0 a drag along x turns round, a press is the same.
        if (held || patch || (i == 0 && load == Load::press)) boundary.hold(x);
        if (held || patch || j == 0 || (i == 0 && load == Load::drag)) boundary.hold(x + 1);
        if (held || patch || (i == 0 && load == Load::drag)) boundary.hold(x + 2);
        if (patch) boundary.given[x + (load == Load::drag ? 0 : 2)] = 1.0;
      }
    }
  }
  return boundary;
}

HexMotion solved(const HexBlock& block, const DragSettings& settings, Load load) {
  return solveHexBlock(block, makeBoundary(block, settings.patch_radius_mm, load), "drag");
}

void check(const tissue::LayerStack& stack, const DragSettings& settings) {
  tissue::check(stack);
  const double patch = settings.patch_radius_mm;
  if (!(patch >= 2.0 && patch <= 50.0)) throw Error(fmt::format("the patch is {:g} mm; it must be 2 to 50 mm", patch));
  if (!(settings.half_width_mm >= 4.0 * patch && settings.half_width_mm <= 2000.0)) {
    throw Error(fmt::format("the block is {:g} mm to each side; it must be four radii of the patch to 2000 mm",
                            settings.half_width_mm));
  }
  checkSize("the mesh's fineness", settings.fineness, 0.5, 4.0);
}

/// Bilinear in the quarter's grid.
double between(const std::vector<double>& lines, const std::vector<double>& values, double x, double y) {
  const auto cell = [&](double value) {
    const auto after = std::upper_bound(lines.begin() + 1, lines.end() - 1, value);
    return static_cast<std::size_t>(after - lines.begin()) - 1;
  };
  const std::size_t i = cell(x);
  const std::size_t j = cell(y);
  const double s = std::min(1.0, (x - lines[i]) / (lines[i + 1] - lines[i]));
  const double t = std::min(1.0, (y - lines[j]) / (lines[j + 1] - lines[j]));
  const std::size_t size = lines.size();
  const auto value = [&](std::size_t a, std::size_t b) { return values[a * size + b]; };
  return (1.0 - s) * ((1.0 - t) * value(i, j) + t * value(i, j + 1)) +
         s * ((1.0 - t) * value(i + 1, j) + t * value(i + 1, j + 1));
}

}  // namespace

double DragField::at(double x, double y) const { return between(lines_mm, along, x, y); }

Vec2 DragField::movedAt(const Vec2& place_mm) const {
  const double x = std::abs(place_mm.x());
  const double y = std::abs(place_mm.y());
  if (std::max(x, y) >= lines_mm.back()) return Vec2::Zero();
  const double sign = (place_mm.x() < 0.0) == (place_mm.y() < 0.0) ? 1.0 : -1.0;
  return {between(lines_mm, along, x, y), sign * between(lines_mm, across, x, y)};
}

DragField solveDragField(const tissue::LayerStack& stack, const DragSettings& settings, const Progress& progress) {
  check(stack, settings);
  const HexBlock block = blockOf(stack, settings);
  report(progress, "dragging", 0.0);
  const HexMotion dragged = solved(block, settings, Load::drag);
  report(progress, "dragging", 0.6);
  const HexMotion pressed = solved(block, settings, Load::press);
  report(progress, "dragging", 1.0);
  DragField field;
  field.lines_mm = block.x_mm;
  for (int i = 0; i < block.alongX(); ++i) {
    for (int j = 0; j < block.alongY(); ++j) {
      field.along.push_back(dragged.displacement[3 * block.node(i, j, 0)]);
      field.across.push_back(dragged.displacement[3 * block.node(i, j, 0) + 1]);
    }
  }
  field.drag_n_per_mm = dragged.n_per_mm;
  field.press_n_per_mm = pressed.n_per_mm;
  return field;
}

}  // namespace palpate::elements

// The skin dragged sideways a little: a round patch of it, bonded to the finger, on layers over bone. Linear, three
// dimensions, 8-node boxes; one quarter represents the whole.
//
// The same patch pressed straight down gives the drag's share of the stiffness against a press.
#pragma once

#include <vector>

#include "palpate/base/progress.h"
#include "palpate/base/vec.h"
#include "palpate/tissue/layered_table.h"

namespace palpate::elements {

struct DragSettings {
  double patch_radius_mm = 6.0;
  double half_width_mm = 150.0;  ///< to each side of the square block; its sides and its base are held
  double fineness = 1.0;         ///< 2: elements half as large
};

/// Solution of a drag by 1 mm along x, on the quarter of the surface where x, y >= 0.
struct DragField {
  std::vector<double> lines_mm;         ///< lines of the grid, along x and along y alike, from 0
  std::vector<double> along;            ///< u_x; that of x = lines[i], y = lines[j] at i * size + j
  std::vector<double> across;           ///< u_y, in the same order
  double drag_n_per_mm = 0.0;           ///< stiffness of the whole patch along x
  double press_n_per_mm = 0.0;          ///< and straight down
  double at(double x, double y) const;  ///< u_x between the lines, x and y >= 0
  /// Along the skin, anywhere: the other quarters by symmetry; nothing moves beyond the block.
  Vec2 movedAt(const Vec2& place_mm) const;
};

/// Throws Error for sizes that make no sense, and where the equations are not solved. Work ends when `progress` throws.
DragField solveDragField(const tissue::LayerStack& stack, const DragSettings& settings, const Progress& progress = {});

/// (1 + q^2)^-p fitted to the quarter square from 0 to `to_mm`, and the solution at the radii.
struct FittedDrag {
  tissue::DragShape shape;
  double rms = 0.0;  ///< misfit over the square, share of the drag
};
FittedDrag fitDrag(const DragField& field, const std::vector<double>& radii_mm, double to_mm = 60.0);

}  // namespace palpate::elements

// Numbers that people compare pressed skin by: how wide the dent is, how much it bulges, how far it is drawn in. For
// tables, pictures and texts; no tick uses them.
#pragma once

#include <optional>

#include "palpate/tissue/layered_table.h"

namespace palpate::tissue {

struct PressedNumbers {
  double secant_n_per_mm = 0.0;          ///< force over depth
  std::optional<double> half_radius_mm;  ///< where the skin goes down half as far as on the axis; none: nowhere
  std::optional<double> tenth_radius_mm;
  double bulge_mm = 0.0;       ///< the highest that the skin rises above where it was, >= 0
  double drawn_in_mm = 0.0;    ///< the most that it moves towards the axis, >= 0
  double pushed_out_mm = 0.0;  ///< and away from it, >= 0
};

/// `shape`: one of this table's, or from shapeAt.
PressedNumbers numbersOf(const LayeredTable& table, const PressedShape& shape);

/// Straight between the two stored depths around it; a depth outside of them is moved to the nearest. The table must
/// have a shape.
PressedShape shapeAt(const LayeredTable& table, double depth_mm);

/// "2 x 150 + 8 x 10 + 30 x 27": mm x kPa from the skin down; "layers unknown" of a fitted table without them.
std::string formatStack(const LayerStack& stack);

}  // namespace palpate::tissue

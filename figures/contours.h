// Lines of equal value through a field.
//
// Marching squares with linear interpolation along the grid's edges, the pieces joined into lines; a cell with a corner
// outside (NaN) has none. Based on: Lorensen and Cline, "Marching cubes", 1987, in two dimensions.
#pragma once

#include <vector>

#include "figures/plot.h"

namespace palpate::figures {

/// The lines of one level, in the field's coordinates; a closed line ends where it began. A value equal to the level
/// counts as above it.
std::vector<std::vector<Vec2>> contourLines(const Field& field, double level);

}  // namespace palpate::figures

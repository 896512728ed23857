// Where the elements' borders lie: along the surface, fine near the axis; downwards, a few rows a layer.
#pragma once

#include <vector>

#include "palpate/tissue/layered_table.h"

namespace palpate::elements {

/// Throws Error, which names `what`, for a value out of range.
void checkSize(const char* what, double value, double least, double most);

struct Spacing {
  double first_mm = 0.7;
  double uniform_to_mm = 14.0;  ///< beyond, steps grow by `growth` up to `widest_mm`
  double growth = 1.12;
  double widest_mm = 8.0;
  double to_mm = 150.0;
};

/// From 0 to `to_mm`; all steps are scaled a little, so that the last ends there.
std::vector<double> bordersAlong(const Spacing& spacing);

struct RowFineness {
  double first_mm = 1.0;  ///< height of the skin's rows; deeper ones are higher
  int fewest = 2;         ///< per layer
  int most = 14;
};

/// From the surface down; one row between two depths.
struct LayerRows {
  std::vector<double> depths_mm;  ///< from 0
  std::vector<int> layers;        ///< layer of the stack for each row
};

LayerRows layerRows(const tissue::LayerStack& stack, const RowFineness& fineness);

}  // namespace palpate::elements

// A lump in the solver's layers: where the modulus is another, and the mesh lines that go with it.
#pragma once

#include <optional>

#include "palpate/elements/grid_borders.h"
#include "palpate/tissue/layered_table.h"

namespace palpate::elements {

/// An ellipsoid of revolution about the axis of the press.
struct Inclusion {
  double across_mm = 5.0;  ///< half axis along the skin
  double into_mm = 5.0;    ///< half axis into the body
  double top_mm = 8.0;     ///< under the skin at rest
  double edge = 0.0;       ///< share of the radius over which the modulus falls smoothly to the tissue's
  /// None: as the tissue around it, so that only its mesh lines are there. A press of it and one of a lump differ by
  /// the lump alone.
  std::optional<double> young_kpa = {};

  double centreMm() const { return top_mm + into_mm; }
  double bottomMm() const { return top_mm + 2.0 * into_mm; }
};

/// kPa at a place at rest, in a layer of this modulus.
double youngModulusAt(const Inclusion& lump, double radius_mm, double depth_mm, double layer_kpa);

/// Throws Error where it does not lie between the skin's surface and the base.
void check(const Inclusion& lump, const tissue::LayerStack& stack);

/// Borders at the lump's side, and at its top, equator and bottom; 12 elements or more across it.
std::vector<double> bordersAlong(const Spacing& spacing, const Inclusion& lump);
LayerRows layerRows(const tissue::LayerStack& stack, const RowFineness& fineness, const Inclusion& lump);

}  // namespace palpate::elements

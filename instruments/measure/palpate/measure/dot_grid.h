// The order of the dots: which belongs to which row and column of the stencil.
//
//   FoundDots ─ growGrid ─► DotGrid ─► matchDots, fitChart (skin_chart.h)
#pragma once

#include <span>
#include <vector>

#include "palpate/measure/dots.h"

namespace palpate::measure {

/// Site of the stencil: column to the right of the picture, row up in it; any origin.
struct GridSite {
  int column = 0;
  int row = 0;
  bool operator==(const GridSite&) const = default;
};

struct GridDot {
  GridSite site;
  Dot dot;
};

struct DotGrid {
  std::vector<GridDot> dots;
  std::vector<Dot> strays;    ///< same ink, but not on a site of the grid
  double spacing_px = 0.0;    ///< median distance of neighbours; 0 without a grid
  double irregularity = 0.0;  ///< median misfit of a dot to its neighbours, left out by turns, of a spacing
  double roll_deg = 0.0;      ///< turn of the columns from the picture's upright, -45 to 45
};

/// Grows a lattice from the best seeds. Empty if no seed grows.
DotGrid growGrid(std::span<const Dot> dots);

}  // namespace palpate::measure

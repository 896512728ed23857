// Dots of ink on skin: found in one picture by their hue, put in order, and found again in the second picture.
//
//   Photograph ─ findDots ─► FoundDots ─► growGrid
//
// Pictures count pixels from the centre of the top left one, x to the right, y down.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/measure/photograph.h"

namespace palpate::measure {

/// The colour of a pen as a step from the skin beneath: an angle in the plane of CIELAB's a and b.
struct Ink {
  double hue_rad = 0.0;
  double peak_chroma = 0.0;  ///< peak of the middle dot, in units of a and b (8 bits)
};

struct Dot {
  Vec2 place_px = Vec2::Zero();
  double area_px = 0.0;  ///< in the full picture; 0: not known
};

struct FoundDots {
  std::vector<Dot> dots;
  Ink ink;
};

/// All marks of the commonest ink, strays among them, or those of the given ink (of the other picture of a pair). Few
/// or none are not an error. One thread; 0.5 s for 12 megapixels.
FoundDots findDots(const Photograph& picture, const std::optional<Ink>& ink = {});

// The order of the dots: which belongs to which row and column of the stencil.
//
//   FoundDots ─ growGrid ─► DotGrid ─► matchDots, fitChart (skin_chart.h)

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

// Matches dots of the second picture with those of the grid.
//
//   DotGrid, marks of the second picture ─ matchDots ─► DotMatch ─► fitField ─ matchAt ─► DotMatch, twice

struct DotMatch {
  std::vector<std::optional<std::size_t>> of;  ///< one a dot of the grid: its mark in the second picture
  std::size_t count = 0;
};

/// From nothing: a common shift of the dots that hardly moved, then inwards from dot to dot.
DotMatch matchDots(const DotGrid& grid, std::span<const Dot> after);

/// Matches at a fit's predictions, px: closer, and without dots that are partly hidden.
DotMatch matchAt(const DotGrid& grid, std::span<const Vec2> predicted_px, std::span<const Dot> after);

// Prediction of a site from its neighbours: a plane, or with many neighbours a bent surface, through their values.

struct Neighbour {
  Vec2 offset = Vec2::Zero();  ///< sites from the predicted one
  Vec2 value = Vec2::Zero();
};

struct Trend {
  Vec2 value = Vec2::Zero();  ///< at the site
  Mat2 slope = Mat2::Zero();  ///< d value / d site
};

/// None where the neighbours lie in one line. From `bent_from` neighbours on it is quadratic.
std::optional<Trend> fitTrend(const std::vector<Neighbour>& neighbours, std::size_t bent_from = 12);

}  // namespace palpate::measure

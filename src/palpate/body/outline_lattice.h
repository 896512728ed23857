// The triangular lattice inside an outline: which of its points are kept, how many triangles they make, and their rim.
//
// First half of the outline mesher: everything here is counted before a single triangle is made, because the search for
// the cell size asks many times.
#pragma once

#include <vector>

#include "palpate/body/outline_mesher.h"

namespace palpate::body {

/// Rows of lattice points at a constant q. Row j holds the half-steps -reach[j], -reach[j] + 2, ..., reach[j]; a
/// half-step k lies at p = k * cell / 2, and k has the parity of j, so that neighbouring rows are staggered.
struct Lattice {
  double cell = 0;       ///< edge length, mm
  double first_row = 0;  ///< q of row 0
  std::vector<int> reach;

  double rowHeight() const;
  Vec2 point(int row, int half_step) const { return {0.5 * cell * half_step, first_row + row * rowHeight()}; }
  int rows() const { return static_cast<int>(reach.size()); }
};

/// A lattice point: row and half-step.
struct LatticePoint {
  int row;
  int half_step;
};

/// The largest lattice of this cell size that stays inside the outline by a margin and is a disc.
Lattice fitLattice(const FlatOutline& outline, double cell);

/// Triangles between row and row + 1.
std::size_t trianglesAbove(const Lattice& lattice, int row);
std::size_t latticeTriangles(const Lattice& lattice);

/// The rim, counter-clockwise from the left end of row 0.
std::vector<LatticePoint> latticeRim(const Lattice& lattice);
std::size_t latticeRimLength(const Lattice& lattice);

}  // namespace palpate::body

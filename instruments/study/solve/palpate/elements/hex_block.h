// One quarter of a block of 8-node boxes under a surface: its held and moved nodes, and its linear equations.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "palpate/elements/grid_borders.h"
#include "palpate/elements/hex_element.h"
#include "palpate/tissue/layered_table.h"

namespace palpate::elements {

/// Columns along x and y from the middle, rows downwards from the surface.
struct HexBlock {
  const tissue::LayerStack& stack;
  std::vector<double> x_mm;
  std::vector<double> y_mm;
  LayerRows rows;

  int alongX() const { return static_cast<int>(x_mm.size()); }
  int alongY() const { return static_cast<int>(y_mm.size()); }
  int deep() const { return static_cast<int>(rows.depths_mm.size()); }
  int nodes() const { return alongX() * alongY() * deep(); }
  int node(int i, int j, int k) const { return (i * alongY() + j) * deep() + k; }
  std::array<int, 8> elementNodes(int i, int j, int k) const;
  HexMatrix elementStiffness(int i, int j, int k) const;
};

/// Nodes that are held or moved by a given distance; the rest is free.
class HexBoundary {
 public:
  explicit HexBoundary(const HexBlock& block)
      : held(3 * static_cast<std::size_t>(block.nodes()), false), given(Eigen::VectorXd::Zero(3 * block.nodes())) {}

  void hold(int place) { held[static_cast<std::size_t>(place)] = true; }

  std::vector<bool> held;  ///< u_x, u_y, u_z of every node
  Eigen::VectorXd given;   ///< mm, of those that are held
};

struct HexMotion {
  Eigen::VectorXd displacement;  ///< u_x, u_y, u_z of every node, mm
  double n_per_mm = 0.0;         ///< stiffness of all four quarters, where 1 mm is given
};

/// Throws Error, which names `what`, where the equations are not solved.
HexMotion solveHexBlock(const HexBlock& block, const HexBoundary& boundary, const char* what);

}  // namespace palpate::elements

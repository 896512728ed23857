// The body that the rivals of Table 4.1 deform: a square block of layered tissue on a rigid base, cut into cells.
//
// Nodes lie on a regular grid in x and y; rows of cells follow the layers. The ball presses the middle of the top,
// which is z = 0 when at rest. The base does not move, the sides do not leave their planes.
#pragma once

#include <vector>

#include "dissertation/rivals/layered_truth.h"
#include "palpate/base/vec.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::study {

class TissueBlock {
 public:
  /// `cells` along x and y, an even number, so that a node lies under the ball.
  TissueBlock(const std::vector<TissueLayer>& layers, double side_mm, int cells);

  int cells() const { return cells_; }
  int rows() const { return static_cast<int>(row_modulus_.size()); }
  double spacing() const { return spacing_mm_; }
  double rowHeight(int row) const { return heights_[row + 1] - heights_[row]; }
  double rowModulus(int row) const { return row_modulus_[row]; }  ///< N/mm^2

  std::size_t nodes() const { return heights_.size() * nodesOfALevel(); }
  std::size_t nodesOfALevel() const {
    return (static_cast<std::size_t>(cells_) + 1) * (static_cast<std::size_t>(cells_) + 1);
  }
  /// Column, line and level of the grid.
  std::size_t node(int i, int j, int k) const {
    const std::size_t line = static_cast<std::size_t>(cells_) + 1;
    return (static_cast<std::size_t>(k) * line + static_cast<std::size_t>(j)) * line + static_cast<std::size_t>(i);
  }
  Vec3 place(std::size_t node) const;
  /// True if the node does not move along that axis.
  bool isFixed(std::size_t node, int axis) const;

  /// The top level: its vertices are the nodes from firstTopNode() on.
  std::size_t firstTopNode() const { return nodes() - nodesOfALevel(); }
  mesh::TriangleMesh skin() const;

 private:
  int cells_;
  double spacing_mm_;
  std::vector<double> heights_;  ///< heights of the levels, from the base up to 0
  std::vector<double> row_modulus_;
};

/// How far a rigid ball pushes skin at `distance_mm` from its axis, mm; negative where it does not reach it.
double ballDepth(double distance_mm, double central_depth_mm);

}  // namespace palpate::study

// The body that the rivals of Table 4.1 deform: a square block of layered tissue on a rigid base, cut into cells.
//
// Nodes lie on a regular grid in x and y; rows of cells follow the layers. The ball presses the middle of the top,
// which is z = 0 when at rest. The base does not move, the sides do not leave their planes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::study {

// What layered tissue does under a rigid ball: finite element results of finite strain, made outside this project.
//
// The truth that the rivals of Table 4.1 are judged by. layered_truth.json says how it was made and checked.

inline constexpr double kBallRadiusMm = 8.0;

struct TissueLayer {
  double thickness_mm = 0.0;
  double modulus_kpa = 0.0;
};

struct LayeredPress {
  std::string tissue;               ///< "back_mid": 2 mm skin, 8 mm fat, 30 mm muscle; "bony"; "stiff_skin"
  std::vector<TissueLayer> layers;  ///< from the skin down
  double depth_mm = 0.0;            ///< nominal: 5 or 10
  double central_mm = 0.0;          ///< how far the skin under the ball really went down
  double force_n = 0.0;
  double step_mm = 0.0;        ///< between the radii of the two profiles
  std::vector<double> inward;  ///< shares of central_mm, from the middle on
  std::vector<double> outward;
};

/// The text of layered_truth.json, compiled in: the command works from any folder.
std::string_view layeredTruthFile();

/// In the order of the file: by tissue, then by depth.
const std::vector<LayeredPress>& layeredPresses();

/// Throws Error where there is none.
const LayeredPress& layeredPress(std::string_view tissue, double depth_mm);

/// Where skin at this place of the plane goes, mm; beyond the last radius as at the last one.
Vec3 trueDisplacement(const LayeredPress& press, const Vec2& place);

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

  /// The top level: its vertices are the nodes from firstOfTop() on.
  std::size_t firstOfTop() const { return nodes() - nodesOfALevel(); }
  mesh::TriangleMesh skin() const;

 private:
  int cells_;
  double spacing_mm_;
  std::vector<double> heights_;  ///< of the levels, from the base up to 0
  std::vector<double> row_modulus_;
};

/// How far a rigid ball pushes skin that lies `distance_mm` beside its axis, mm; negative where it does not reach it.
double ballDepth(double distance_mm, double central_depth_mm);

}  // namespace palpate::study

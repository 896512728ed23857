// The stack of layers cut by a plane through the axis: 8-node quadrilaterals in columns, fine where the sphere presses.
//
// r outward from the axis, z up from the base (bone). Base and outer rim are held, the axis stays the axis.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "palpate/elements/grid_borders.h"
#include "palpate/elements/inclusion.h"
#include "palpate/tissue/layered_table.h"

namespace palpate::elements {

/// A post of bone under the axis; everything in it is held.
struct BonePost {
  double cover_mm = 0.0;   ///< from the surface down to its top
  double radius_mm = 0.0;  ///< radius of the post, and of its top where that is round; 0: no post
  bool flat_top = false;   ///< otherwise round
  bool holds(double r, double depth_mm) const;
};

struct MeshFineness {
  Spacing columns;
  RowFineness rows;
  BonePost bone = {};
  std::optional<Inclusion> lump = {};  ///< its outline follows lines of the mesh
};

/// No degree of freedom: held.
inline constexpr int kHeld = -1;

struct QuadMesh {
  std::vector<double> columns;  ///< r of the columns' borders, from the axis
  std::vector<double> rows;     ///< z of the rows' borders, from the surface down to 0
  // One per node:
  std::vector<double> r;
  std::vector<double> z;
  std::vector<std::array<int, 2>> freedoms;  ///< for u_r and u_z: places in the system of equations, or kHeld
  int freedom_count = 0;
  // An element each:
  std::vector<std::array<int, 8>> nodes;  ///< corners from the lower left against the clock, then the sides' middles
  std::vector<int> layers;                ///< layer of the stack
  /// Nodes of the surface's edges, from the axis outwards.
  std::vector<std::array<int, 3>> surface;

  double height() const { return rows.front(); }
};

QuadMesh quadMesh(const tissue::LayerStack& stack, const MeshFineness& fineness);

}  // namespace palpate::elements

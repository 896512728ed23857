// Rival 3 of Table 4.1: free-form deformation, "fast", "not accurate, need manipulation".
//
// A lattice of control points around the body carries cubic B-splines. The user drags one point of the skin: of all
// moves of the control points that take it along, the smallest is taken. Nothing here knows the tissue under the skin;
// how far a press reaches is the spacing of the lattice, which the user must choose. Based on: Sederberg and Parry,
// "Free-form deformation of solid geometric models", 1986; Hsu, Hughes and Kaufman, "Direct manipulation of free-form
// deformations", 1992 (B-splines, and the least move).
#pragma once

#include <array>
#include <vector>

#include "dissertation/rivals/pressed_surface.h"
#include "dissertation/rivals/tissue_block.h"

namespace palpate::study {

class FreeForm {
 public:
  /// A control point lies under the middle of the skin.
  FreeForm(const TissueBlock& block, double lattice_mm);

  /// Where the vertices of the skin go when its middle is dragged there.
  std::vector<Vec3> press(double central_depth_mm);

  std::size_t controlPoints() const { return moves_.size(); }
  std::size_t bytes() const;

 private:
  /// The four control points along one axis that a place follows, and how much.
  struct Follow {
    int first = 0;
    std::array<double, 4> weights{};
  };
  struct Vertex {
    std::array<Follow, 3> along;
  };
  Vertex vertexAt(const Vec3& place) const;
  template <class Function>
  void forEachControl(const Vertex& vertex, const Function& function) const;

  double lattice_mm_;
  std::array<int, 3> points_{};  ///< counts of the lattice along each axis
  Vec3 origin_ = Vec3::Zero();
  std::vector<Vertex> vertices_;
  std::vector<Vec3> moves_;  ///< moves of the control points
  Vertex middle_;
};

}  // namespace palpate::study

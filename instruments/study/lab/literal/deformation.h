// The dissertation's deformation, line by line: what `palpate study bench deform` compares the engine with.
//
// Rings of neighbour nodes by linked lists around the friction anchor, the displacement of each node inside by a
// look-up in the stored curve, then the normals of the changed triangles and of their corners, again by lists. Nothing
// is held back that the compiler can do with it. Literal are E14 (4.13), E18 (nearest of 700 entries), E21 (one ellipse
// for both parts), E23 (rings, no test of facing); taken as corrected are E17 (lengths, not forces) and E19 (lengths
// capped). Several fingers simply add up (E25). Based on: Ji, dissertation 2008, sections 4.2.1 (4.3), 4.3 (4.5), 4.4
// (4.7) to (4.14), 4.5, 4.6 (4.15) to (4.18).
#pragma once

#include <array>
#include <span>

#include "lab/literal/mesh.h"

namespace palpate::bench::literal {

struct Touch {
  Vec3 anchor = Vec3::Zero();  ///< O: on the undeformed skin
  int anchor_triangle = 0;
  Vec3 normal = Vec3::UnitZ();                 ///< ON, unit
  double depth_mm = 0.0;                       ///< P_n
  Vec3 drag_mm = Vec3::Zero();                 ///< P_t
  Vec3 half_major_mm = 100.0 * Vec3::UnitX();  ///< OA, in the plane of the ellipse
  double aspect = 1.0;                         ///< t = b / a, at most 1
};

class Deformation {
 public:
  explicit Deformation(const mesh::TriangleMesh& skin);

  /// Restores what the last call moved and deforms the skin by these touches. Allocates, as in the text.
  void apply(std::span<const Touch> touches);

  /// Nodes that lie in a region of the last call.
  int movedNodes() const;
  const Mesh& mesh() const { return mesh_; }

 private:
  using Ring = std::list<int>;

  void restoreMoved();
  void searchNodesInEllipse(const Touch& touch);
  Ring nextRing(const Ring& ring);
  bool deformNode(int node, const Touch& touch);
  void recalculateNormals();
  void collectTriangles(const std::list<int>& nodes, std::list<int>& changed);
  Vertex& vertex(int v) { return mesh_.vertices[static_cast<std::size_t>(v)]; }
  const Vec3& rest(int v) const { return rest_[static_cast<std::size_t>(v)]; }

  Mesh mesh_;               // the graphic surface, which deforms
  std::vector<Vec3> rest_;  // the haptic surface, which does not
  std::array<double, 700> curve_{};
  std::list<int> moved_, restored_;
  std::vector<char> marked_;  // per vertex
  std::vector<char> listed_;  // per triangle
};

}  // namespace palpate::bench::literal

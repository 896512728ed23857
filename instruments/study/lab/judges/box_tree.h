// A tree of boxes over a mesh's triangles, for oracles that run in every tick: nearest point and crossings.
//
// Plain on purpose, and without any code of `tree` or `contact`: split at the median of the centres, one box a node.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::lab {

struct BoxNode {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  Index first = 0, last = 0;  ///< slots of the triangles below, half open
  Index right = 0;            ///< second child, the first is the next node; 0 for a leaf
};

/// The point of a surface nearest to a place.
struct NearPoint {
  Vec3 point = Vec3::Zero();
  double distance = 0.0;
  Index triangle = kNoIndex;  ///< none: nothing within the bound that was given
};

class BoxTree {
 public:
  /// The mesh must have a triangle; it is copied corner by corner.
  explicit BoxTree(const mesh::TriangleMesh& mesh);

  const std::vector<BoxNode>& nodes() const { return nodes_; }
  /// Triangles lie in slots, those of a node in a row.
  const std::array<Vec3, 3>& corners(Index slot) const { return corners_[slot]; }
  Index slotOf(Index triangle) const { return slots_[triangle]; }
  Index triangles() const { return static_cast<Index>(order_.size()); }

  /// Nearer than `bound` only.
  NearPoint nearest(const Vec3& place, double bound) const;
  /// Triangles not farther than `reach`.
  void collectWithin(const Vec3& place, double reach, std::vector<Index>& triangles) const;

  /// How often the segment goes into the surface (from the front of a triangle to its back) less how often it comes
  /// out, and where it first goes in. Rounded, not exact: not for segments through an edge.
  struct Crossing {
    int inwards = 0;
    std::optional<Vec3> entry;
  };
  Crossing crossing(const Vec3& from, const Vec3& to) const;

 private:
  Index build(Index first, Index last, const mesh::TriangleMesh& mesh, const std::vector<Vec3>& centres);

  std::vector<BoxNode> nodes_;
  std::vector<Index> order_, slots_;
  std::vector<std::array<Vec3, 3>> corners_;
};

/// Distance from a place to a node's box, squared; 0 inside.
inline double distance2(const BoxNode& node, const Vec3& place) {
  const Vec3 out = (node.low - place).cwiseMax(place - node.high).cwiseMax(0.0);
  return out.squaredNorm();
}

}  // namespace palpate::lab

// The nearest point of a fixed triangle mesh: for depths and measured errors, at load time.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// The point of triangle abc nearest to p, by the region that p projects into.
Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// A box tree over a copy of the triangles. Built once in O(n log n), read from any thread.
class NearestTriangle {
 public:
  struct Hit {
    Index triangle = kNoIndex;  ///< in the mesh given; kNoIndex when nothing is within reach
    Vec3 point = Vec3::Zero();  ///< on that triangle
    double distance = std::numeric_limits<double>::infinity();
  };

  explicit NearestTriangle(const TriangleMesh& mesh);

  /// The nearest point within `reach` (mm) of p; a good reach makes it faster. Equal distances: any, but always the
  /// same.
  Hit find(const Vec3& p, double reach = std::numeric_limits<double>::infinity()) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    Index first;  // inner node: the right child (the left one follows its parent); leaf: the first triangle
    Index count;  // 0 for an inner node
  };
  struct Corners {
    Vec3 a, b, c;
    Index triangle;
  };

  Index build(std::span<Corners> corners, Index offset);
  void scanLeaf(const Node& leaf, const Vec3& p, Hit& best) const;

  std::vector<Node> nodes_;
  std::vector<Corners> corners_;  // in tree order
};

}  // namespace palpate::mesh

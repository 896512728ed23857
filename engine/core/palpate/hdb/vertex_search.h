// The octree as a search for graphics: the vertices near a place, whatever their neighbours are.
//
// Objective 2 of the dissertation (section 1.5) wants the octree in graphics as well as in touch. The deformation calls
// this where a scene sets deformation.search = "octree", in place of rings of neighbours (deform/region_by_rings.h):
// the box around the region gives triangles, and those their corners. It knows places and not connections, so a region
// over a crease holds the far side too (E23). Based on: Ji, dissertation 2008, sections 1.5 and 3.4.
#pragma once

#include <span>
#include <vector>

#include "palpate/hdb/haptic_box.h"
#include "palpate/hdb/partition.h"

namespace palpate::hdb {

/// Triangles up to which a node is a leaf. Below some dozen nothing changes (`palpate study search`), since blocks of
/// entries lie under the leaves.
inline constexpr Index kVertexSearchThreshold = 16;

class VertexSearch {
 public:
  /// Allocates everything that find needs; keeps nothing of the mesh but its triangles. Throws Error as buildPartition
  /// does.
  explicit VertexSearch(const mesh::TriangleMesh& mesh, Index threshold = kVertexSearchThreshold);

  /// The corners of all triangles whose boxes meet `box` (mm), each once. Valid until the next call. No allocation; one
  /// thread.
  std::span<const Index> find(const Box3& box) noexcept;

  const Partition& octree() const noexcept { return octree_; }

 private:
  Partition octree_;
  TriangleHits hits_;
  std::vector<Triangle> triangles_;
  std::vector<Index> found_;
  std::vector<std::uint64_t> is_found_;  // one bit a vertex
};

}  // namespace palpate::hdb

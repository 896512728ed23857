// Vertices at equal (or nearly equal) places become one, and those that nothing uses go.
//
// Used while reading formats that repeat vertices (STL, glTF) and as the first step of `repair`.
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// Hands out one index for each place; -0 and 0 are one place, a non-finite vertex is never joined to another.
/// About 50 ns and 28 bytes of memory per vertex. Open addressing, linear probing, at most half full.
class ExactWelder {
 public:
  explicit ExactWelder(std::size_t expected_vertices);
  /// The index of the vertex here, a new one if there was none.
  Index add(const Vec3& position);
  /// Brings what add() of this position reads first into the cache: worth it some kAhead positions before.
  void prepare(const Vec3& position) const noexcept;
  static constexpr std::size_t kAhead = 16;
  /// The vertices in the order of their first appearance. Leaves the welder empty.
  std::vector<Vec3> extractPositions() { return std::move(positions_); }

 private:
  void grow();
  std::size_t slotOf(const Vec3& position) const;

  std::vector<Vec3> positions_;
  std::vector<Index> slots_;  // power of two; kNoIndex = free
};

/// The replacement of each vertex: itself, or an earlier one at the same coordinates.
std::vector<Index> equalVertices(const std::vector<Vec3>& positions);

/// The same for vertices nearer than `distance_mm` > 0 to an earlier one that stays: no vertex moves by more.
std::vector<Index> nearVertices(const std::vector<Vec3>& positions, double distance_mm);

/// The value of each index in `from`: what belonged to the old vertex of each new one.
template <class T>
std::vector<T> picked(const std::vector<T>& values, const std::vector<Index>& from) {
  std::vector<T> result;
  result.reserve(from.size());
  for (const Index i : from) result.push_back(values[i]);
  return result;
}

/// Puts `same_as[v]` in the place of v in every triangle, then removes unused vertices. For each new vertex its old
/// index is returned. Wrong indices (out of range) are left as they are.
std::vector<Index> mergeVertices(TriangleMesh& mesh, const std::vector<Index>& same_as);

/// Keeps the order of the vertices that stay. For each new vertex its old index is returned. Wrong indices stay wrong.
std::vector<Index> removeUnusedVertices(TriangleMesh& mesh);

}  // namespace palpate::mesh

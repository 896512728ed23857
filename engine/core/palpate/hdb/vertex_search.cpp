// A box's triangles out of the octree, then their corners, each marked once.
// Based on: see vertex_search.h.
#include "palpate/hdb/vertex_search.h"

namespace palpate::hdb {

namespace {

constexpr Index kBitsOfAWord = 64;

}  // namespace

VertexSearch::VertexSearch(const mesh::TriangleMesh& mesh, Index threshold)
    : octree_(buildPartition(mesh, {.tree = TreeKind::Octree, .threshold = threshold})),
      triangles_(mesh.triangles),
      is_found_(mesh.positions.size() / kBitsOfAWord + 1, 0) {
  hits_.prepareFor(octree_);
  found_.reserve(mesh.positions.size());
}

std::span<const Index> VertexSearch::find(const Box3& box) noexcept {
  for (const Index v : found_) is_found_[v / kBitsOfAWord] = 0;
  found_.clear();
  findTriangles(octree_, box, hits_);
  listTriangles(octree_, hits_);
  for (const Index t : hits_.triangles) {
    for (const Index v : triangles_[t]) {
      const std::uint64_t bit = std::uint64_t{1} << (v % kBitsOfAWord);
      if ((is_found_[v / kBitsOfAWord] & bit) != 0) continue;
      is_found_[v / kBitsOfAWord] |= bit;
      found_.push_back(v);
    }
  }
  return found_;
}

}  // namespace palpate::hdb

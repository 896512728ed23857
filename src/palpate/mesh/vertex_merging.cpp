#include "palpate/mesh/vertex_merging.h"

namespace palpate::mesh {

std::vector<Index> mergeVertices(TriangleMesh& mesh, const std::vector<Index>& same_as) {
  for (Triangle& triangle : mesh.triangles) {
    for (Index& v : triangle) v = v < same_as.size() ? same_as[v] : v;
  }
  return removeUnusedVertices(mesh);
}

std::vector<Index> removeUnusedVertices(TriangleMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  std::vector<Index> new_index(count, kNoIndex);
  for (const Triangle& triangle : mesh.triangles) {
    for (Index v : triangle) {
      if (v < count) new_index[v] = 0;
    }
  }
  std::vector<Index> source;
  for (Index v = 0; v < count; ++v) {
    if (new_index[v] == kNoIndex) continue;
    new_index[v] = static_cast<Index>(source.size());
    mesh.positions[source.size()] = mesh.positions[v];
    source.push_back(v);
  }
  mesh.positions.resize(source.size());
  for (Triangle& triangle : mesh.triangles) {
    // An index that was out of range before must not come to name a vertex now, nor one that is gone.
    for (Index& v : triangle) v = v < count ? new_index[v] : kNoIndex;
  }
  return source;
}

}  // namespace palpate::mesh

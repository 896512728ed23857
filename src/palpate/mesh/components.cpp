#include "palpate/mesh/components.h"

namespace palpate::mesh {

Components findComponents(const TriangleMesh& mesh) {
  DisjointSets vertices(mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    vertices.unite(a, b);
    vertices.unite(b, c);
  }
  Components components;
  std::vector<Index> number_of_root(mesh.positions.size(), kNoIndex);
  components.of_triangle.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    Index& number = number_of_root[vertices.root(triangle[0])];
    if (number == kNoIndex) number = components.count++;
    components.of_triangle.push_back(number);
  }
  return components;
}

}  // namespace palpate::mesh

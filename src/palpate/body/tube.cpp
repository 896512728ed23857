#include "palpate/body/tube.h"

#include <utility>

namespace palpate::body {

mesh::TriangleMesh mirrored(mesh::TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) p.x() = -p.x();
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

mesh::TriangleMesh withMirrorImage(mesh::TriangleMesh half) {
  const std::size_t vertices = half.positions.size();
  const std::size_t triangles = half.triangles.size();
  std::vector<Index> image(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const Vec3 p = half.positions[v];
    image[v] = p.x() == 0.0 ? static_cast<Index>(v) : static_cast<Index>(half.positions.size());
    if (p.x() != 0.0) half.positions.emplace_back(-p.x(), p.y(), p.z());
  }
  for (std::size_t t = 0; t < triangles; ++t) {
    const Triangle original = half.triangles[t];
    half.triangles.push_back({image[original[0]], image[original[2]], image[original[1]]});
  }
  return half;
}

}  // namespace palpate::body

// Boxes, sums and normals. A vertex normal weights its triangles by area, which is what sums of cross products do by
// themselves; contact weights by angle instead (contact/surface.cpp), because there the sign of a distance hangs on it.
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

Eigen::AlignedBox3d boundingBox(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& position : mesh.positions) box.extend(position);
  return box;
}

void append(const TriangleMesh& more, TriangleMesh& to) {
  const auto first = static_cast<Index>(to.positions.size());
  to.positions.insert(to.positions.end(), more.positions.begin(), more.positions.end());
  for (const auto& [a, b, c] : more.triangles) to.triangles.push_back({a + first, b + first, c + first});
}

std::vector<Vec3> triangleNormals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) normals.push_back(areaVector2(mesh, t).stableNormalized());
  return normals;
}

std::vector<Vec3> vertexNormals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.positions.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles) {
    const Vec3 area = areaVector2(mesh, t);
    for (const Index v : t) normals[v] += area;
  }
  for (Vec3& normal : normals) normal.stableNormalize();
  return normals;
}

}  // namespace palpate::mesh

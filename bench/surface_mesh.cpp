#include "bench/surface_mesh.h"

namespace palpate::bench {

mesh::TriangleMesh meshOf(const contact::Surface& surface) {
  mesh::TriangleMesh mesh;
  mesh.positions.assign(surface.vertex_normals.size(), Vec3::Zero());
  mesh.triangles.resize(surface.tree.records.size());
  for (std::size_t r = 0; r < surface.tree.records.size(); ++r) {
    const partition::TriangleRecord& record = surface.tree.records[r];
    mesh.triangles[surface.tree.source_triangle[r]] = record.vertices;
    for (int corner = 0; corner < 3; ++corner) mesh.positions[record.vertices[corner]] = record.corners[corner];
  }
  return mesh;
}

}  // namespace palpate::bench

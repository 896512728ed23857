#include "lab/literal/mesh.h"

#include <gtest/gtest.h>

#include "lab/workloads/workload_meshes.h"
#include "palpate/mesh/triangle_mesh.h"
#include "support/mesh_zoo.h"

namespace palpate::bench {

TEST(LiteralMesh, ListsEveryNeighbourOnce) {
  const literal::Mesh mesh = literal::buildMesh(zoo::grid(4, 40.0));  // 5 x 5 vertices, row by row
  const literal::Vertex& middle = mesh.vertices[12];
  EXPECT_EQ(middle.joint_vertices.size(), middle.joint_triangles.size());
  std::size_t uses = 0;
  for (const literal::Vertex& vertex : mesh.vertices) uses += vertex.joint_triangles.size();
  EXPECT_EQ(uses, 3 * mesh.triangles.size());
}

TEST(LiteralMesh, HasUnitNormalsNearTheEnginesOwn) {
  const mesh::TriangleMesh back = lab::backMesh(2962);
  const literal::Mesh literal = literal::buildMesh(back);
  const auto normals = mesh::vertexNormals(back);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    EXPECT_NEAR(literal.vertices[v].normal.norm(), 1.0, 1e-12);
    // It means the triangles whatever their area; the engine weighs them by it.
    EXPECT_GT(literal.vertices[v].normal.dot(normals[v]), 0.99);
  }
}

}  // namespace palpate::bench

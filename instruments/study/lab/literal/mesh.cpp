// Neighbours are the engine's, copied into lists; a vertex's normal is the plain mean of its triangles', unweighted.
// Based on: Ji, dissertation 2008, sections 3.1 and 4.5.
#include "lab/literal/mesh.h"

#include <Eigen/Geometry>

#include "palpate/mesh/topology.h"

namespace palpate::bench::literal {

namespace {

Vec3 unitOrZero(const Vec3& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

}  // namespace

Vec3 triangleNormal(const Mesh& mesh, const Triangle& triangle) {
  const Vec3& a = mesh.vertices[static_cast<std::size_t>(triangle.corners[0])].position;
  const Vec3& b = mesh.vertices[static_cast<std::size_t>(triangle.corners[1])].position;
  const Vec3& c = mesh.vertices[static_cast<std::size_t>(triangle.corners[2])].position;
  return unitOrZero((b - a).cross(c - a));
}

Vec3 averagedNormal(const Mesh& mesh, const Vertex& vertex) {
  Vec3 sum = Vec3::Zero();
  for (const int t : vertex.joint_triangles) sum += mesh.triangles[static_cast<std::size_t>(t)].normal;
  return unitOrZero(sum);
}

Mesh buildMesh(const mesh::TriangleMesh& mesh) {
  Mesh literal;
  const mesh::IndexRows triangles_of_vertex = mesh::trianglesOfVertices(mesh);
  const mesh::IndexRows neighbours = mesh::neighboursOfVertices(mesh, triangles_of_vertex);
  literal.vertices.resize(mesh.positions.size());
  for (Index v = 0; v < mesh.positions.size(); ++v) {
    Vertex& vertex = literal.vertices[v];
    vertex.position = mesh.positions[v];
    vertex.joint_vertices.assign(neighbours[v].begin(), neighbours[v].end());
    vertex.joint_triangles.assign(triangles_of_vertex[v].begin(), triangles_of_vertex[v].end());
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    literal.triangles.push_back({{static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)}, Vec3::Zero()});
  }
  for (Triangle& triangle : literal.triangles) triangle.normal = triangleNormal(literal, triangle);
  for (Vertex& vertex : literal.vertices) vertex.normal = averagedNormal(literal, vertex);
  return literal;
}

}  // namespace palpate::bench::literal

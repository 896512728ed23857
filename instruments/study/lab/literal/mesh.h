// The mesh as the dissertation declares it: an array of structures in double, with linked lists of neighbours.
//
// The literal side of `palpate study bench --peers` works on this, to be compared with the engine on the same mesh in
// the same run. Field for field the structures of section 3.1 ("Data Structure of the Haptic Model"); the text keeps
// vertices and triangles "in a linear link", here they lie in arrays, which is kinder to it.
// Based on: Ji, dissertation 2008, section 3.1.
#pragma once

#include <list>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::bench::literal {

struct Vertex {
  Vec3 position = Vec3::Zero();  ///< mm
  Vec3 normal = Vec3::Zero();    ///< unit, or zero without any triangle of some area
  double texture[2] = {};
  std::list<int> joint_vertices;   ///< those joined by an edge
  std::list<int> joint_triangles;  ///< those that use this vertex
};

struct Triangle {
  int corners[3] = {};
  Vec3 normal = Vec3::Zero();  ///< unit, or zero without area
};

struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
};

/// Lists are filled vertex by vertex, so that a fresh heap lays each list out in one piece. Indices must be in range.
Mesh buildMesh(const mesh::TriangleMesh& mesh);

/// The normal of a triangle from the positions its corners have now.
Vec3 triangleNormal(const Mesh& mesh, const Triangle& triangle);

/// The mean of the normals of the adjacent triangles, made unit (section 4.5).
Vec3 averagedNormal(const Mesh& mesh, const Vertex& vertex);

}  // namespace palpate::bench::literal

// Area-weighted normals.
#pragma once

#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// Unit normal of each triangle; zero for one without area.
std::vector<Vec3> triangleNormals(const TriangleMesh& mesh);

/// Unit normal of each vertex: the sum of the area vectors of its triangles, normalised; zero for an unused vertex.
std::vector<Vec3> vertexNormals(const TriangleMesh& mesh);

}  // namespace palpate::mesh

// Parts of a mesh that share no vertex.
#pragma once

#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

struct Components {
  std::vector<Index> of_triangle;  ///< numbered by their lowest triangle
  Index count = 0;
};

/// Indices must be within range.
Components findComponents(const TriangleMesh& mesh);

}  // namespace palpate::mesh

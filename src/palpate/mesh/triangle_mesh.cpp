#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

Eigen::AlignedBox3d boundingBox(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& position : mesh.positions) box.extend(position);
  return box;
}

}  // namespace palpate::mesh

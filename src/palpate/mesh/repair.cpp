#include "palpate/mesh/repair.h"

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/mesh/vertex_merging.h"

namespace palpate::mesh {

RepairResult repair(TriangleMesh mesh, const RepairOptions&, const Progress&) {
  RepairResult result;
  result.mesh = std::move(mesh);
  std::erase_if(result.mesh.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](Index v) {
      return v >= result.mesh.positions.size() || !result.mesh.positions[v].allFinite();
    });
  });
  if (result.mesh.triangles.empty()) throw Error("the mesh has no triangle that can be felt");
  result.source_vertex = removeUnusedVertices(result.mesh);
  return result;
}

}  // namespace palpate::mesh

// One pass over the edges. Closed in the sense of a cycle of simplicial homology, which self-intersections and
// edges of many triangles may be in.
#include "palpate/mesh/closure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "palpate/mesh/components.h"

namespace palpate::mesh {

std::string_view wordsFor(Closure closure) {
  if (closure == Closure::open) return "open";
  return closure == Closure::closed ? "closed" : "nearly closed";
}

SurfaceState surfaceState(const TriangleMesh& mesh, const EdgeUses& edges, const Holes& holes) {
  SurfaceState state;
  state.triangles = mesh.triangles.size();
  state.vertices = mesh.positions.size();
  bool balanced = true;
  DisjointSets borders(mesh.positions.size());
  std::vector<bool> on_border(mesh.positions.size(), false);
  std::size_t joined = 0;
  forEachEdge(edges, [&](Index low, Index high, std::span<const EdgeUse> uses) {
    const int balance = edgeBalance(mesh, low, uses);
    if (balance != 0) {
      balanced = false;
      state.open_length_mm += std::abs(balance) * (mesh.positions[high] - mesh.positions[low]).norm();
    }
    if (uses.size() > 2) ++state.non_manifold_edges;
    if (uses.size() != 1) return;
    ++state.border_edges;
    on_border[low] = on_border[high] = true;
    joined += borders.unite(low, high) ? 1 : 0;
  });
  state.border_loops = static_cast<std::size_t>(std::count(on_border.begin(), on_border.end(), true)) - joined;
  if (balanced && !mesh.triangles.empty()) {
    state.closure = Closure::closed;
  } else if (holes.nearlyClosed()) {
    state.closure = Closure::nearly_closed;
  }
  return state;
}

}  // namespace palpate::mesh

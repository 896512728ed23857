// The order of the steps, and what each of them is called in the report. Own; the steps name their sources.
#include "palpate/mesh/repair.h"

#include <algorithm>
#include <numeric>

#include "palpate/base/error.h"
#include "palpate/mesh/components.h"
#include "palpate/mesh/doubled_triangles.h"
#include "palpate/mesh/fans.h"
#include "palpate/mesh/intersections.h"
#include "palpate/mesh/slivers.h"
#include "palpate/mesh/topology.h"
#include "palpate/mesh/weld.h"
#include "palpate/mesh/winding.h"

namespace palpate::mesh {

namespace {

/// The steps, in the order in which `repair` calls them: each relies on those before it.
class Repairing {
 public:
  Repairing(TriangleMesh mesh, const RepairOptions& options, const Progress& progress)
      : options_(options), progress_(progress) {
    result_.mesh = std::move(mesh);
    result_.source_vertex.resize(result_.mesh.positions.size());
    std::iota(result_.source_vertex.begin(), result_.source_vertex.end(), Index{0});
  }

  void dropUnusable() {
    const auto& positions = result_.mesh.positions;
    auto& triangles = result_.mesh.triangles;
    note("triangles dropped that name a vertex which does not exist", std::erase_if(triangles, [&](const Triangle& t) {
           return std::any_of(t.begin(), t.end(), [&](Index v) { return v >= positions.size(); });
         }));
    note("triangles dropped that use a vertex which is not finite", std::erase_if(triangles, [&](const Triangle& t) {
           return std::any_of(t.begin(), t.end(), [&](Index v) { return !isUsable(positions[v]); });
         }));
    note("vertices dropped that no triangle used", countUnused());
  }

  void weld() {
    if (!options_.weld) return;
    report(progress_, "repairing", 0.1);
    const auto& positions = result_.mesh.positions;
    const auto same_as =
        options_.weld_distance_mm > 0.0 ? nearVertices(positions, options_.weld_distance_mm) : equalVertices(positions);
    std::size_t welded = 0;
    for (Index v = 0; v < same_as.size(); ++v) welded += same_as[v] != v ? 1 : 0;
    for (Triangle& triangle : result_.mesh.triangles) {
      for (Index& v : triangle) v = same_as[v];
    }
    note("vertices welded to another at the same place", welded);
  }

  void collapseSlivers() {
    report(progress_, "repairing", 0.2);
    const SliversRemoved removed = removeSlivers(result_.mesh);
    note("triangles without area collapsed along a short edge", removed.collapsed);
    note("triangles without height sewn to the neighbour across their long edge", removed.sewn);
    note("triangles without area dropped", removed.dropped);
  }

  void removeTwins() {
    report(progress_, "repairing", 0.3);
    const DoubledRemoved removed = removeDoubled(result_.mesh);
    note("duplicate triangles dropped", removed.duplicates);
    note("opposite pairs of triangles removed (fins without thickness)", removed.opposite_pairs);
    note("triangles given from both sides, one side kept", removed.sides);
  }

  void unifyWinding() {
    report(progress_, "repairing", 0.4);
    const EdgeUses edges = edgeUses(result_.mesh);
    const Patches patches = findPatches(result_.mesh, edges);
    note("triangles flipped to face the way of their neighbours", makeWindingConsistent(result_.mesh, patches));
    if (options_.orient_outwards) {
      note("closed parts turned outside out", turnOutwards(result_.mesh, edges, patches));
    }
  }

  void separateFans() {
    report(progress_, "repairing", 0.6);
    const FansMade made = makeFans(result_.mesh, result_.source_vertex);
    note("edges of a one-sided part cut open along a seam", made.seam_edges);
    note("edges of more than two triangles taken apart, faces joined by angle", made.non_manifold_edges);
    note("vertices copied so that every fan of triangles has its own", made.copied_vertices);
    note("edges split in the middle to tell them apart", made.split_edges);
  }

  void removeLeftovers() {
    const std::vector<Index> kept = removeUnusedVertices(result_.mesh);
    std::vector<Index> source(kept.size());
    std::transform(kept.begin(), kept.end(), source.begin(), [&](Index v) { return result_.source_vertex[v]; });
    result_.source_vertex = std::move(source);
  }

  void describeResult() {
    report(progress_, "repairing", 0.9);
    result_.components = findComponents(result_.mesh).count;
    result_.closed = true;
    forEachEdge(edgeUses(result_.mesh), [&](Index, Index, std::span<const EdgeUse> uses) {
      if (uses.size() != 2) result_.closed = false;
    });
    if (options_.find_self_intersections) {
      const Intersections found = findIntersections(result_.mesh, progress_);
      // What could not be searched to the end is dense with overlaps: treat it as intersecting, which is the safe side.
      result_.self_intersecting = found.piercing_edges > 0 || !found.complete;
    }
    report(progress_, "repairing", 1.0);
  }

  void checkSomethingIsLeft() const {
    if (result_.mesh.triangles.empty()) throw Error("the mesh has no triangle that can be felt");
  }

  RepairResult takeResult() { return std::move(result_); }

 private:
  void note(std::string what, std::size_t count) {
    if (count > 0) result_.actions.push_back({std::move(what), count});
  }

  std::size_t countUnused() const {
    std::vector<bool> used(result_.mesh.positions.size(), false);
    for (const Triangle& triangle : result_.mesh.triangles) {
      for (Index v : triangle) used[v] = true;
    }
    return static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
  }

  const RepairOptions& options_;
  const Progress& progress_;
  RepairResult result_;
};

}  // namespace

RepairResult repair(TriangleMesh mesh, const RepairOptions& options, const Progress& progress) {
  Repairing repairing(std::move(mesh), options, progress);
  repairing.dropUnusable();
  repairing.weld();
  repairing.collapseSlivers();
  repairing.removeTwins();
  repairing.checkSomethingIsLeft();
  repairing.unifyWinding();
  repairing.separateFans();
  repairing.removeLeftovers();
  repairing.describeResult();
  return repairing.takeResult();
}

}  // namespace palpate::mesh

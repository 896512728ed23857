// The order of the steps, and their names in the report. The steps name their sources.
#include "palpate/mesh/repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/mesh/components.h"
#include "palpate/mesh/doubled_triangles.h"
#include "palpate/mesh/fans.h"
#include "palpate/mesh/hairline_gaps.h"
#include "palpate/mesh/holes.h"
#include "palpate/mesh/intersections.h"
#include "palpate/mesh/open_parts.h"
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
    noteDropped("triangles dropped that name a vertex which does not exist",
                std::erase_if(triangles, [&](const Triangle& t) {
                  return std::any_of(t.begin(), t.end(), [&](Index v) { return v >= positions.size(); });
                }));
    noteDropped("triangles dropped that use a vertex which is not finite",
                std::erase_if(triangles, [&](const Triangle& t) {
                  return std::any_of(t.begin(), t.end(), [&](Index v) { return !isUsable(positions[v]); });
                }));
    note("vertices dropped that no triangle used", countUnused());
  }

  void measureGiven() {
    edges_ = edgeUses(result_.mesh);
    holes_ = findHoles(result_.mesh, edges_, progress_);
    result_.before = surfaceState(result_.mesh, edges_, holes_);
    for (const RepairAction& action : result_.actions) {
      result_.before.triangles += static_cast<std::size_t>(-action.triangles);  // only dropped ones until now
    }
    open_length_mm_ = result_.before.open_length_mm;
  }

  void weld() {
    if (!options_.weld) return;
    report(progress_, "repairing", 0.1);
    const auto& positions = result_.mesh.positions;
    const auto same_as =
        options_.weld_distance_mm > 0.0 ? nearVertices(positions, options_.weld_distance_mm) : equalVertices(positions);
    std::size_t welded = 0;
    for (Index v = 0; v < same_as.size(); ++v) welded += same_as[v] != v ? 1 : 0;
    if (welded == 0) return;
    for (Triangle& triangle : result_.mesh.triangles) {
      for (Index& v : triangle) v = same_as[v];
    }
    note("vertices welded to another at the same place", welded);
    open_length_mm_ = surfaceState(result_.mesh, edgeUses(result_.mesh), {}).open_length_mm;
  }

  void joinHairlines() {
    if (!options_.weld) return;
    const double gap_mm = kHairlineShare * boundingBox(result_.mesh).diagonal().norm();
    const HairlineGaps gaps = findHairlineGaps(result_.mesh, gap_mm);
    if (gaps.walls == 0) return;
    std::vector<Triangle> kept;
    for (std::size_t t = 0; t < result_.mesh.triangles.size(); ++t) {
      if (gaps.is_wall[t]) continue;
      const auto& [a, b, c] = result_.mesh.triangles[t];
      kept.push_back({gaps.same_as[a], gaps.same_as[b], gaps.same_as[c]});
    }
    result_.mesh.triangles = std::move(kept);
    noteDropped("triangles dropped that faced each other across a hairline gap between two parts", gaps.walls);
  }

  void collapseSlivers() {
    report(progress_, "repairing", 0.2);
    const auto given = triangleCount();
    const SliversRemoved removed = removeSlivers(result_.mesh);
    noteDropped("triangles without area collapsed along a short edge", removed.collapsed);
    note("triangles without height sewn to the neighbour across their long edge", removed.sewn,
         triangleCount() - given + toSigned(removed.collapsed + removed.dropped));
    noteDropped("triangles without area dropped", removed.dropped);
  }

  void removeTwins() {
    report(progress_, "repairing", 0.3);
    const DoubledRemoved removed = removeDoubled(result_.mesh);
    noteDropped("duplicate triangles dropped", removed.duplicates);
    note("opposite pairs of triangles cancelled next to the remaining one", removed.cancelled,
         -2 * toSigned(removed.cancelled));
    note("opposite pairs of triangles removed (fins without thickness)", removed.opposite_pairs,
         -2 * toSigned(removed.opposite_pairs));
    noteDropped("triangles given from both sides, one side kept", removed.sides);
  }

  void unifyWinding() {
    report(progress_, "repairing", 0.4);
    if (!untouched()) edges_ = edgeUses(result_.mesh);
    patches_ = findPatches(result_.mesh, edges_);
    const std::size_t flipped = makeWindingConsistent(result_.mesh, patches_);
    note("triangles flipped to face the way of their neighbours", flipped);
    if (flipped > 0) edges_ = edgeUses(result_.mesh);  // half-edges are named by the order of the corners
  }

  void closeHoles() {
    if (!options_.fill_holes) return;
    report(progress_, "repairing", 0.5);
    if (!untouched()) holes_ = findHoles(result_.mesh, edges_, progress_);
    warnOfHolesLeft();
    if (holes_.count(HoleFate::fillable) == 0) return;
    const auto given = triangleCount();
    const std::size_t filled = fillHoles(result_.mesh, holes_);
    note("small holes of nearly closed parts filled or sewn up", filled, triangleCount() - given);
    collapseSlivers();  // left by the fillings
    removeTwins();
    edges_ = edgeUses(result_.mesh);
    patches_ = findPatches(result_.mesh, edges_);
  }

  void faceOutwards() {
    if (!options_.orient_outwards) return;
    note("closed parts turned outside out", turnOutwards(result_.mesh, edges_, patches_));
    const OpenParts open = findOpenParts(result_.mesh, edges_);
    turnOver(open.inside_out);
    note("open parts turned outside out", open.inside_out.size());
    if (options_.turn_over != TurnOver::none) {
      turnOver(open.doubtful);
      if (options_.turn_over == TurnOver::open) turnOver(open.as_given);
      note("open parts turned over as asked",
           open.doubtful.size() + (options_.turn_over == TurnOver::open ? open.as_given.size() : 0));
    } else if (!open.doubtful.empty()) {
      result_.warnings.push_back(
          fmt::format("{} open part{} may be inside out (first triangle: {}): touched from the inside of its bowl; "
                      "flip with `palpate body repair --turn-over doubtful` if the outside is meant",
                      open.doubtful.size(), open.doubtful.size() == 1 ? "" : "s", open.doubtful[0][0]));
    }
  }

  void turnOver(const std::vector<std::vector<Index>>& parts) {
    for (const std::vector<Index>& part : parts) {
      for (const Index t : part) std::swap(result_.mesh.triangles[t][1], result_.mesh.triangles[t][2]);
    }
  }

  void separateFans() {
    report(progress_, "repairing", 0.6);
    const auto given = triangleCount();
    const FansMade made = makeFans(result_.mesh, result_.source_vertex);
    note("edges of a one-sided part cut open along a seam", made.seam_edges);
    note("edges of more than two triangles taken apart, faces joined by angle", made.non_manifold_edges);
    note("vertices copied so that every fan of triangles has its own", made.copied_vertices);
    note("edges split in the middle to tell them apart", made.split_edges, triangleCount() - given);
  }

  void removeLeftovers() {
    const std::vector<Index> kept = removeUnusedVertices(result_.mesh);
    result_.source_vertex = picked(result_.source_vertex, kept);
  }

  void describeResult() {
    report(progress_, "repairing", 0.9);
    result_.components = findComponents(result_.mesh).count;
    result_.after = finalState();
    result_.closed = result_.after.closure == Closure::closed;
    warnOfWhatOpened();
    if (options_.find_self_intersections) {
      result_.self_intersecting = isSelfIntersecting(findIntersections(result_.mesh, progress_));
    }
    report(progress_, "repairing", 1.0);
  }

  void requireNonEmpty() const {
    if (result_.mesh.triangles.empty()) throw Error("the mesh has no usable triangles");
  }

  RepairResult releaseResult() { return std::move(result_); }

 private:
  static std::ptrdiff_t toSigned(std::size_t count) { return static_cast<std::ptrdiff_t>(count); }
  std::ptrdiff_t triangleCount() const { return toSigned(result_.mesh.triangles.size()); }

  /// A step that runs again, after holes were filled, adds to its first line.
  void note(std::string what, std::size_t count, std::ptrdiff_t triangles = 0) {
    if (count == 0 && triangles == 0) return;
    const auto same = std::find_if(result_.actions.begin(), result_.actions.end(),
                                   [&](const RepairAction& action) { return action.what == what; });
    if (same == result_.actions.end()) {
      result_.actions.push_back({std::move(what), count, triangles});
    } else {
      same->count += count;
      same->triangles += triangles;
    }
  }
  void noteDropped(std::string what, std::size_t count) { note(std::move(what), count, -toSigned(count)); }

  /// Then the measurements of the given mesh still hold; that saves a sound mesh a third of the time.
  bool untouched() const { return result_.actions.empty(); }

  SurfaceState finalState() const {
    if (untouched()) return result_.before;
    const EdgeUses edges = edgeUses(result_.mesh);
    return surfaceState(result_.mesh, edges, findHoles(result_.mesh, edges, progress_));
  }

  void warnOfHolesLeft() {
    if (const std::size_t count = holes_.count(HoleFate::too_long); count > 0) {
      result_.warnings.push_back(fmt::format("{} left open in a nearly closed part: more than {} border edges",
                                             formatHoles(count), kMaxHoleEdges));
    }
    if (const std::size_t count = holes_.count(HoleFate::no_room); count > 0) {
      result_.warnings.push_back(
          fmt::format("{} left open in a nearly closed part: a filling would overlap the surface", formatHoles(count)));
    }
  }

  static std::string formatHoles(std::size_t count) {
    return fmt::format("{} small hole{}", count, count == 1 ? "" : "s");
  }

  /// Lengths are compared, because a split border edge does not make a new border.
  void warnOfWhatOpened() {
    constexpr double kRounding = 1e-9;  // in a sum of lengths
    const double opened_mm = result_.after.open_length_mm - open_length_mm_;
    if (!(opened_mm > kRounding * result_.after.open_length_mm)) return;
    result_.warnings.push_back(fmt::format("{} was closed and is open now: {:.3g} mm of border that was none",
                                           open_length_mm_ == 0.0 ? "the surface" : "a part", opened_mm));
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
  EdgeUses edges_;  // in the mesh as given, then as unifyWinding and closeHoles leave it
  Holes holes_;     // in the mesh as given, then in the one that closeHoles finds
  Patches patches_;
  double open_length_mm_ = 0.0;  // welded, before anything else is done
};

}  // namespace

RepairResult repair(TriangleMesh mesh, const RepairOptions& options, const Progress& progress) {
  Repairing repairing(std::move(mesh), options, progress);
  repairing.dropUnusable();
  repairing.measureGiven();
  repairing.weld();
  repairing.joinHairlines();
  repairing.collapseSlivers();
  repairing.removeTwins();
  repairing.requireNonEmpty();
  repairing.unifyWinding();
  repairing.closeHoles();
  repairing.faceOutwards();
  repairing.separateFans();
  repairing.removeLeftovers();
  repairing.describeResult();
  return repairing.releaseResult();
}

}  // namespace palpate::mesh

// One pass a trait, each over the triangles that the passes before it found sound; `repair` mends in the same order.
// Self-intersections, slivers and windings name their sources in their files.
#include "palpate/mesh/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "palpate/mesh/components.h"
#include "palpate/mesh/doubled_triangles.h"
#include "palpate/mesh/holes.h"
#include "palpate/mesh/intersections.h"
#include "palpate/mesh/open_parts.h"
#include "palpate/mesh/slivers.h"
#include "palpate/mesh/topology.h"
#include "palpate/mesh/weld.h"
#include "palpate/mesh/winding.h"

namespace palpate::mesh {

namespace {

/// The geometrically valid triangles, and their indices in the whole mesh.
struct Sound {
  TriangleMesh mesh;
  std::vector<Index> original;
};

bool namesExisting(const TriangleMesh& mesh, const Triangle& t) {
  return std::all_of(t.begin(), t.end(), [&](Index v) { return v < mesh.positions.size(); });
}

bool isUsableTriangle(const TriangleMesh& mesh, const Triangle& t) {
  return namesExisting(mesh, t) &&
         std::all_of(t.begin(), t.end(), [&](Index v) { return isUsable(mesh.positions[v]); });
}

void checkVertices(const TriangleMesh& mesh, ValidationReport& found) {
  std::vector<bool> used(mesh.positions.size(), false);
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    if (!namesExisting(mesh, mesh.triangles[t])) {
      found.wrong_indices.add(t);
      continue;
    }
    for (Index v : mesh.triangles[t]) used[v] = true;
  }
  for (Index v = 0; v < mesh.positions.size(); ++v) {
    if (!isUsable(mesh.positions[v])) found.non_finite_vertices.add(v);
    if (!used[v]) found.unused_vertices.add(v);
  }
  const std::vector<Index> same_as = equalVertices(mesh.positions);
  for (Index v = 0; v < same_as.size(); ++v) {
    if (same_as[v] != v && used[v]) found.coincident_vertices.add(v);
  }
}

Sound soundPart(const TriangleMesh& mesh) {
  Sound sound;
  sound.mesh.positions = mesh.positions;
  sound.mesh.triangles.reserve(mesh.triangles.size());
  sound.original.reserve(mesh.triangles.size());
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    if (!isUsableTriangle(mesh, mesh.triangles[t])) continue;
    sound.mesh.triangles.push_back(mesh.triangles[t]);
    sound.original.push_back(t);
  }
  return sound;
}

void checkShapes(const Sound& sound, ValidationReport& found) {
  const double height = sliverHeight(sound.mesh);
  for (Index t = 0; t < sound.original.size(); ++t) {
    const Triangle& triangle = sound.mesh.triangles[t];
    if (isSliver(sound.mesh, triangle, height)) found.zero_area_triangles.add(sound.original[t]);
    found.area_mm2 += 0.5 * areaVector2(sound.mesh, triangle).norm();
    for (Index v : triangle) found.box.extend(sound.mesh.positions[v]);
  }
}

void checkTwins(const Sound& sound, ValidationReport& found) {
  std::vector<std::pair<Index, bool>> later_twins;  // and whether an earlier one has the same winding
  for (const TwinGroup& group : twinGroups(sound.mesh)) {
    std::array<bool, 2> seen{};
    for (Index t : group) {
      bool& same_winding_seen = seen[isAscending(sound.mesh.triangles[t]) ? 1 : 0];
      if (t != group.front()) later_twins.emplace_back(t, same_winding_seen);
      same_winding_seen = true;
    }
  }
  std::sort(later_twins.begin(), later_twins.end());
  for (const auto& [t, same_winding] : later_twins) {
    (same_winding ? found.duplicate_triangles : found.opposite_triangles).add(sound.original[t]);
  }
}

void addSorted(Trait& trait, std::vector<Index>& triangles) {
  std::sort(triangles.begin(), triangles.end());
  for (Index t : triangles) trait.add(t);
}

void checkEdges(const Sound& sound, const EdgeUses& edges, ValidationReport& found) {
  std::vector<Index> at_border;
  std::vector<Index> non_manifold;
  std::vector<Index> inconsistent;
  forEachEdge(edges, [&](Index low, Index, std::span<const EdgeUse> uses) {
    const Index triangle = sound.original[uses[0].half_edge / 3];
    if (uses.size() == 1) at_border.push_back(triangle);
    if (uses.size() > 2) non_manifold.push_back(triangle);
    if (uses.size() == 2 && edgeBalance(sound.mesh, low, uses) != 0) inconsistent.push_back(triangle);
  });
  addSorted(found.border_edges, at_border);
  addSorted(found.non_manifold_edges, non_manifold);
  addSorted(found.inconsistent_edges, inconsistent);
}

void checkClosure(const Sound& sound, const EdgeUses& edges, const Progress& progress, ValidationReport& found) {
  const Holes holes = findHoles(sound.mesh, edges, progress);
  const SurfaceState state = surfaceState(sound.mesh, edges, holes);
  found.border_loops = state.border_loops;
  found.closure = state.closure;
  found.closed = state.closure == Closure::closed;
  found.fillable_holes = holes.count(HoleFate::fillable);
  found.small_holes = found.fillable_holes + holes.count(HoleFate::too_long) + holes.count(HoleFate::no_room);
}

/// Whether the triangles around a vertex hang together across edges at that vertex.
class FanCheck {
 public:
  explicit FanCheck(const TriangleMesh& mesh) : mesh_(mesh), triangles_(trianglesOfVertices(mesh)) {}

  bool hasSeveralFans(Index vertex) {
    const auto around = triangles_[vertex];
    if (around.size() < 2) return false;
    spokes_.clear();
    for (Index i = 0; i < around.size(); ++i) {
      for (Index v : mesh_.triangles[around[i]]) {
        if (v != vertex) spokes_.emplace_back(v, i);
      }
    }
    std::sort(spokes_.begin(), spokes_.end());
    DisjointSets fans(around.size());
    std::size_t count = around.size();
    for (std::size_t i = 1; i < spokes_.size(); ++i) {
      const bool same_edge = spokes_[i].first == spokes_[i - 1].first;
      if (same_edge && fans.unite(spokes_[i].second, spokes_[i - 1].second)) --count;
    }
    return count > 1;
  }

 private:
  const TriangleMesh& mesh_;
  IndexRows triangles_;
  std::vector<std::pair<Index, Index>> spokes_;  // the other end of an edge, the triangle at it
};

void checkFans(const Sound& sound, ValidationReport& found) {
  FanCheck check(sound.mesh);
  for (Index v = 0; v < sound.mesh.positions.size(); ++v) {
    if (check.hasSeveralFans(v)) found.non_manifold_vertices.add(v);
  }
}

void checkOpenParts(const Sound& sound, const EdgeUses& edges, ValidationReport& found) {
  if (found.closed || found.inconsistent_edges.count > 0) return;  // repair makes the winding consistent first
  const OpenParts open = findOpenParts(sound.mesh, edges);
  for (const std::vector<Index>& part : open.inside_out) found.inside_out_parts.add(sound.original[part[0]]);
  for (const std::vector<Index>& part : open.doubtful) found.doubtful_parts.add(sound.original[part[0]]);
}

/// Closed parts among others: the total volume does not show a single one's.
void checkClosedParts(const Sound& sound, const EdgeUses& edges, ValidationReport& found) {
  if (found.inconsistent_edges.count > 0 || found.components < 2) return;
  TriangleMesh turned = sound.mesh;
  turnOutwards(turned, edges, findPatches(turned, edges));
  const Components parts = partsAcrossEdges(turned, edges);
  std::vector<std::uint8_t> told(parts.count, 0);
  for (Index t = 0; t < turned.triangles.size(); ++t) {
    if (turned.triangles[t] == sound.mesh.triangles[t] || std::exchange(told[parts.of_triangle[t]], 1)) continue;
    found.inside_out_parts.add(sound.original[t]);
  }
}

void checkIntersections(const Sound& sound, const Progress& progress, ValidationReport& found) {
  const Intersections intersections = findIntersections(sound.mesh, progress);
  found.self_intersections_checked = intersections.complete;
  for (Index t : intersections.pierced_triangles) found.self_intersections.add(sound.original[t]);
  found.self_intersections.count = intersections.piercing_edges - intersections.touching_edges;
  for (Index t : intersections.touched_triangles) found.touching_edges.add(sound.original[t]);
  found.touching_edges.count = intersections.touching_edges;
}

/// "12 things (first: 3, 4, 9)"; `one` is used for a single thing.
void addSentence(std::vector<std::string>& sentences, const Trait& trait, const char* one, const char* many) {
  if (trait.count == 0) return;
  sentences.push_back(
      fmt::format("{} {} (first: {})", trait.count, trait.count == 1 ? one : many, fmt::join(trait.first, ", ")));
}

}  // namespace

bool hasDoubtfulSize(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return false;
  const double length = box.diagonal().norm();
  return !(length >= kShortestBodyMm && length <= kLongestBodyMm);
}

bool ValidationReport::sound() const {
  for (const Trait* trait :
       {&non_finite_vertices, &unused_vertices, &non_manifold_vertices, &wrong_indices, &zero_area_triangles,
        &duplicate_triangles, &opposite_triangles, &non_manifold_edges, &inconsistent_edges, &inside_out_parts}) {
    if (trait->count > 0) return false;
  }
  return triangles > 0 && volume_mm3 >= 0.0;
}

ValidationReport validate(const TriangleMesh& mesh, const ValidateOptions& options, const Progress& progress) {
  ValidationReport found;
  found.vertices = mesh.positions.size();
  found.triangles = mesh.triangles.size();
  report(progress, "checking", 0.0);
  checkVertices(mesh, found);
  const Sound sound = soundPart(mesh);
  checkShapes(sound, found);
  checkTwins(sound, found);
  report(progress, "checking", 0.3);
  const EdgeUses edges = edgeUses(sound.mesh);
  checkEdges(sound, edges, found);
  checkClosure(sound, edges, progress, found);
  found.one_sided = found.inconsistent_edges.count > 0 && findPatches(sound.mesh, edges).seam_edges > 0;
  checkOpenParts(sound, edges, found);
  report(progress, "checking", 0.6);
  checkFans(sound, found);
  found.components = findComponents(sound.mesh).count;
  checkClosedParts(sound, edges, found);
  found.volume_mm3 = found.closed ? signedVolume(sound.mesh) : 0.0;
  report(progress, "checking", 1.0);
  if (options.self_intersections) checkIntersections(sound, progress, found);
  return found;
}

std::vector<std::string> describe(const ValidationReport& found) {
  std::vector<std::string> s;
  addSentence(s, found.non_finite_vertices, "non-finite vertex", "non-finite vertices");
  addSentence(s, found.unused_vertices, "unused vertex", "unused vertices");
  addSentence(s, found.coincident_vertices, "vertex at the place of an earlier one",
              "vertices at the place of an earlier one");
  addSentence(s, found.wrong_indices, "triangle with out-of-range indices", "triangles with out-of-range indices");
  addSentence(s, found.zero_area_triangles, "zero-area triangle", "zero-area triangles");
  addSentence(s, found.duplicate_triangles, "duplicate triangle", "duplicate triangles");
  addSentence(s, found.opposite_triangles, "triangle doubled from the other side",
              "triangles doubled from the other side");
  addSentence(s, found.non_manifold_edges, "non-manifold edge, at triangle", "non-manifold edges, at triangles");
  addSentence(s, found.non_manifold_vertices, "non-manifold vertex", "non-manifold vertices");
  addSentence(s, found.inconsistent_edges, "edge of inconsistent winding, at triangle",
              "edges of inconsistent winding, at triangles");
  if (found.one_sided) s.emplace_back("a part is one-sided (a Moebius strip): it cannot be wound consistently");
  if (found.volume_mm3 < 0.0) s.emplace_back("closed, but inside out: its volume is negative");
  addSentence(s, found.inside_out_parts, "part that is inside out, at triangle",
              "parts that are inside out, at triangles");
  addSentence(s, found.doubtful_parts, "open part that may be inside out, at triangle",
              "open parts that may be inside out, at triangles");
  addSentence(s, found.self_intersections, "edge that pierces the mesh itself, at triangle",
              "edges that pierce the mesh itself, at triangles");
  addSentence(s, found.touching_edges, "edge that only touches the mesh itself, at triangle",
              "edges that only touch the mesh itself, at triangles");
  addSentence(s, found.border_edges, "border edge, at triangle", "border edges, at triangles");
  if (found.border_loops > 0) {
    s.push_back(fmt::format("{} border loop{}", found.border_loops, found.border_loops == 1 ? "" : "s"));
  }
  if (found.small_holes > 0) {
    s.push_back(fmt::format("{} small hole{} in a part that is closed otherwise", found.small_holes,
                            found.small_holes == 1 ? "" : "s"));
  }
  if (found.components > 1) s.push_back(fmt::format("{} components that share no vertex", found.components));
  return s;
}

}  // namespace palpate::mesh

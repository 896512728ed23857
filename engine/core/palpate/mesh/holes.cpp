// Border loops are weighed against the part that they belong to; those of nearly closed parts get a filling of least
// area, and keep it unless it folds back on the surface or crosses it.
//
// Triangulations as named in loop_triangulation.cpp.
#include "palpate/mesh/holes.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "palpate/mesh/components.h"
#include "palpate/mesh/intersections.h"
#include "palpate/mesh/slivers.h"

namespace palpate::mesh {

namespace {

/// For all holes of a mesh, in candidates for a triangle (2 ns each): a few seconds.
constexpr double kMaxFillingWork = 2e9;
/// A filling that turns back by more than 170 degrees at its border lies on the adjacent surface.
constexpr double kFoldCosine = -0.985;

struct Part {
  double area_mm2 = 0.0;
  double hole_area_mm2 = 0.0;
  Eigen::AlignedBox3d box;
  bool has_loose_border = false;  ///< one that is not a loop: it cannot be weighed
  double diagonal() const { return box.diagonal().norm(); }
  bool nearlyClosed() const { return !has_loose_border && hole_area_mm2 <= kNearlyClosedShare * area_mm2; }
};

std::pair<Index, Index> undirectedEdge(Index a, Index b) { return std::minmax(a, b); }

class HoleSearch {
 public:
  HoleSearch(const TriangleMesh& mesh, const EdgeUses& edges, const Progress& progress)
      : mesh_(mesh), edges_(edges), progress_(progress) {}

  Holes run() {
    found_.other_open_edges = openEdges();
    if (found_.other_open_edges == 0) return std::move(found_);
    Borders borders = findBorders(mesh_, edges_);
    found_.other_open_edges -= borders.edges - borders.unclosed.size();
    measureParts(borders);
    for (BorderLoop& loop : borders.loops) addHole(std::move(loop));
    if (!std::any_of(parts_.begin(), parts_.end(), [](const Part& p) { return p.nearlyClosed(); }))
      return std::move(found_);
    triangulate();
    judge();
    refuseFolds();
    refuseCrossings();
    for (Hole& hole : found_.all) {
      if (hole.fate == HoleFate::fillable) continue;
      hole.filling.clear();
      hole.splits.clear();
    }
    return std::move(found_);
  }

 private:
  std::size_t openEdges() const {
    std::size_t count = 0;
    forEachEdge(edges_, [&](Index low, Index, std::span<const EdgeUse> uses) {
      count += edgeBalance(mesh_, low, uses) != 0 ? 1 : 0;
    });
    return count;
  }

  /// Everything along a loop is one part: a patch may hang on the rest by the ends of cracks alone.
  void joinAlongLoops(const Borders& borders) {
    DisjointSets joined(part_of_.count);
    for (const BorderLoop& loop : borders.loops) {
      for (const Index h : loop.half_edges) {
        joined.unite(part_of_.of_triangle[loop.half_edges[0] / 3], part_of_.of_triangle[h / 3]);
      }
    }
    for (Index& part : part_of_.of_triangle) part = joined.root(part);
  }

  void measureParts(const Borders& borders) {
    part_of_ = partsAcrossEdges(mesh_, edges_);
    joinAlongLoops(borders);
    parts_.resize(part_of_.count);
    for (Index t = 0; t < mesh_.triangles.size(); ++t) {
      Part& part = parts_[part_of_.of_triangle[t]];
      for (Index v : mesh_.triangles[t]) part.box.extend(mesh_.positions[v]);
      part.area_mm2 += 0.5 * areaVector2(mesh_, mesh_.triangles[t]).norm();
    }
    for (const Index h : borders.unclosed) parts_[part_of_.of_triangle[h / 3]].has_loose_border = true;
  }

  void addHole(BorderLoop loop) {
    Hole hole;
    hole.part = part_of_.of_triangle[loop.half_edges[0] / 3];
    hole.area_mm2 = leastArea(mesh_, loop);
    hole.loop = std::move(loop);
    parts_[hole.part].hole_area_mm2 += hole.area_mm2;
    found_.all.push_back(std::move(hole));
  }

  // --- fillings ---

  /// The shortest first: should the time not do, most of them are filled.
  void triangulate() {
    const IndexRows triangles = trianglesOfVertices(mesh_);
    std::vector<Index> order(found_.all.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Index l, Index r) { return loopSize(l) < loopSize(r); });
    place_.assign(mesh_.positions.size(), kNoIndex);
    double work = 0.0;
    for (const Index i : order) {
      Hole& hole = found_.all[i];
      Part& part = parts_[hole.part];
      if (!part.nearlyClosed() || joinSides(hole)) continue;
      const auto n = static_cast<double>(loopSize(i));
      work += n * n * n / 6.0;
      hole.fate = loopSize(i) > kMaxHoleEdges || work > kMaxFillingWork ? HoleFate::too_long : HoleFate::fillable;
      if (hole.fate == HoleFate::too_long) continue;
      fill(hole, triangles);
      part.hole_area_mm2 += hole.area_mm2 - leastArea(mesh_, hole.loop);
    }
  }

  bool joinSides(Hole& hole) const {
    auto splits = planCrack(mesh_, hole.loop, kCrackShare * parts_[hole.part].diagonal());
    if (!splits) return false;
    hole.fate = HoleFate::fillable;
    hole.splits = std::move(*splits);
    return true;
  }

  std::size_t loopSize(Index hole) const { return found_.all[hole].loop.vertices.size(); }

  void fill(Hole& hole, const IndexRows& triangles) {
    const std::vector<Index>& loop = hole.loop.vertices;
    std::vector<Vec3> places;
    for (const Index v : loop) places.push_back(mesh_.positions[v]);
    const std::vector<bool> taken = takenDiagonals(loop, triangles);
    const auto filling = triangulateLoop(places, [&](Index i, Index j) {
      return !taken[std::size_t{i} * loop.size() + j] && !new_edges_.contains(undirectedEdge(loop[i], loop[j]));
    });
    if (!filling) {
      hole.fate = HoleFate::no_room;
      return;
    }
    hole.area_mm2 = filling->area;
    for (const auto& [i, k, j] : filling->triangles) {
      hole.filling.push_back({loop[i], loop[k], loop[j]});
      for (const auto& edge : {undirectedEdge(loop[i], loop[k]), undirectedEdge(loop[k], loop[j])})
        new_edges_.insert(edge);
    }
  }

  /// Pairs of places in the loop between which there is an edge.
  std::vector<bool> takenDiagonals(const std::vector<Index>& loop, const IndexRows& triangles) {
    std::vector<bool> taken(loop.size() * loop.size(), false);
    for (Index i = 0; i < loop.size(); ++i) place_[loop[i]] = i;
    for (Index i = 0; i < loop.size(); ++i) {
      for (const Index t : triangles[loop[i]]) {
        for (const Index v : mesh_.triangles[t]) {
          if (place_[v] != kNoIndex) taken[std::size_t{i} * loop.size() + place_[v]] = true;
        }
      }
    }
    for (const Index v : loop) place_[v] = kNoIndex;
    return taken;
  }

  // --- which of them stay ---

  void judge() {
    for (Hole& hole : found_.all) {
      const Part& part = parts_[hole.part];
      hole.width_mm = 2.0 * hole.area_mm2 / lengthOf(mesh_, hole.loop);
      if (!part.nearlyClosed()) {
        hole.fate = HoleFate::part_open;
      } else if (hole.width_mm > kWidestHoleShare * part.diagonal()) {
        hole.fate = HoleFate::too_wide;
      }
    }
  }

  bool isCrack(const Hole& hole) const { return hole.width_mm <= kCrackShare * parts_[hole.part].diagonal(); }

  Vec3 triangleNormal(const Triangle& t) const { return areaVector2(mesh_, t).stableNormalized(); }

  void refuseFolds() {
    for (Hole& hole : found_.all) {
      if (hole.fate == HoleFate::fillable && !isCrack(hole) && foldsBack(hole)) hole.fate = HoleFate::no_room;
    }
  }

  bool foldsBack(const Hole& hole) const {
    std::map<std::pair<Index, Index>, Vec3> beside;
    for (const Index h : hole.loop.half_edges) {
      beside[undirectedEdge(halfEdgeStart(mesh_, h), halfEdgeEnd(mesh_, h))] = triangleNormal(mesh_.triangles[h / 3]);
    }
    const double flat = kCrackShare * parts_[hole.part].diagonal();
    return std::any_of(hole.filling.begin(), hole.filling.end(), [&](const Triangle& t) {
      if (isSliver(mesh_, t, flat)) return false;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto neighbour = beside.find(undirectedEdge(t[i], t[(i + 1) % 3]));
        if (neighbour != beside.end() && neighbour->second.dot(triangleNormal(t)) < kFoldCosine) return true;
      }
      return false;
    });
  }

  /// A filling that another part of the surface sticks through stays away, and so does one that sticks through itself.
  void refuseCrossings() {
    TriangleMesh filled = mesh_;
    std::vector<Index> hole_of;  // hole of each added triangle
    std::map<std::pair<Index, Index>, Index> hole_of_edge;
    for (Index i = 0; i < found_.all.size(); ++i) {
      const Hole& hole = found_.all[i];
      if (hole.fate != HoleFate::fillable || isCrack(hole)) continue;
      for (const Triangle& t : hole.filling) {
        filled.triangles.push_back(t);
        hole_of.push_back(i);
        for (std::size_t k = 0; k < 3; ++k) hole_of_edge.emplace(undirectedEdge(t[k], t[(k + 1) % 3]), i);
      }
      for (std::size_t k = 0; k < hole.loop.vertices.size(); ++k) {  // the border was there before
        hole_of_edge.erase(
            undirectedEdge(hole.loop.vertices[k], hole.loop.vertices[(k + 1) % hole.loop.vertices.size()]));
      }
    }
    if (hole_of.empty()) return;
    for (const Crossing& crossing : findIntersections(filled, progress_).crossings) {
      const auto by_edge = hole_of_edge.find({crossing.low, crossing.high});
      if (by_edge != hole_of_edge.end()) found_.all[by_edge->second].fate = HoleFate::no_room;
      if (crossing.triangle >= mesh_.triangles.size())
        found_.all[hole_of[crossing.triangle - mesh_.triangles.size()]].fate = HoleFate::no_room;
    }
  }

  const TriangleMesh& mesh_;
  const EdgeUses& edges_;
  const Progress& progress_;
  Holes found_;
  Components part_of_;
  std::vector<Part> parts_;
  std::vector<Index> place_;  // a vertex's place in the loop that is being filled
  std::set<std::pair<Index, Index>> new_edges_;
};

}  // namespace

std::size_t Holes::count(HoleFate fate) const {
  return static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [&](const Hole& hole) { return hole.fate == fate; }));
}

bool Holes::nearlyClosed() const {
  return !all.empty() && other_open_edges == 0 && count(HoleFate::part_open) == 0 && count(HoleFate::too_wide) == 0;
}

Holes findHoles(const TriangleMesh& mesh, const EdgeUses& edges, const Progress& progress) {
  return HoleSearch(mesh, edges, progress).run();
}

std::size_t fillHoles(TriangleMesh& mesh, const Holes& holes) {
  std::vector<SideSplit> splits;
  for (const Hole& hole : holes.all) splits.insert(splits.end(), hole.splits.begin(), hole.splits.end());
  splitSides(mesh, std::move(splits));
  const auto first = static_cast<Index>(mesh.triangles.size());
  for (const Hole& hole : holes.all) {
    mesh.triangles.insert(mesh.triangles.end(), hole.filling.begin(), hole.filling.end());
  }
  const std::size_t filled = holes.count(HoleFate::fillable);
  if (filled > 0) sewCracks(mesh, first, kCrackShare / kSliverShare * sliverHeight(mesh));
  return filled;
}

}  // namespace palpate::mesh

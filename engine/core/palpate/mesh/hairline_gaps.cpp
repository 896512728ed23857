// Vertices near each other get one name. Triangles all of whose corners have a namesake in one other part, in front of
// them, may be walls; those of two parts are dropped together where, edge by edge, they leave no border.
#include "palpate/mesh/hairline_gaps.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "palpate/mesh/components.h"
#include "palpate/mesh/weld.h"

namespace palpate::mesh {

namespace {

/// Vertices in the box of another part: the only ones that can be near one of its vertices. With many parts querying
/// each costs more than it saves.
std::vector<Index> nearOtherParts(const TriangleMesh& mesh, const Components& parts, double distance_mm) {
  constexpr Index kMaxBoxes = 64;
  std::vector<Eigen::AlignedBox3d> boxes(parts.count);
  std::vector<Index> part_of(mesh.positions.size(), kNoIndex);
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    for (const Index v : mesh.triangles[t]) {
      part_of[v] = parts.of_triangle[t];
      boxes[part_of[v]].extend(mesh.positions[v]);
    }
  }
  for (Eigen::AlignedBox3d& box : boxes) {
    box.min() -= Vec3::Constant(distance_mm);
    box.max() += Vec3::Constant(distance_mm);
  }
  std::vector<Index> vertices;
  for (Index v = 0; v < part_of.size(); ++v) {
    if (part_of[v] == kNoIndex) continue;
    bool beside = parts.count > kMaxBoxes;
    for (Index part = 0; part < parts.count && !beside; ++part) {
      beside = part != part_of[v] && boxes[part].contains(mesh.positions[v]);
    }
    if (beside) vertices.push_back(v);
  }
  return vertices;
}

/// For each vertex the earliest near one, or itself.
std::vector<Index> findRepresentatives(const TriangleMesh& mesh, const std::vector<Index>& vertices,
                                       double distance_mm) {
  std::vector<Vec3> positions;
  positions.reserve(vertices.size());
  for (const Index v : vertices) positions.push_back(mesh.positions[v]);
  const std::vector<Index> near = nearVertices(positions, distance_mm);
  std::vector<Index> names(mesh.positions.size());
  std::iota(names.begin(), names.end(), Index{0});
  for (std::size_t i = 0; i < vertices.size(); ++i) names[vertices[i]] = vertices[near[i]];
  return names;
}

/// Maps a name to its vertex of each part.
class VerticesByName {
 public:
  /// Only the vertices `near` have namesakes: the others are alone with their names.
  VerticesByName(const TriangleMesh& mesh, const Components& parts, const std::vector<Index>& near,
                 const std::vector<Index>& names) {
    std::vector<bool> is_near(mesh.positions.size(), false);
    for (const Index v : near) is_near[v] = true;
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
      for (const Index v : mesh.triangles[t]) {
        if (is_near[v]) all_.push_back({names[v], parts.of_triangle[t], v});
      }
    }
    std::sort(all_.begin(), all_.end());
    all_.erase(std::unique(all_.begin(), all_.end()), all_.end());
  }

  using Entry = std::array<Index, 3>;  // name, part, vertex

  std::span<const Entry> of(Index name) const {
    const auto first = std::lower_bound(all_.begin(), all_.end(), Entry{name, 0, 0});
    const auto end = std::find_if(first, all_.end(), [&](const Entry& entry) { return entry[0] != name; });
    return std::span(all_).subspan(static_cast<std::size_t>(first - all_.begin()),
                                   static_cast<std::size_t>(end - first));
  }
  Index vertexInPart(Index name, Index part) const {
    for (const Entry& entry : of(name)) {
      if (entry[1] == part) return entry[2];
    }
    return kNoIndex;
  }

 private:
  std::vector<Entry> all_;
};

/// A triangle that has a namesake of another part in front of each of its corners.
struct Wall {
  Index low_part, high_part, triangle;
};

class WallSearch {
 public:
  WallSearch(const TriangleMesh& mesh, const Components& parts, const std::vector<Index>& near,
             const std::vector<Index>& names)
      : mesh_(mesh), parts_(parts), names_(names), namesakes_(mesh, parts, near, names) {}

  std::vector<Wall> find() const {
    std::vector<Wall> walls;
    for (Index t = 0; t < mesh_.triangles.size(); ++t) {
      const Index own = parts_.of_triangle[t];
      const Triangle names = named(t);
      if (hasRepeatedCorner(names)) continue;
      for (const VerticesByName::Entry& entry : namesakes_.of(names[0])) {
        const Index other = entry[1];
        if (other == own || !faces(t, other)) continue;
        walls.push_back({std::min(own, other), std::max(own, other), t});
        break;
      }
    }
    std::sort(walls.begin(), walls.end(), [](const Wall& l, const Wall& r) {
      return std::tie(l.low_part, l.high_part, l.triangle) < std::tie(r.low_part, r.high_part, r.triangle);
    });
    return walls;
  }

  Triangle named(Index t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return {names_[a], names_[b], names_[c]};
  }

 private:
  bool faces(Index t, Index other) const {
    Vec3 way = Vec3::Zero();
    for (const Index v : mesh_.triangles[t]) {
      const Index there = namesakes_.vertexInPart(names_[v], other);
      if (there == kNoIndex) return false;
      way += mesh_.positions[there] - mesh_.positions[v];
    }
    return way.dot(areaVector2(mesh_, mesh_.triangles[t])) >= 0.0;
  }

  const TriangleMesh& mesh_;
  const Components& parts_;
  const std::vector<Index>& names_;
  VerticesByName namesakes_;
};

/// Leaves of two parts' walls those whose edges balance: what is dropped then leaves no border.
void dropUnbalanced(const WallSearch& search, std::vector<Index>& walls) {
  for (std::size_t before = walls.size() + 1; walls.size() < before;) {
    before = walls.size();
    std::map<std::pair<Index, Index>, int> balance;
    const auto for_edges = [&](Index t, const auto& visit) {
      const Triangle names = search.named(t);
      for (std::size_t i = 0; i < 3; ++i) {
        const Index from = names[i], to = names[(i + 1) % 3];
        visit(std::minmax(from, to), from < to ? 1 : -1);
      }
    };
    for (const Index t : walls) for_edges(t, [&](std::pair<Index, Index> edge, int way) { balance[edge] += way; });
    std::erase_if(walls, [&](Index t) {
      bool open = false;
      for_edges(t, [&](std::pair<Index, Index> edge, int) { open = open || balance[edge] != 0; });
      return open;
    });
  }
}

}  // namespace

HairlineGaps findHairlineGaps(const TriangleMesh& mesh, double distance_mm) {
  HairlineGaps found;
  found.same_as.resize(mesh.positions.size());
  std::iota(found.same_as.begin(), found.same_as.end(), Index{0});
  found.is_wall.assign(mesh.triangles.size(), false);
  const Components parts = findComponents(mesh);
  if (parts.count < 2 || !(distance_mm > 0.0)) return found;
  const std::vector<Index> near = nearOtherParts(mesh, parts, distance_mm);
  if (near.empty()) return found;
  const std::vector<Index> names = findRepresentatives(mesh, near, distance_mm);
  const WallSearch search(mesh, parts, near, names);
  const std::vector<Wall> all = search.find();
  std::vector<Index> walls;
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    walls.clear();
    for (; end < all.size() && all[end].low_part == all[first].low_part && all[end].high_part == all[first].high_part;
         ++end) {
      walls.push_back(all[end].triangle);
    }
    dropUnbalanced(search, walls);
    for (const Index t : walls) {
      found.is_wall[t] = true;
      ++found.walls;
      for (const Index v : mesh.triangles[t]) found.same_as[v] = names[v];
    }
  }
  return found;
}

}  // namespace palpate::mesh

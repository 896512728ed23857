// Half-edges are joined first (by angle where an edge has several faces), then corners across joints become fans, fans
// get vertices, and edges that would still be mistaken for one another get a middle.
//
// Akin to Rossignac and Cardoze, "Matchmaker: manifold BReps for non-manifold r-sets" (1999), faces paired by
// angle around an edge, and Gueziec, Taubin, Lazarus, Horn, "Cutting and stitching" (2001), copies of vertices.
#include "palpate/mesh/fans.h"

#include <algorithm>
#include <array>
#include <utility>

#include "palpate/base/elementary.h"
#include "palpate/mesh/components.h"
#include "palpate/mesh/topology.h"

namespace palpate::mesh {

namespace {

// --- joints: which two half-edges are neighbours ---

/// A face at an edge, seen along the edge from its lower vertex.
struct Page {
  Index half_edge;
  double angle;  // angle of its third corner around the edge
  bool rises;    // runs from low to high: its front looks towards growing angles
};

/// Coplanar faces: angles nearer than this are one angle, and their order is free. Far above rounding for any triangle
/// except slivers, far below what a finger can feel.
constexpr double kSameAngle = 1e-9;

std::vector<Page> pagesAt(const TriangleMesh& mesh, Index low, Index high, std::span<const EdgeUse> uses) {
  const Vec3 axis = (mesh.positions[high] - mesh.positions[low]).stableNormalized();
  const Vec3 u = axis.unitOrthogonal();
  const Vec3 w = axis.cross(u);
  std::vector<Page> pages;
  for (const EdgeUse& use : uses) {
    const Index third = mesh.triangles[use.half_edge / 3][(use.half_edge % 3 + 2) % 3];
    const Vec3 d = mesh.positions[third] - mesh.positions[low];
    pages.push_back({use.half_edge, elementary::atan2(d.dot(w), d.dot(u)), halfEdgeStart(mesh, use.half_edge) == low});
  }
  std::sort(pages.begin(), pages.end(), [](const Page& l, const Page& r) {
    return l.angle != r.angle ? l.angle < r.angle : l.half_edge < r.half_edge;
  });
  return pages;
}

/// Pages at one angle are ordered so that rising and falling ones alternate with the one before: as many empty sectors
/// as possible are then between a rising page and a falling one.
void alternateEqualAngles(std::vector<Page>& pages) {
  bool wanted = !pages.back().rises;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    for (std::size_t j = i; j < pages.size() && pages[j].angle - pages[i].angle <= kSameAngle; ++j) {
      if (pages[j].rises != wanted) continue;
      std::rotate(pages.begin() + static_cast<std::ptrdiff_t>(i), pages.begin() + static_cast<std::ptrdiff_t>(j),
                  pages.begin() + static_cast<std::ptrdiff_t>(j) + 1);
      break;
    }
    wanted = !pages[i].rises;
  }
}

class Joints {
 public:
  Joints(const TriangleMesh& mesh, FansMade& made) : across_(mesh.triangles.size() * 3, kNoIndex) {
    forEachEdge(edgeUses(mesh), [&](Index low, Index high, std::span<const EdgeUse> uses) {
      if (uses.size() == 2) {
        joinTwo(mesh, uses, made);
      } else if (uses.size() > 2) {
        joinByAngle(mesh, low, high, uses);
        ++made.non_manifold_edges;
      }
    });
  }
  const std::vector<Index>& across() const { return across_; }

 private:
  void joinTwo(const TriangleMesh& mesh, std::span<const EdgeUse> uses, FansMade& made) {
    if (halfEdgeStart(mesh, uses[0].half_edge) == halfEdgeStart(mesh, uses[1].half_edge)) {
      ++made.seam_edges;
    } else {
      join(uses[0].half_edge, uses[1].half_edge);
    }
  }

  void joinByAngle(const TriangleMesh& mesh, Index low, Index high, std::span<const EdgeUse> uses) {
    auto pages = pagesAt(mesh, low, high, uses);
    alternateEqualAngles(pages);
    for (std::size_t i = 0; i < pages.size(); ++i) {
      const Page& next = pages[(i + 1) % pages.size()];
      if (pages[i].rises && !next.rises) join(pages[i].half_edge, next.half_edge);
    }
    joinAroundJoined(pages);
  }

  /// Bodies that overlap leave sectors within sectors: what is free yet is joined as brackets are, around what is
  /// joined, so that an edge that as many triangles use one way as the other has no border.
  void joinAroundJoined(std::vector<Page>& pages) {
    std::erase_if(pages, [&](const Page& page) { return across_[page.half_edge] != kNoIndex; });
    std::vector<Index> open;
    for (std::size_t round = 0; round < 2; ++round) {  // twice: a sector may cross the angle where they begin
      for (const Page& page : pages) {
        if (across_[page.half_edge] != kNoIndex) continue;
        if (page.rises) {
          if (round == 0) open.push_back(page.half_edge);
        } else if (!open.empty()) {
          join(open.back(), page.half_edge);
          open.pop_back();
        }
      }
    }
  }

  void join(Index a, Index b) {
    across_[a] = b;
    across_[b] = a;
  }

  std::vector<Index> across_;  // per half-edge
};

// --- copies: one vertex for each fan ---

/// Corner i of triangle t is numbered 3 t + i. Corners that meet across a joint at the same vertex are one fan.
DisjointSets fansOfCorners(const std::vector<Index>& across) {
  DisjointSets fans(across.size());
  const auto next_corner = [](Index corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
  for (Index h = 0; h < across.size(); ++h) {
    if (across[h] == kNoIndex || across[h] < h) continue;
    fans.unite(h, next_corner(across[h]));
    fans.unite(next_corner(h), across[h]);
  }
  return fans;
}

/// Copies a vertex for every fan but the first.
std::size_t copyVertices(TriangleMesh& mesh, std::vector<Index>& source_vertex, const std::vector<Index>& across) {
  DisjointSets fans = fansOfCorners(across);
  const std::size_t before = mesh.positions.size();
  std::vector<bool> taken(before, false);
  for (Index corner = 0; corner < across.size(); ++corner) {
    Index& vertex = mesh.triangles[corner / 3][corner % 3];
    const Index root = fans.root(corner);
    if (root != corner) {  // the root is the lowest corner of its fan: it has its vertex already
      vertex = mesh.triangles[root / 3][root % 3];
    } else if (!taken[vertex]) {
      taken[vertex] = true;
    } else {
      const Vec3 position = mesh.positions[vertex];
      source_vertex.push_back(source_vertex[vertex]);
      vertex = static_cast<Index>(mesh.positions.size());
      mesh.positions.push_back(position);
    }
  }
  return mesh.positions.size() - before;
}

// --- middles: edges that are different although both ends are the same vertices ---

/// New vertices in the middle of edges, by half-edge, ascending.
using Middles = std::vector<std::pair<Index, Index>>;

/// One joint or border may keep an edge's indices; every other one gets a middle vertex.
Middles middlesFor(TriangleMesh& mesh, std::vector<Index>& source_vertex, const std::vector<Index>& across) {
  Middles middles;
  forEachEdge(edgeUses(mesh), [&](Index low, Index high, std::span<const EdgeUse> uses) {
    const Index keeper = uses[0].half_edge;
    for (const EdgeUse& use : uses) {
      const Index mate = across[use.half_edge];
      if (use.half_edge == keeper || mate == keeper || mate < use.half_edge) continue;
      const auto middle = static_cast<Index>(mesh.positions.size());
      mesh.positions.emplace_back(0.5 * (mesh.positions[low] + mesh.positions[high]));
      source_vertex.push_back(source_vertex[low]);
      middles.emplace_back(use.half_edge, middle);
      if (mate != kNoIndex) middles.emplace_back(mate, middle);
    }
  });
  std::sort(middles.begin(), middles.end());
  return middles;
}

/// Cuts a triangle as a fan from its first middle, so that no piece is flat.
void cutAtMiddles(TriangleMesh& mesh, Index triangle, std::span<const std::pair<Index, Index>> middles) {
  std::vector<Index> ring;
  std::size_t first_middle = 0;
  for (Index i = 0; i < 3; ++i) {
    ring.push_back(mesh.triangles[triangle][i]);
    for (const auto& [half_edge, vertex] : middles) {
      if (half_edge != 3 * triangle + i) continue;
      if (vertex == middles[0].second) first_middle = ring.size();
      ring.push_back(vertex);
    }
  }
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(first_middle), ring.end());
  mesh.triangles[triangle] = {ring[0], ring[1], ring[2]};
  for (std::size_t i = 3; i < ring.size(); ++i) mesh.triangles.push_back({ring[0], ring[i - 1], ring[i]});
}

std::size_t splitSharedEdges(TriangleMesh& mesh, std::vector<Index>& source_vertex, const std::vector<Index>& across) {
  const std::size_t before = mesh.positions.size();
  const Middles middles = middlesFor(mesh, source_vertex, across);
  for (std::size_t first = 0; first < middles.size();) {
    std::size_t end = first;
    const Index triangle = middles[first].first / 3;
    while (end < middles.size() && middles[end].first / 3 == triangle) ++end;
    cutAtMiddles(mesh, triangle, {&middles[first], end - first});
    first = end;
  }
  return mesh.positions.size() - before;
}

}  // namespace

FansMade makeFans(TriangleMesh& mesh, std::vector<Index>& source_vertex) {
  FansMade made;
  const Joints joints(mesh, made);
  made.copied_vertices = copyVertices(mesh, source_vertex, joints.across());
  // Where an edge has one triangle, or two that were joined, copies are unambiguous.
  if (made.non_manifold_edges + made.seam_edges > 0)
    made.split_edges = splitSharedEdges(mesh, source_vertex, joints.across());
  return made;
}

}  // namespace palpate::mesh

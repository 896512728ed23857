// The walk over the skin that makes the proxy a local minimum, and what is asked about a place on the skin.
//
// A step crosses an edge, or at a vertex looks at the whole fan (edge neighbours alone get stuck at vertices), and is
// taken only when it brings the target strictly nearer, so the walk ends. Cost: one closest point a triangle, about 15
// ns in cache; 1 to 5 triangles a tick on a back of 3,000 to 4,000,000 triangles.
//
// Based on: Ho, Basdogan, Srinivasan, "Efficient point-based rendering techniques for haptic display of virtual
// objects" (1999) for the local search; Baerentzen and Aanaes (2005) for the normals that tell the side.
#include "palpate/contact/surface_walk.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cmath>

#include "palpate/contact/narrow_cracks.h"

namespace palpate::contact {

using tree::ClosestOnTriangle;
using tree::closestOnTriangle;
using tree::Feature;
using tree::TriangleRecord;

namespace {

/// Triangles looked at in one tick before the walk pauses: 1,000 take about 20 us, and only a teleport needs so many.
constexpr int kMaxMoves = 1000;

struct Candidate {
  ClosestOnTriangle closest;
  Index triangle = kNoIndex;
};

Candidate closestIn(const Surface& surface, Index triangle, const Vec3& target) {
  return {closestOnTriangle(surface.geometry->tree.records[triangle].corners, target), triangle};
}

/// The best place next to `here` that may be entered, or triangle kNoIndex when none is nearer to the target.
template <class Enters>
Candidate betterNeighbour(const Surface& surface, const Candidate& here, const Vec3& target, Enters&& enters) {
  Candidate best;
  double nearest = here.closest.squared_distance;
  const auto consider = [&](Index triangle) {
    const Candidate other = closestIn(surface, triangle, target);
    if (!(other.closest.squared_distance < nearest) || !enters(other)) return;
    nearest = other.closest.squared_distance;
    best = other;
  };
  const Feature feature = here.closest.feature;
  if (tree::isEdge(feature)) {
    const Index across = surface.geometry->tree.records[here.triangle].neighbours[tree::indexOf(feature)];
    if (across != kNoIndex) consider(across);
  } else if (tree::isCorner(feature)) {
    visitFan(surface, here.triangle, tree::indexOf(feature), [&](Index triangle, int) {
      if (triangle != here.triangle) consider(triangle);
    });
  }
  return best;
}

struct EverythingEntered {
  bool operator()(const Candidate&) const noexcept { return true; }
};

template <class Stop, class Enters = EverythingEntered>
WalkResult walk(const Surface& surface, const SurfacePoint& from, const Vec3& target, double path_mm, Stop&& stops_at,
                Enters&& enters = {}) noexcept {
  if (stops_at(from.triangle)) return {from, false, true};
  SurfacePoint here = from;
  Candidate next = closestIn(surface, from.triangle, target);
  bool kept_out = !enters(next);
  if (kept_out) next.closest = {from.position, from.feature, (target - from.position).squaredNorm()};
  for (int moves = 0; moves < kMaxMoves; ++moves) {
    const Vec3 piece = next.closest.point - here.position;
    const double length = piece.norm();
    if (length > path_mm) {
      return {{here.position + (path_mm / length) * piece, next.triangle, Feature::face}, false};
    }
    path_mm -= length;
    here = {next.closest.point, next.triangle, next.closest.feature};
    next = betterNeighbour(surface, next, target, [&](const Candidate& candidate) {
      const bool may_go = enters(candidate);
      kept_out = kept_out || !may_go;
      return may_go;
    });
    if (next.triangle == kNoIndex) return {here, true, false, kept_out};
    if (stops_at(next.triangle)) return {here, false, true};
    kept_out = false;
  }
  return {here, false};
}

}  // namespace

WalkResult walkToNearest(const Surface& surface, const SurfacePoint& from, const Vec3& target,
                         double path_mm) noexcept {
  return walk(surface, from, target, path_mm, [](Index) { return false; });
}

WalkResult walkOnOneSheet(const Surface& surface, const SurfacePoint& from, const Vec3& target,
                          double path_mm) noexcept {
  const SurfaceGeometry& geometry = *surface.geometry;
  const auto is_entangled = [&](Index t) { return !geometry.entangled.empty() && geometry.entangled[t] != 0; };
  if (!geometry.cracked.empty()) {
    return walk(surface, from, target, path_mm, is_entangled, [&](const Candidate& candidate) {
      return !isInCrack(geometry, candidate.triangle, candidate.closest.point);
    });
  }
  if (geometry.entangled.empty()) return walkToNearest(surface, from, target, path_mm);
  return walk(surface, from, target, path_mm, is_entangled);
}

WalkResult walkOnListed(const Surface& surface, std::span<const Index> triangles, const SurfacePoint& from,
                        const Vec3& target, double path_mm) noexcept {
  return walk(surface, from, target, path_mm, [&](Index triangle) {
    const bool entangled = !surface.geometry->entangled.empty() && surface.geometry->entangled[triangle] != 0;
    return entangled || std::ranges::find(triangles, triangle) == triangles.end();
  });
}

Vec3 normalAt(const Surface& surface, const SurfacePoint& point) noexcept {
  const TriangleRecord& record = surface.geometry->tree.records[point.triangle];
  if (tree::isCorner(point.feature)) {
    return surface.geometry->vertex_normals[record.vertices[tree::indexOf(point.feature)]];
  }
  const Vec3 normal = faceNormal(record);
  if (!tree::isEdge(point.feature)) return normal;
  const Index across = record.neighbours[tree::indexOf(point.feature)];
  if (across == kNoIndex) return normal;
  return (normal + faceNormal(surface.geometry->tree.records[across])).stableNormalized();
}

bool onBorder(const Surface& surface, const SurfacePoint& point) noexcept {
  const TriangleRecord& record = surface.geometry->tree.records[point.triangle];
  if (tree::isEdge(point.feature)) return record.neighbours[tree::indexOf(point.feature)] == kNoIndex;
  if (!tree::isCorner(point.feature)) return false;
  return surface.geometry->vertex_on_border[record.vertices[tree::indexOf(point.feature)]] != 0;
}

bool hasFeatureAt(const Surface& surface, Index triangle, const SurfacePoint& point) noexcept {
  if (triangle == point.triangle) return true;
  const TriangleRecord& record = surface.geometry->tree.records[point.triangle];
  const auto has = [&](int corner) {
    const auto& vertices = surface.geometry->tree.records[triangle].vertices;
    const Index vertex = record.vertices[corner];
    return vertices[0] == vertex || vertices[1] == vertex || vertices[2] == vertex;
  };
  if (tree::isCorner(point.feature)) return has(tree::indexOf(point.feature));
  if (!tree::isEdge(point.feature)) return false;
  return has(tree::indexOf(point.feature)) && has((tree::indexOf(point.feature) + 1) % 3);
}

void prefetchNeighbours(const Surface& surface, Index triangle, bool arrived) noexcept {
  const TriangleRecord& record = surface.geometry->tree.records[triangle];
  for (int i = 0; i < 3; ++i) {
    if (record.neighbours[i] == kNoIndex) continue;
    const TriangleRecord& across = surface.geometry->tree.records[record.neighbours[i]];
    if (arrived) {
      hwy::Prefetch(&across.corners);
      hwy::Prefetch(&across.vertices);  // on the next cache line
      hwy::Prefetch(&surface.geometry->tree.source_triangle[record.neighbours[i]]);
      continue;
    }
    // The corner of `across` that is not on the edge: the other two cancel out.
    const Index far = across.vertices[0] ^ across.vertices[1] ^ across.vertices[2] ^ record.vertices[i] ^
                      record.vertices[(i + 1) % 3];
    hwy::Prefetch(&(*surface.stiffness_n_per_mm)[far]);
    hwy::Prefetch(&surface.geometry->vertex_normals[far]);
  }
}

SkinHere skinAt(const Surface& surface, const SurfacePoint& point) noexcept {
  const TriangleRecord& record = surface.geometry->tree.records[point.triangle];
  const Vec3 weights = tree::barycentricWeights(record.corners, point.position);
  SkinHere here;
  for (int i = 0; i < 3; ++i) here.stiffness_n_per_mm += weights[i] * (*surface.stiffness_n_per_mm)[record.vertices[i]];
  if (surface.tissue_mm.empty()) return here;
  for (int i = 0; i < 3; ++i) here.tissue_mm += weights[i] * surface.tissue_mm[record.vertices[i]];
  return here;
}

}  // namespace palpate::contact

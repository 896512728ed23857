// Moving over the skin: from a point of the surface downhill to the place nearest to a target.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <type_traits>

#include "palpate/contact/finger.h"
#include "palpate/contact/surface.h"

namespace palpate::contact {

/// A path, or a reach, without a bound, mm.
inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

struct WalkResult {
  SurfacePoint at;
  bool finished = false;  ///< false: the path or the moves were used up on the way
  bool stopped = false;   ///< it ended before a triangle that it may not enter
  bool at_crack = false;  ///< it finished at the rim of a crack (narrow_cracks.h) whose wall is nearer to the target
};

/// Walks from triangle to triangle while that brings the target strictly nearer, at most `path_mm` far. Each piece of
/// the way lies inside one triangle, so it is a path on the skin and not a jump, and it ends at a local minimum of the
/// distance to `target`.
WalkResult walkToNearest(const Surface& surface, const SurfacePoint& from, const Vec3& target, double path_mm) noexcept;

/// The same, but it goes no farther than to the triangles marked in Surface::entangled, nor within them, and round the
/// mouths of cracks.
WalkResult walkOnOneSheet(const Surface& surface, const SurfacePoint& from, const Vec3& target,
                          double path_mm) noexcept;

/// walkOnOneSheet over the listed triangles alone (records of the tree): for a finger that sees no others. A short
/// list: each move searches it.
WalkResult walkOnListed(const Surface& surface, std::span<const Index> triangles, const SurfacePoint& from,
                        const Vec3& target, double path_mm) noexcept;

/// Unit; zero of a triangle without area.
inline Vec3 faceNormal(const tree::TriangleRecord& record) noexcept {
  return mesh::areaVector2(record.corners[0], record.corners[1], record.corners[2]).stableNormalized();
}

/// The unit normal whose side test is exact at that place: of the face, of both faces of the edge, of the vertex.
Vec3 normalAt(const Surface& surface, const SurfacePoint& point) noexcept;

/// Whether the sheet ends at that place.
bool onBorder(const Surface& surface, const SurfacePoint& point) noexcept;

/// Whether the triangle has the corner, the edge or the face on which the point lies.
bool hasFeatureAt(const Surface& surface, Index triangle, const SurfacePoint& point) noexcept;

/// The skin's properties at a place.
struct SkinHere {
  double stiffness_n_per_mm = 0.0;
  double tissue_mm = 0.0;  ///< over the bone; 0 where that is not known
};

/// Barycentric from the vertices (E3).
SkinHere skinAt(const Surface& surface, const SurfacePoint& point) noexcept;

/// Asks the processor for what a walk into the neighbours of `triangle` would read, so that it is there when the finger
/// is. In two stages, because what is read at the neighbours' vertices is known only when the neighbours are there:
/// `arrived` in the tick in which the finger comes to the triangle, not in those in which it stays. Changes nothing.
void prefetchNeighbours(const Surface& surface, Index triangle, bool arrived) noexcept;

/// Calls visit(triangle, corner) for the triangles around a corner of `triangle`, itself first. A `visit` that returns
/// a bool ends it with false.
template <class Visit>
void visitFan(const Surface& surface, Index triangle, int corner, Visit&& visit) noexcept {
  const auto& records = surface.geometry->tree.records;
  const Index vertex = records[triangle].vertices[corner];
  const auto corner_of = [&](Index t) {
    const auto& vertices = records[t].vertices;
    return vertices[0] == vertex ? 0 : (vertices[1] == vertex ? 1 : 2);
  };
  const auto goes_on = [&](Index t, int c) {
    if constexpr (std::is_same_v<decltype(visit(t, c)), bool>) {
      return visit(t, c);
    } else {
      visit(t, c);
      return true;
    }
  };
  Index t = triangle;
  int c = corner;
  do {  // counter-clockwise, until the fan closes or the sheet ends
    if (!goes_on(t, c)) return;
    t = records[t].neighbours[(c + 2) % 3];
    if (t != kNoIndex) c = corner_of(t);
  } while (t != kNoIndex && t != triangle);
  if (t == triangle) return;
  t = records[triangle].neighbours[corner];
  for (; t != kNoIndex; t = records[t].neighbours[c]) {  // the rest, clockwise
    c = corner_of(t);
    if (!goes_on(t, c)) return;
  }
}

// Force shading: a smooth stand-in for the facets under a point finger.

struct ShadedProxy {
  Vec3 position = Vec3::Zero();  ///< on the facets
  Vec3 normal = Vec3::Zero();    ///< unit, blended from the vertices
  double depth_mm = 0.0;         ///< from the tip along the normal
};

/// The place of the skin whose blended normal meets the tip, looked for from the proxy of the walk. Nothing when there
/// is none nearby: bumps smaller than the depth, borders.
std::optional<ShadedProxy> shadedProxy(const Surface& surface, const SurfacePoint& proxy, const Vec3& tip) noexcept;

}  // namespace palpate::contact

// The point of a triangle nearest to a given point, and on which feature of the triangle it lies.
#pragma once

#include <array>
#include <cstdint>

#include "palpate/base/vec.h"

namespace palpate::tree {

/// Where on a triangle a point lies. Edge i joins corner i and corner (i + 1) mod 3.
enum class Feature : std::uint8_t { face, edge0, edge1, edge2, corner0, corner1, corner2 };

inline bool isEdge(Feature feature) { return feature >= Feature::edge0 && feature <= Feature::edge2; }
inline bool isCorner(Feature feature) { return feature >= Feature::corner0; }
/// Index of the edge or corner, 0 to 2. Only for an edge or a corner.
inline int indexOf(Feature feature) { return (static_cast<int>(feature) - 1) % 3; }
inline Feature edgeFeature(int edge) { return static_cast<Feature>(1 + edge); }
inline Feature cornerFeature(int corner) { return static_cast<Feature>(4 + corner); }

/// (2 area)^2 below this share of (longest edge)^4 is noise of doubles: the face's normal means nothing there, the
/// edges still do. A relative bound, so the unit of length does not matter.
inline constexpr double kSliverShare = 1e-20;

/// A place this near to an edge or a corner, as a share of the triangle, is on it. A point there only by rounding must
/// not count as the middle of a face: a walk would not look at the neighbours, which may be nearer.
inline constexpr double kOnBorder = 1e-12;

struct ClosestOnTriangle {
  Vec3 point;
  Feature feature;
  double squared_distance;
};

/// Serves slivers and triangles without area too: there only the edges are asked.
ClosestOnTriangle closestOnTriangle(const std::array<Vec3, 3>& corners, const Vec3& point) noexcept;

/// Barycentric weights of a point of the triangle (or of its projection on the plane): sum 1, each clamped to [0, 1].
/// A triangle without area is treated as its longest edge.
Vec3 barycentricWeights(const std::array<Vec3, 3>& corners, const Vec3& point) noexcept;

}  // namespace palpate::tree

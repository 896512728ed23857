// The triangle surface that all other code works on.
#pragma once

#include <vector>

#include "palpate/base/vec.h"

namespace palpate::mesh {

/// A triangle soup over shared vertices. Positions in millimetre. Nothing is promised about it until `validate` has
/// looked at it and `repair` has mended it.
struct TriangleMesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
};

/// The axis-aligned box of all vertices; empty (min > max) for a mesh without vertices.
Eigen::AlignedBox3d boundingBox(const TriangleMesh& mesh);

/// Adds all vertices and triangles of another mesh than `to` itself behind those of `to`.
void append(const TriangleMesh& more, TriangleMesh& to);

/// Farther out than this (mm) a coordinate is as good as infinite: products of three still fit a double.
inline constexpr double kFarthestCoordinate = 1e100;

/// Finite and not absurdly far: what geometry can be computed with.
inline bool isUsable(const Vec3& position) { return (position.array().abs() <= kFarthestCoordinate).all(); }

/// Twice the area vector of a triangle: its direction is the outward normal, its length twice the area (mm^2).
inline Vec3 areaVector2(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a); }

inline Vec3 areaVector2(const TriangleMesh& mesh, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  return areaVector2(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
}

/// Whether two of its corners are one vertex.
inline bool hasRepeatedCorner(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }
/// Whether the vertex is one of its corners.
inline bool hasCorner(const Triangle& t, Index v) { return t[0] == v || t[1] == v || t[2] == v; }

/// The middle of a triangle.
inline Vec3 centreOf(const TriangleMesh& mesh, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  return (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
}

// Area-weighted normals.

/// Unit normal of each triangle; zero for one without area.
std::vector<Vec3> triangleNormals(const TriangleMesh& mesh);

/// Unit normal of each vertex: the sum of the area vectors of its triangles, normalised; zero for an unused vertex.
std::vector<Vec3> vertexNormals(const TriangleMesh& mesh);

}  // namespace palpate::mesh

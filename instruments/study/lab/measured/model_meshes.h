// Substitutes for the dissertation's models, which were never published.
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/base/skin_place.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::study {

inline constexpr std::size_t kBackTriangles = 2962;      ///< back of Figure 3.2
inline constexpr std::size_t kHandTriangles = 2818;      ///< hand of Appendix A (E13), 1418 vertices
inline constexpr std::size_t kNamelessTriangles = 2786;  ///< model of Appendix A with 1401 vertices and no name

/// The built-in sheet of 350 x 400 x 120 mm without bones showing: made at once.
mesh::TriangleMesh backModel(std::size_t triangles = kBackTriangles);
/// The built-in hand; replaces the bunny as the closed model.
mesh::TriangleMesh handModel();

/// The built-in hand cut open at the wrist: exactly `triangles` (even) triangles, and as many vertices as Appendix A
/// counts, 1418 for 2818 by a border of 16 edges, 1401 for 2786 by one of 14.
mesh::TriangleMesh openHandModel(std::size_t triangles);

/// The border of the back seen along z, a closed polygon in mm.
std::vector<Vec2> backOutline();
bool isInside(const std::vector<Vec2>& polygon, const Vec2& place);

// Places of a model where a study puts its finger.

/// Spread over the surface by area, with the normals of their triangles; the same for the same mesh and seed. Throws
/// Error for a mesh without area.
std::vector<SkinPlace> skinPlaces(const mesh::TriangleMesh& mesh, int count, std::uint64_t seed = 1);

/// The longest edge of any triangle, mm.
double longestTriangleEdge(const mesh::TriangleMesh& mesh);

}  // namespace palpate::study

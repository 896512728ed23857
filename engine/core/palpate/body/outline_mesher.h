// Cuts a flat outline into an exact number of well-shaped triangles.
//
// The plane has a regular triangular lattice; its part inside the outline by about half a cell is kept, and a band of
// triangles joins it to vertices placed on the outline. The number of border vertices is free within a few percent, and
// each one is one triangle: the cell size is searched until that freedom meets the requested count exactly. The
// built-in skin is drawn with it at any density (back.h, torso.h): plane = (radius x angle, height), lifted onto the
// smooth surface.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::body {

/// A region |p| <= w(q), symmetric about p = 0, given by its right border. Millimetre.
struct FlatOutline {
  std::vector<Vec2> right;           ///< (p, q) with p > 0, q strictly increasing
  std::vector<std::size_t> corners;  ///< ascending indices into `right` that must become vertices; with 0 and the last
};

struct FlatMesh {
  std::vector<Vec2> points;         ///< the first `border` of them go counter-clockwise round the outline
  std::vector<Triangle> triangles;  ///< counter-clockwise
  Index border = 0;
};

/// Maps a point of the plane into space; only for the shape of triangles near the border.
using Lift = std::function<Vec3(const Vec2&)>;

/// Fewest triangles that still follow an outline as intricate as the back's.
inline constexpr std::size_t kFewestTriangles = 500;

/// Exactly `triangles` triangles, one disc. Throws Error below kFewestTriangles. Time and memory proportional to the
/// count; deterministic.
FlatMesh meshOutline(const FlatOutline& outline, std::size_t triangles, const Lift& lift);

/// Its last step (border_band.cpp): flips edges and moves inner vertices within a few rings of the border, judged by
/// the shape of the lifted triangles. Border vertices stay. Time proportional to the border after one pass over the
/// mesh.
void improveBand(FlatMesh& mesh, const Lift& lift);

}  // namespace palpate::body

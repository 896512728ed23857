// Triangles over the same three vertices: given twice, or from both sides.
//
// Two opposite ones are a sheet without thickness. Its normals cancel, so a finger would lose contact while it is
// inside the body next to it. They are counted with their sign, so that a watertight mesh stays watertight: a
// triangle given twice one way and once the other is that triangle once.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// Triangles with the same three different vertices, at least two, ascending.
using TwinGroup = std::vector<Index>;

/// All groups, by their lowest vertex. Indices must be within range.
std::vector<TwinGroup> twinGroups(const TriangleMesh& mesh);

/// Whether a triangle runs through its three vertices in ascending order (cyclically).
inline bool isAscending(const Triangle& t) { return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2; }

struct DoubledRemoved {
  std::size_t duplicates = 0;      ///< triangles that had an earlier twin with the same winding
  std::size_t cancelled = 0;       ///< opposite pairs over the vertices of a triangle that is left over and stays
  std::size_t opposite_pairs = 0;  ///< fins: both triangles are gone
  std::size_t sides = 0;           ///< one of two opposite triangles is gone, because the surface needs the other
};

/// Afterwards the triangles over three vertices all run the same way, and there is one of them, unless the edges around
/// balance only with more (two bodies that share a part of their skin): then those stay, for `makeFans` to take apart.
/// With as many one way as the other, the pair is a fin and goes altogether, unless it fills a hole of the surface
/// around it or everything in the mesh is given from both sides; then its first one stays.
///
/// An edge that as many triangles used one way as the other keeps that balance, except where a first one of a pair
/// stays.
DoubledRemoved removeDoubled(TriangleMesh& mesh);

}  // namespace palpate::mesh

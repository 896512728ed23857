// How thick a body is under each of its vertices, as far as a dent can be deep.
#pragma once

#include <vector>

#include "palpate/tree/triangle_tree.h"

namespace palpate::tree {

/// The way from a place of the skin along `inwards` (unit) to where it leaves the body, at most `most_mm`: infinite
/// where it does not leave within that. mm. About 0.3 us.
double wayThrough(const TriangleTree& tree, const Vec3& place, const Vec3& inwards, double most_mm) noexcept;

/// Per vertex of `tree`'s mesh the way against `normals[v]` (unit, out of the body) from the vertex to where it leaves
/// the body, at most `most_mm`: infinite where it does not leave within that. mm. About 0.3 us a vertex: it looks no
/// farther. A normal may be zero or not finite: infinite.
std::vector<float> thicknessUpTo(const TriangleTree& tree, const std::vector<Vec3>& positions,
                                 const std::vector<Vec3>& normals, double most_mm);

}  // namespace palpate::tree

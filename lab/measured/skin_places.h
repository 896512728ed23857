// Places of a model where a study puts its finger.
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/base/skin_place.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::study {

/// Spread over the surface by area, with the normals of their triangles; the same for the same mesh and seed. Throws
/// Error for a mesh without area.
std::vector<SkinPlace> skinPlaces(const mesh::TriangleMesh& mesh, int count, std::uint64_t seed = 1);

/// The longest edge of any triangle, mm.
double longestTriangleEdge(const mesh::TriangleMesh& mesh);

}  // namespace palpate::study

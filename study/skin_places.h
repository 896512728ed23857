// Places of a model where a study puts its finger.
#pragma once

#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::study {

struct SkinPlace {
  Vec3 point = Vec3::Zero();    ///< on the skin
  Vec3 outward = Vec3::Zero();  ///< unit normal of its triangle
};

/// Spread over the surface by area; the same for the same mesh and seed. Throws Error for a mesh without area.
std::vector<SkinPlace> skinPlaces(const mesh::TriangleMesh& mesh, int count, std::uint64_t seed = 1);

/// The longest edge of any triangle, mm.
double longestTriangleEdge(const mesh::TriangleMesh& mesh);

}  // namespace palpate::study

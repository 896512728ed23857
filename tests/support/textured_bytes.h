// Surfaces whose texture is known in closed form, and files that hold them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "palpate/mesh/textured_mesh.h"

namespace palpate::support {

/// Where a corner at `place` of the triangle around `middle` lies in the picture.
using TextureLaw = std::function<mesh::TexturePlace(const Vec3& place, const Vec3& middle)>;

/// The whole picture once over the sheet of zoo::grid.
mesh::TexturePlace onSheet(const Vec3& place, const Vec3& middle);
/// Each side of zoo::cube(10) in a third by half of the picture: seams along all edges.
mesh::TexturePlace onCube(const Vec3& place, const Vec3& middle);
/// Round a sphere about the origin, u once around z, v from below to above: one seam where y = 0, x < 0.
mesh::TexturePlace onSphere(const Vec3& place, const Vec3& middle);

std::vector<mesh::TextureCorners> cornersBy(const TextureLaw& law, const mesh::TriangleMesh& mesh);

/// Positions once, a `vt` for each corner.
std::string texturedObjBytes(const mesh::TriangleMesh& mesh, const TextureLaw& law);

}  // namespace palpate::support

// The picture of a mesh file on its surface, and its transfer to another mesh of the same surface.
//
//   file ─ loadTextured ─► TexturedMesh ─ textureOn ─► a place in the picture for every corner of another mesh
//
// Separate from `load`, for drawing only: the mesh that is felt keeps positions and triangles only, and repair, welding
// and reordering give them new numbers. The picture is therefore matched by place, not by number.
#pragma once

#include <array>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// A place in a picture: (0, 0) is its lower left corner, (1, 1) its upper right one; beyond, the picture repeats.
using TexturePlace = Vec2f;

/// One triangle's places, in the order of its corners.
using TextureCorners = std::array<TexturePlace, 3>;

/// A surface with its picture: triangles share vertices only where the picture is continuous.
struct TexturedMesh {
  TriangleMesh mesh;                 ///< mm, every triangle usable
  std::vector<TexturePlace> places;  ///< one per vertex
};

/// The corners of another mesh of this surface in its picture: those of the nearest textured triangle. Each corner is
/// looked up a little inside its own triangle, so that on a seam it gets its own side. One entry per triangle of
/// `mesh`. `textured` must have triangles. About 3 us a triangle.
std::vector<TextureCorners> textureOn(const TriangleMesh& mesh, const TexturedMesh& textured,
                                      const Progress& progress = {});

}  // namespace palpate::mesh

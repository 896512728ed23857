// The drawn skin's vertices: those of the skin, and after them a copy for each further place in the picture that a
// vertex on a seam of the texture has.
//
// Only the drawing knows the copies: what is felt and deformed keeps its vertices, and a copy gets the values of its
// vertex on their way to the graphics card. No GL.
#pragma once

#include <span>
#include <vector>

#include "palpate/deform/surface.h"
#include "palpate/mesh/textured_mesh.h"

namespace palpate::view {

struct DrawnVertices {
  Index of_skin = 0;                       ///< the skin's own, first in every array
  std::vector<Index> copied;               ///< for each copy after them the vertex that it repeats, ascending
  std::vector<Triangle> triangles;         ///< all of the skin's, in their order
  std::vector<mesh::TexturePlace> places;  ///< a drawn vertex each; empty without a texture

  Index count() const { return of_skin + static_cast<Index>(copied.size()); }
  /// The copies of vertices in a range, as a range of copies.
  deform::VertexRange copiesIn(const deform::VertexRange& range) const;
  /// 1 for a drawn vertex with copies, for a copy, and for all joined to one by a triangle.
  std::vector<std::uint8_t> nearSeam() const;

  /// The values of a skin, a vertex each, followed by those of the copies.
  template <class T>
  std::vector<T> withCopies(std::span<const T> values) const {
    std::vector<T> all(values.begin(), values.end());
    all.reserve(count());
    for (const Index v : copied) all.push_back(values[v]);
    return all;
  }
};

/// A skin without a texture: no copies.
DrawnVertices drawnVertices(Index vertices, std::span<const Triangle> triangles);
/// With one; `corners` has an entry a triangle. Corners of a vertex nearer to each other in the picture than
/// kSamePlace share a drawn vertex.
DrawnVertices drawnVertices(Index vertices, std::span<const Triangle> triangles,
                            std::span<const mesh::TextureCorners> corners);

/// Under half a pixel of a picture of 4096.
inline constexpr float kSamePlace = 1e-4f;

}  // namespace palpate::view

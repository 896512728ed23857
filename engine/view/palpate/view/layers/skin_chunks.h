// The skin's triangles in chunks, to draw each with no more work than it needs: nothing for those outside the picture,
// the shader with shadows and blanching only where a finger is near.
//
// The mesh is sorted along Morton's curve, which goes through the cells of an octree one after the other: eight
// consecutive chunks are about a cell, eight of these the next larger one. This tree drops or accepts whole parts of a
// body without a look at their chunks. No GL: index ranges out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/deform/surface.h"
#include "palpate/mesh/textured_mesh.h"
#include "palpate/view/camera.h"

namespace palpate::view {

/// The region in which something affects the skin: all within `radius` of a segment, mm.
struct Influence {
  Vec3f from = Vec3f::Zero();
  Vec3f to = Vec3f::Zero();
  float radius_mm = 0.0f;
};

/// Consecutive indices to draw.
struct IndexRun {
  Index first = 0;
  Index count = 0;
};

struct SplitRuns {
  std::vector<IndexRun> touched;
  std::vector<IndexRun> plain;
};

/// A surface at rest to be drawn.
struct DrawnShape {
  std::span<const Vec3f> places;
  std::span<const Vec3f> normals;
  std::span<const Triangle> triangles;
};

/// Vertices that a coarser set must keep.
enum class Required : std::uint8_t { no, vertex, cell };  // cell: and all that share a cube with it

/// Fewer triangles over some of the same vertices, for a skin that is seen so small that several triangles share a
/// pixel: each cube of `cell_mm` keeps one vertex, and those that must stay. They deform with it. `stays` has one entry
/// per vertex. Triangles keep the shape's order.
std::vector<Triangle> coarserTriangles(const DrawnShape& shape, std::span<const Required> stays, float cell_mm);

class SkinChunks {
 public:
  /// `triangles` over vertices at these places.
  SkinChunks(std::span<const Vec3f> places, std::span<const Triangle> triangles);

  /// The chunks that may be seen, neighbouring ones joined; without `cull` all of them. Valid until the next call.
  const SplitRuns& split(const Mat4f& clip, std::span<const Influence> influences, bool cull = true);
  /// Spheres that the last split tested.
  std::size_t tested() const { return tested_; }

 private:
  struct Sphere {
    Vec3f centre;
    float radius_mm;  // at rest
  };
  struct Question;

  void visit(const Question& question, std::size_t level, std::size_t node);
  void appendChunks(std::vector<IndexRun>& runs, std::size_t first_chunk, std::size_t end_chunk);

  std::vector<std::vector<Sphere>> levels_;  // the chunks, then cells of eight of the level before
  Index indices_ = 0;
  std::size_t tested_ = 0;
  SplitRuns runs_;
};

/// The drawn skin's vertices: those of the skin, then a copy for each further place in the picture that a vertex on a
/// seam of the texture has.
///
/// Only the drawing knows the copies: contact and deformation keep the skin's vertices, and a copy gets the values of
/// its vertex on their way to the graphics card. No GL.
struct DrawnVertices {
  Index of_skin = 0;                       ///< the skin's own, first in every array
  std::vector<Index> copied;               ///< the vertex that each copy repeats, ascending
  std::vector<Triangle> triangles;         ///< all of the skin's, in order
  std::vector<mesh::TexturePlace> places;  ///< one per drawn vertex; empty without a texture

  Index count() const { return of_skin + static_cast<Index>(copied.size()); }
  /// The copies of vertices in a range, as a range of copies.
  deform::VertexRange copiesIn(const deform::VertexRange& range) const;
  /// 1 for a drawn vertex with copies, for a copy, and for all joined to one by a triangle.
  std::vector<std::uint8_t> nearSeam() const;

  /// The values of a skin, one per vertex, followed by those of the copies.
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
/// For a skin with a texture; `corners` has one entry per triangle. Corners of a vertex nearer to each other in the
/// picture than kSamePlace share a drawn vertex.
DrawnVertices drawnVertices(Index vertices, std::span<const Triangle> triangles,
                            std::span<const mesh::TextureCorners> corners);

/// Under half a pixel of a picture of 4096.
inline constexpr float kSamePlace = 1e-4f;

}  // namespace palpate::view

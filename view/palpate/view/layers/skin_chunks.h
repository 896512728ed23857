// The skin's triangles in chunks, to draw each with no more work than it needs: nothing for what is out of the picture,
// the shader with shadows and blanching only where a finger is near.
//
// The mesh is sorted along Morton's curve, which goes through the cells of an octree one after the other: eight
// consecutive chunks are about a cell, eight of these the next larger one. By this tree whole parts of a body are left
// out, or taken, without a look at their chunks. No GL: index ranges out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/view/camera.h"

namespace palpate::view {

/// Where something matters to the skin: all within `radius` of a segment, mm.
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

/// Which vertices a coarser set must keep.
enum class Stays : std::uint8_t { no, vertex, cell };  // cell: and all that share a cube with it

/// Fewer triangles over some of the same vertices, for a skin that is seen so small that several triangles share a
/// pixel: each cube of `cell_mm` keeps one vertex, and those that must stay. They deform with it. `stays` has an entry
/// a vertex. The order is that of the shape's triangles.
std::vector<Triangle> coarserTriangles(const DrawnShape& shape, std::span<const Stays> stays, float cell_mm);

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
  void take(std::vector<IndexRun>& runs, std::size_t first_chunk, std::size_t end_chunk);

  std::vector<std::vector<Sphere>> levels_;  // the chunks, then cells of eight of the level before
  Index indices_ = 0;
  std::size_t tested_ = 0;
  SplitRuns runs_;
};

}  // namespace palpate::view

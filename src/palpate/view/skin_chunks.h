// The skin's triangles in chunks, to draw each with no more work than it needs: nothing for what is out of the picture,
// the shader with shadows and blanching only where a finger is near.
//
// The mesh is sorted spatially, so consecutive triangles lie together. No GL: index ranges out.
#pragma once

#include <span>
#include <vector>

#include "palpate/deform/skin.h"
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

/// Fewer triangles over some of the same vertices, for a skin that is seen so small that several triangles share a
/// pixel: each cube of `cell_mm` keeps one vertex, and those marked in `fixed` stay. They deform with it. The order is
/// that of the skin's triangles.
std::vector<Triangle> coarserTriangles(const deform::Skin& skin, std::span<const std::uint8_t> fixed, float cell_mm);

class SkinChunks {
 public:
  /// `triangles` of the skin: all of them, or a coarser set.
  SkinChunks(const deform::Skin& skin, std::span<const Triangle> triangles);

  /// The chunks that may be seen, neighbouring ones joined. Valid until the next call.
  const SplitRuns& split(const Mat4f& clip, std::span<const Influence> influences);

 private:
  struct Chunk {
    Vec3f centre;
    float radius_mm;  // at rest
  };

  std::vector<Chunk> chunks_;
  Index indices_ = 0;
  SplitRuns runs_;
};

}  // namespace palpate::view

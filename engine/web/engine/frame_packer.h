// A deformed skin as the page uploads it: ranges of vertices, and for each vertex in them seven floats.
//
//   DeformedSurface ─ changed() ─► ranges, values ─► worker copies both out of the engine's memory ─► WebGL buffer
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/deform/surface.h"

namespace palpate::web {

/// x, y, z, then the unit normal, then the strain (> 0 is tension).
inline constexpr std::size_t kFloatsOfVertex = 7;

class FramePacker {
 public:
  /// Packs the result of the last apply to `surface`.
  void pack(const deform::DeformedSurface& surface);
  /// All vertices.
  void packAll(const deform::DeformedSurface& surface);

  /// First and end of each range, one after the other.
  const std::vector<std::uint32_t>& ranges() const { return ranges_; }
  /// kFloatsOfVertex for each vertex of the ranges, in order.
  const std::vector<float>& values() const { return values_; }

 private:
  void begin();
  void add(const deform::DeformedSurface& surface, deform::VertexRange range);

  std::vector<std::uint32_t> ranges_;
  std::vector<float> values_;
};

}  // namespace palpate::web

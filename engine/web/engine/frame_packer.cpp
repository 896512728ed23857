// Streams of one axis each become vertices, as a vertex buffer wants them.
#include "engine/frame_packer.h"

#include <algorithm>
#include <array>
#include <span>

namespace palpate::web {

void FramePacker::begin() {
  ranges_.clear();
  values_.clear();
}

void FramePacker::add(const deform::DeformedSurface& surface, deform::VertexRange range) {
  const std::array<std::span<const float>, kFloatsOfVertex> streams = {
      surface.position(0), surface.position(1), surface.position(2), surface.normal(0),
      surface.normal(1),   surface.normal(2),   surface.strain()};
  ranges_.push_back(range.first);
  ranges_.push_back(range.end);
  const std::size_t start = values_.size();
  values_.resize(start + (range.end - range.first) * kFloatsOfVertex);
  float* out = values_.data() + start;
  const Vec3f origin = surface.origin().cast<float>();
  for (Index v = range.first; v < range.end; ++v) {
    for (std::size_t i = 0; i < streams.size(); ++i) {
      *out++ = i < 3 ? origin[static_cast<Eigen::Index>(i)] + streams[i][v] : streams[i][v];
    }
  }
}

void FramePacker::pack(const deform::DeformedSurface& surface) {
  begin();
  for (const deform::VertexRange range : surface.changed()) {
    add(surface, {range.first, std::min(range.end, surface.vertices())});
  }
}

void FramePacker::packAll(const deform::DeformedSurface& surface) {
  begin();
  add(surface, {0, surface.vertices()});
}

}  // namespace palpate::web

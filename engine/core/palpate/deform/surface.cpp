// Ten streams in one allocation, which start at other places of their pages than the rest shape's (FloatStreams): a
// kernel that reads those and writes these would stall otherwise.
// Data flow: the deformer's kernels, normals and strain -> here, block by block -> changed() -> upload, files.
#include "palpate/deform/surface.h"

#include <algorithm>

#include "palpate/deform/kernels/kernels.h"

namespace palpate::deform {

DeformedSurface::DeformedSurface(const Skin& skin)
    : vertices_(skin.vertices),
      origin_(skin.origin),
      // the rest shape's arrays take the phases before (FloatStreams)
      streams_(kStreams, std::size_t{skin.blocks} * kBlockVertices, kRestStreams),
      written_(skin.blocks) {
  changed_.reserve(skin.blocks);
  for (Index b = 0; b < skin.blocks; ++b) restore(skin, b);
}

DeformedBlock DeformedSurface::block(Index block) {
  DeformedBlock values{};
  for (int i = 0; i < kStrain; ++i) values.values[i] = streams_[i] + std::size_t{block} * kBlockVertices;
  return values;
}

void DeformedSurface::setNormal(Index v, const Vec3f& normal) {
  for (int axis = 0; axis < 3; ++axis) streams_[kNormal + axis][v] = normal[axis];
}

void DeformedSurface::setStrain(Index v, float strain) {
  streams_[kStrain][v] = strain;
  has_strain_ = true;
}

void DeformedSurface::forgetStrain() {
  if (!has_strain_) return;
  std::fill_n(streams_[kStrain], vertices_, 0.0f);
  has_strain_ = false;
}

void DeformedSurface::restore(const Skin& skin, Index block) {
  restoreBlocks(1, skin.restBlock(block), this->block(block));
  std::fill_n(streams_[kStrain] + std::size_t{block} * kBlockVertices, kBlockVertices, 0.0f);
}

void DeformedSurface::listChange(Index block) {
  const Index first = block * kBlockVertices;
  const Index end = std::min(first + kBlockVertices, vertices_);
  if (!changed_.empty() && changed_.back().end == first) {
    changed_.back().end = end;
  } else {
    changed_.push_back({first, end});
  }
}

}  // namespace palpate::deform

// Area-weighted normals of single vertices of a deformed surface: the reference that the analytic ones are held
// against.
#pragma once

#include "palpate/deform/skin.h"

namespace palpate::deform {

struct PositionStreams {
  const float* x;
  const float* y;
  const float* z;
  Vec3 at(Index v) const { return {x[v], y[v], z[v]}; }
};

/// The sum of the area vectors of the vertex's triangles, normalised; zero where it has none. The same positions give
/// the same bits, at rest and deformed: a surface that came back has its rest normals.
Vec3f areaWeightedNormal(const Skin& skin, const PositionStreams& positions, Index vertex) noexcept;

}  // namespace palpate::deform

// The smallest surface over a closed run of edges, from its own vertices alone.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::mesh {

struct LoopTriangulation {
  std::vector<Triangle> triangles;  ///< of places in the run; each runs along it
  double area = 0.0;                ///< mm^2
};

/// Triangulates the run; none when every way needs a diagonal that is not `allowed` (asked with two places, i < j, that
/// are no neighbours). Time grows with the cube of the number of vertices: 1 ms for 60, 30 ms for 200.
std::optional<LoopTriangulation> triangulateLoop(std::span<const Vec3> loop,
                                                 const std::function<bool(Index, Index)>& allowed);

}  // namespace palpate::mesh

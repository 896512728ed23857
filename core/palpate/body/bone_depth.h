// How deep bone lies under each point of the skin, and which bone it is.
#pragma once

#include <span>
#include <vector>

#include "palpate/body/bones.h"

namespace palpate::body {

/// One entry a point. Depth is the distance to the nearest point of any bone (mm), in whatever direction it lies: a
/// finger that presses feels the nearest hard thing, and unlike a depth along the normal it has no jumps. It is never
/// negative: a point inside a bone has its distance to the surface as well.
struct BoneDepth {
  std::vector<double> depth_mm;
  std::vector<Index> bone;  ///< index into the bones given
};

/// Depths of the points below, or beside, the bones. Throws Error when there is no bone. Fastest when neighbouring
/// points follow each other, as vertices of a spatially ordered mesh do.
BoneDepth depthToBones(std::span<const Vec3> points, std::span<const Bone> bones);

}  // namespace palpate::body

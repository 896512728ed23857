// How narrow the bone is under each vertex of the skin.
//
// A finger that is moved aside, by as much as its load is wide at the bone, comes farther from a narrow bone, and stays
// as far from a wide one.
#pragma once

#include <span>
#include <vector>

#include "palpate/body/bones.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::scene {

/// Radius in mm of the round top of a post that recedes as the bone does, by the mean curvature of all directions, so
/// that a ridge counts as wider than a tip, and a flat top as wider than a round one; a vertex each. `nearest_mm`: to
/// the nearest bone, a vertex each; tissue::kFlatBoneMm beyond tissue::kDeepBoneMm. A third of a second for 30,000
/// vertices; load time.
std::vector<float> boneRadii(const mesh::TriangleMesh& skin, std::span<const double> nearest_mm,
                             std::span<const body::Bone> bones);

}  // namespace palpate::scene

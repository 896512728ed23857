// How thick the tissue is under each vertex of the skin, straight into the body, evened out over a centimetre.
//
// The thickness that a finger feels is the distance to the nearest bone, in whatever direction. How far the skin beside
// it moves goes by what lies beneath: next to a rib the nearest bone is the rib, while most of the tissue is deep.
#pragma once

#include <span>
#include <vector>

#include "palpate/body/bones.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::scene {

/// mm, a vertex each. `nearest_mm`: to the nearest bone, a vertex each, which a thickness exceeds by at most a half:
/// bone at one's side holds too. A tenth of a second for 100,000 vertices; load time.
std::vector<float> tissueBeneath(const mesh::TriangleMesh& skin, std::span<const double> nearest_mm,
                                 std::span<const body::Bone> bones);

}  // namespace palpate::scene

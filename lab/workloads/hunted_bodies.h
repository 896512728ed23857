// The bodies of `palpate study hunt`: what comes out of a generator and what users' files look like, one after the
// other.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::lab {

/// Kinds of bodies, in the order of the hunt: sound shapes (hunted_shapes.h), slivers, coarse and noisy ones,
/// self-intersecting unions, torn and doubled ones, open sheets.
std::vector<std::string> huntedBodyKinds();

/// A body of that kind, as a user's file would hold it: repair comes later. In mm, 50 to 300 mm long. The same for the
/// same seed. Throws Error for another kind.
mesh::TriangleMesh huntedBody(std::string_view kind, std::uint64_t seed);

}  // namespace palpate::lab

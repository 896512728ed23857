// The default body: a closed skin from the neck's stump to below the gluteal fold over its bones; every skin vertex
// knows the bone below it, and what an examiner looks for has a name and a place.
#pragma once

#include <cstddef>
#include <optional>

#include "palpate/body/torso.h"
#include "palpate/body/trunk/trunk_shape.h"

namespace palpate::body {

struct TrunkSettings {
  std::size_t triangles = 83164;   ///< skin and bones together, exact; even, at least kFewestTrunkTriangles
  std::size_t bone_triangles = 0;  ///< share for bones, even; 0 gives the bones 30 %, within what they need and use
  TrunkShape shape;
};
inline constexpr std::size_t kFewestTrunkSkinTriangles = 2000;
inline constexpr std::size_t kFewestTrunkTriangles = 8000;

/// The surface under the body: a plane that faces it.
struct Support {
  Vec3 point;   ///< mm, under the middle of the body
  Vec3 normal;  ///< unit, towards the body
};

struct Trunk : BonesUnderSkin {    ///< those of skeleton.h
  mesh::TriangleMesh skin;         ///< closed, outward
  std::optional<Support> support;  ///< in postures that have one
};

/// Builds the trunk; one to two seconds on two cores, most of it for the bones. Throws Error on a wrong setting.
Trunk makeTrunk(const TrunkSettings& settings = {});

}  // namespace palpate::body

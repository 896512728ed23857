// Orients the open parts of a mesh: a body with an opening is felt from its outside like a closed one.
//
// A part is connected across edges. An open one has no volume of its own; each of its border loops is closed in thought
// by a fan to the loop's middle. Where these caps are small the part is a body with openings, and the sign of its
// volume gives its side. A sheet is mostly cap: it stays undecided, and is felt from the side it was given.
#pragma once

#include <vector>

#include "palpate/mesh/topology.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

struct OpenParts {
  /// Triangles of bodies with openings that face inwards, part by part; the wall of a hollow is not among them.
  std::vector<std::vector<Index>> inside_out;
  /// Parts that may be inside out, but are as much a bowl as a body.
  std::vector<std::vector<Index>> doubtful;
  /// All the other open ones.
  std::vector<std::vector<Index>> as_given;
};

/// The winding must be consistent within each part; `edges` must be those of the mesh as it is wound. Closed parts are
/// left out (turnOutwards). Linear, except for parts inside others.
OpenParts findOpenParts(const TriangleMesh& mesh, const EdgeUses& edges);

}  // namespace palpate::mesh

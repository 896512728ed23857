// Fewer triangles, the same shape: quadric edge collapse to an exact count.
#pragma once

#include <cstddef>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

struct DecimateOptions {
  /// Weight of a border's line, against 1 for the surface.
  double border_weight = 10.0;
  /// The mesh is the half x >= 0 of a symmetric one and its border is in x == 0: border vertices stay in that plane
  /// exactly and see the mirror image, so that joining both halves afterwards leaves no crease.
  bool mirrored_at_x0 = false;
};

/// Collapses edges, cheapest first, until exactly `target_triangles` are left; a mesh without more is returned
/// unchanged. Keeps the topology (a closed manifold stays one) and turns no triangle over. Needs a manifold,
/// consistently wound mesh (mesh::repair makes one). Deterministic; the order of the vertices that stay is kept.
///
/// A closed mesh loses two triangles per collapse, so an odd target is an Error there; so is a target below what the
/// topology allows (a closed piece keeps at least 4 triangles). Errors are thrown, the input is then lost.
TriangleMesh decimate(TriangleMesh mesh, std::size_t target_triangles, const DecimateOptions& options = {});

}  // namespace palpate::mesh

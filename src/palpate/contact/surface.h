// The skin as a finger feels it: built once from a fit mesh, immutable afterwards, shared by any number of fingers.
#pragma once

#include <optional>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"
#include "palpate/tissue/force_law.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::contact {

struct SurfaceOptions {
  tissue::ForceLaw force_law;
  /// Whether sheets of the surface pierce each other. Asked of the mesh (about 0.4 us a triangle) when nothing is
  /// given.
  std::optional<bool> self_intersecting;
};

/// Plain data; every finger reads it, nobody writes it. Triangles are named by their record in the tree (leaf order).
struct Surface {
  tree::TriangleTree tree;
  std::vector<Vec3> vertex_normals;            ///< unit, weighted by angle: their side test is exact at a vertex
  std::vector<std::uint8_t> vertex_on_border;  ///< 1 where the sheet ends
  std::vector<double> stiffness_n_per_mm;      ///< per vertex
  tissue::ForceLaw force_law;
  /// A point on such a surface is felt as a very small sphere (docs/contact.md).
  bool self_intersecting = false;
  bool closed = false;  ///< no border anywhere
};

/// `mesh` must be fit for contact, as mesh::repair leaves it: an edge has at most one neighbour on each side and the
/// triangles of a vertex form one fan. One stiffness per vertex, finite and >= 0. Throws Error otherwise.
Surface buildSurface(const mesh::TriangleMesh& mesh, std::vector<double> stiffness_n_per_mm,
                     const SurfaceOptions& options = {});

}  // namespace palpate::contact

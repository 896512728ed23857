// What a mesh is and what is wrong with it: every trait that contact or deformation would stumble over, counted.
//
// Reads any TriangleMesh, also a broken one, and changes nothing. `repair` is its counterpart.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// How often a trait was found and where first: up to kMaxFirst vertex or triangle indices, ascending.
struct Trait {
  static constexpr std::size_t kMaxFirst = 5;
  std::size_t count = 0;
  std::vector<Index> first;
  void add(Index where) {
    if (count++ < kMaxFirst) first.push_back(where);
  }
};

struct ValidateOptions {
  /// Look for edges that pierce triangles. About half of the whole time.
  bool self_intersections = true;
};

struct ValidationReport {
  std::size_t vertices = 0;
  std::size_t triangles = 0;

  // Traits of vertices.
  Trait non_finite_vertices;
  Trait unused_vertices;
  Trait non_manifold_vertices;  ///< triangles around it form more than one fan
  // Traits of triangles. Those with wrong indices are left out of everything below this line.
  Trait wrong_indices;                      ///< names a vertex that does not exist
  Trait zero_area_triangles;                ///< lower than 1e-9 of the diagonal, or two corners are one vertex
  Trait duplicate_triangles;                ///< has an earlier twin with the same winding
  Trait opposite_triangles;                 ///< has an earlier twin with the opposite winding: a fin without thickness
  Trait self_intersections;                 ///< edges that pierce a triangle; `first` names triangles that are pierced
  bool self_intersections_checked = false;  ///< false: not asked for, or too many candidates
  // Traits of edges; `first` names a triangle at the edge.
  Trait non_manifold_edges;      ///< more than two triangles
  Trait inconsistent_edges;      ///< two triangles that run along it the same way
  Trait border_edges;            ///< one triangle
  std::size_t border_loops = 0;  ///< connected runs of border edges

  std::size_t components = 0;  ///< parts that share no vertex
  bool closed = false;         ///< every edge has two triangles of opposite direction (and there is a triangle)
  bool one_sided = false;      ///< cannot be wound consistently (a Moebius strip is inside)
  Eigen::AlignedBox3d box;     ///< of the finite vertices that triangles use, mm
  double area_mm2 = 0.0;
  double volume_mm3 = 0.0;  ///< 0 when not closed; negative when inside out

  /// Nothing that `repair` would change (borders, components and self-intersections are no faults).
  bool fit() const;
};

ValidationReport validate(const TriangleMesh& mesh, const ValidateOptions& options = {}, const Progress& progress = {});

/// One plain sentence for each trait found, e.g. "3 zero-area triangles (first: 7, 19, 20)".
std::vector<std::string> describe(const ValidationReport& report);

}  // namespace palpate::mesh

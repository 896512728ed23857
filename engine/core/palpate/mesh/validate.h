// Diagnosis of a mesh: every trait that contact or deformation would stumble over, counted.
//
// Reads any TriangleMesh, also a broken one, and changes nothing. `repair` is its counterpart.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/mesh/closure.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// Count of a trait and its first places: up to kMaxFirst different vertex or triangle indices, ascending.
struct Trait {
  static constexpr std::size_t kMaxFirst = 5;
  std::size_t count = 0;
  std::vector<Index> first;
  /// Places must come in ascending order; one may come again.
  void add(Index where) {
    ++count;
    if (first.size() < kMaxFirst && (first.empty() || first.back() != where)) first.push_back(where);
  }
};

/// A body outside these lengths from corner to corner (mm) was probably written in another unit: a thumb's tip, a tall
/// man and half again.
inline constexpr double kShortestBodyMm = 15.0;
inline constexpr double kLongestBodyMm = 3000.0;

/// Empty boxes are not doubtful.
bool hasDoubtfulSize(const Eigen::AlignedBox3d& box);

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
  Trait coincident_vertices;    ///< at the very place of an earlier one: a seam, or fans that touch
  Trait non_manifold_vertices;  ///< triangles around it form more than one fan
  // Traits of triangles. Those with wrong indices are left out of everything below this line.
  Trait wrong_indices;                      ///< names a vertex that does not exist
  Trait zero_area_triangles;                ///< lower than 1e-9 of the diagonal, or two corners are one vertex
  Trait duplicate_triangles;                ///< has an earlier twin with the same winding
  Trait opposite_triangles;                 ///< has an earlier twin with the opposite winding: a fin without thickness
  Trait self_intersections;                 ///< edges that pierce a triangle; `first` names triangles that are pierced
  Trait touching_edges;                     ///< edges that cross only at edges and corners of triangles; `first` these
  bool self_intersections_checked = false;  ///< false: not requested, or too many candidates
  // Traits of edges; `first` names a triangle at the edge.
  Trait non_manifold_edges;      ///< more than two triangles
  Trait inconsistent_edges;      ///< two triangles that run along it the same way
  Trait border_edges;            ///< one triangle
  std::size_t border_loops = 0;  ///< connected runs of border edges

  Trait inside_out_parts;  ///< parts that face inwards (open_parts.h, turnOutwards); `first` names a triangle of each
  Trait doubtful_parts;    ///< open parts that may: as much a bowl as a body
  std::size_t components = 0;  ///< parts that share no vertex
  Closure closure = Closure::open;
  std::size_t fillable_holes = 0;  ///< small holes of nearly closed parts, that `repair` fills
  std::size_t small_holes = 0;     ///< all of them: it may have to leave some
  bool closed = false;      ///< closure == Closure::closed: a cycle; it may still have edges of more than two triangles
  bool one_sided = false;   ///< cannot be wound consistently (a Moebius strip is inside)
  Eigen::AlignedBox3d box;  ///< box of the finite vertices that triangles use, mm
  double area_mm2 = 0.0;
  double volume_mm3 = 0.0;  ///< 0 when not closed; negative when inside out

  /// The preconditions of contact and deformation hold.
  bool sound() const;
  /// Sound, and no hole to fill: `repair` would change nothing (other borders, components, self-intersections and
  /// vertices at one place are not faults).
  bool fit() const { return sound() && fillable_holes == 0; }
};

ValidationReport validate(const TriangleMesh& mesh, const ValidateOptions& options = {}, const Progress& progress = {});

/// One plain sentence for each trait found, e.g. "3 zero-area triangles (first: 7, 19, 20)".
std::vector<std::string> describe(const ValidationReport& report);

}  // namespace palpate::mesh

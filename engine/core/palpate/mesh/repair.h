// Any mesh -> one that a finger can feel: the preconditions of contact and deformation are made true here, once, at
// load.
//
// Afterwards every edge has 0 or 1 neighbour of opposite direction, every vertex one fan of triangles, every triangle a
// height, every vertex a use. A watertight mesh stays so, small holes of nearly closed bodies are filled. Other
// borders, several components and self-intersections stay and are flagged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/mesh/closure.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// Open parts to turn over in addition to those that are plainly inside out.
enum class TurnOver : std::uint8_t {
  none,
  doubtful,  ///< those that validate reports as possibly inside out
  open       ///< every open part: a sheet that was given from its back
};

struct RepairOptions {
  /// Join vertices at equal coordinates first, so that seams of texture or shading do not become borders.
  bool weld = true;
  /// Join also vertices nearer than this (mm); 0 = equal coordinates only.
  double weld_distance_mm = 0.0;
  /// Turn closed parts outside out, and open ones that are bodies with openings (open_parts.h).
  bool orient_outwards = true;
  /// Wants orient_outwards.
  TurnOver turn_over = TurnOver::none;
  /// Fill the small holes of nearly closed parts (holes.h).
  bool fill_holes = true;
  /// Look for self-intersections of the result (costs more than all the rest).
  bool find_self_intersections = true;
};

/// One action, in plain words, e.g. {"opposite pairs of triangles removed (fins without thickness)", 12}.
struct RepairAction {
  std::string what;
  std::size_t count = 0;
  /// Triangles added by it; negative: removed. They sum up to after.triangles - before.triangles.
  std::ptrdiff_t triangles = 0;
};

struct RepairResult {
  TriangleMesh mesh;
  /// For each vertex of `mesh` the vertex it came from. Copies share theirs; a vertex that had to be put in the middle
  /// of an edge (rare) has one end of it.
  std::vector<Index> source_vertex;
  std::vector<RepairAction> actions;
  /// Warnings to read before the result is trusted, e.g. that something closed was opened.
  std::vector<std::string> warnings;
  /// As given (without unusable parts, except for the number of triangles and vertices), and as it is now.
  SurfaceState before;
  SurfaceState after;
  std::size_t components = 0;
  bool closed = false;
  bool self_intersecting = false;
};

/// The mesh may be anything, wrong indices included. Throws Error when nothing is left to feel (it names no file: the
/// caller knows which).
RepairResult repair(TriangleMesh mesh, const RepairOptions& options = {}, const Progress& progress = {});

}  // namespace palpate::mesh

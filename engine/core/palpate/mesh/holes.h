// Small holes of otherwise closed bodies: cracks between patches that were never joined, T-junctions, lost triangles.
//
// A finger that slides over such a border falls through it into a body that looks closed. `repair` fills them;
// `validate` names them. A sheet or a body that was cut is open on purpose and keeps its border.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/base/vec.h"
#include "palpate/mesh/border_loops.h"
#include "palpate/mesh/cracks.h"
#include "palpate/mesh/topology.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

// The smallest surface over a closed run of edges, from its own vertices alone.

struct LoopTriangulation {
  std::vector<Triangle> triangles;  ///< indices into the run
  double area = 0.0;                ///< mm^2
};

/// Triangulates the run; empty when every way needs a diagonal that is not `allowed` (called with two places, i < j,
/// that are not adjacent). Time grows with the cube of the number of vertices: 1 ms for 60, 30 ms for 200.
std::optional<LoopTriangulation> triangulateLoop(std::span<const Vec3> loop,
                                                 const std::function<bool(Index, Index)>& allowed);

/// A part is nearly closed when all its holes together have at most this share of its area: a round hole in a ball is
/// then as wide as a fifth of the ball at most. A hand that ends at the wrist has 4 %, a sheet about 100 %.
inline constexpr double kNearlyClosedShare = 0.01;
/// Holes up to this share of the diagonal of their part's box are filled. The width is twice the area over the length
/// of the border: a slit's own width however long it is, a round hole's radius.
inline constexpr double kWidestHoleShare = 0.02;
/// Longer borders stay open: the time to fill grows with the cube (30 ms for this many).
inline constexpr std::size_t kMaxHoleEdges = 200;
/// Loops narrower than this share of the diagonal are cracks: their sides are joined instead of filled. A hundred times
/// the rounding of single precision, and 20 um of a man: nothing that can be felt.
inline constexpr double kCrackShare = 1e-5;

enum class HoleFate : std::uint8_t {
  fillable,
  part_open,  ///< a border of something that is open
  too_wide,
  too_long,  ///< more than kMaxHoleEdges, or more of them than there is time for
  no_room    ///< every filling would cross the surface, fold back on it or use an edge that two triangles have
};

struct Hole {
  BorderLoop loop;
  Index part = 0;
  double area_mm2 = 0.0;  ///< area of its filling; the least there can be when it has none
  double width_mm = 0.0;
  HoleFate fate = HoleFate::part_open;
  std::vector<Triangle> filling;  ///< empty unless fillable
  std::vector<SideSplit> splits;  ///< splits of the sides of a crack, in place of a filling
};

struct Holes {
  std::vector<Hole> all;
  /// Edges at which the directions of the triangles do not cancel, but those of `all`: no filling closes them.
  std::size_t other_open_edges = 0;

  std::size_t count(HoleFate fate) const;
  /// Whether there are holes, all of them small.
  bool nearlyClosed() const;
};

/// Changes nothing. Winding should be consistent, indices within range, coordinates finite. Costs a search for
/// self-intersections when there is a hole to fill.
Holes findHoles(const TriangleMesh& mesh, const EdgeUses& edges, const Progress& progress = {});

/// Fills what `findHoles` found fillable, sews cracks up; no vertex is added or moved. Returns how many holes.
std::size_t fillHoles(TriangleMesh& mesh, const Holes& holes);

}  // namespace palpate::mesh

// Area-weighted normals of a deformed surface from its triangles, in two ways: per vertex from all of its triangles
// (the reference that the analytic ones are held against), or through the list of triangles that changed.
//
// Last step of an apply, for Normals::recomputed and Normals::incremental.
// Based on: Ji, dissertation 2008, section 4.5, last page ("a changed triangle list is created dynamically").
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "palpate/deform/skin.h"

namespace palpate::deform {

struct PositionStreams {
  const float* x;
  const float* y;
  const float* z;
  Vec3 at(Index v) const { return {x[v], y[v], z[v]}; }
};

/// The sum of the area vectors of the vertex's triangles, normalised; zero where it has none. The same positions give
/// the same bits, at rest and deformed: a surface that came back has its rest normals.
Vec3f areaWeightedNormal(const Skin& skin, const PositionStreams& positions, Index vertex) noexcept;

/// Each vertex keeps the sum of the area vectors of its triangles. When vertices have moved, only their triangles are
/// computed again: the old area vector is subtracted at the three corners and the new one added. The sums are kept in
/// fixed point: adding and subtracting integers is exact, so that nothing drifts however long it runs, and a surface
/// that has come back has its rest normals bit by bit. Between two frames of a slow hand most triangles stay as they
/// are; where everything in a region moves in every frame, recomputing per vertex costs about the same.
class IncrementalNormals {
 public:
  /// The skin at rest. `most_mm` bounds how far any vertex will ever move; farther is safe but loses accuracy.
  IncrementalNormals(const Skin& skin, double most_mm);

  /// Sets where a vertex is now; its triangles are listed as changed if it moved at all.
  void place(const Skin& skin, Index vertex, const Vec3f& position) noexcept;
  /// Updates the sums. Returns how many triangles had changed.
  Index update(const Skin& skin) noexcept;
  /// Both for every vertex that moves now or moved at the last call: those of the blocks `moved` are where `positions`
  /// says, all others at rest.
  Index follow(const Skin& skin, const PositionStreams& positions, const BlockSet& moved) noexcept;
  /// The area-weighted unit normal at the last update; at rest the skin's own, bit by bit. Zero without triangles.
  Vec3f normal(const Skin& skin, Index vertex) const noexcept;

 private:
  /// An area vector (twice the area) in units of 1 / scale_ mm^2.
  using Fixed = std::array<std::int64_t, 3>;
  Fixed areaOf(const Triangle& triangle) const noexcept;

  double scale_ = 1.0;
  double largest_ = 0.0;  // largest component of one triangle, in fixed units: sums cannot overflow
  std::vector<Vec3f> positions_;
  std::vector<Fixed> areas_;      // one per triangle
  std::vector<Fixed> sums_;       // one per vertex
  std::vector<Fixed> rest_sums_;  // likewise
  std::vector<Index> changed_;
  std::vector<std::uint64_t> is_listed_;  // one bit a triangle
  BlockSet followed_;                     // moved at the last call of follow
};

}  // namespace palpate::deform

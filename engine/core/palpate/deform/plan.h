// Facts about the contacts of an apply, computed before it moves a vertex.
//
// The value that Deformer's steps hand on: each step reads what the steps before have filled in and fills in its own
// part. The memory stays from apply to apply, nothing else does.
#pragma once

#include <span>

#include "palpate/base/vec.h"
#include "palpate/deform/forms.h"
#include "palpate/deform/shear_limit.h"
#include "palpate/deform/skin.h"

namespace palpate::deform {

// Several fingers on one skin: amplitudes for which each finger gets its requested displacement.
//
// Displacements of several contacts add up, so a finger in the other's dent would sink too deep. The amplitudes sought
// are those with sum_j coupling_ij amplitude_j = depth_i; a contact that the others press deeper than it wants drops
// out with amplitude 0 (E25: the dissertation uses two devices but never says how they combine). Solved by projected
// Gauss-Seidel sweeps: always bounded, and exact for the few fingers there are. Based on: the linear complementarity
// view of contact, Cottle, Pang, Stone, "The linear complementarity problem", 1992.

/// Motion of contact i's anchor by contact j per unit of its own amplitude: row i, column j; 1 on the diagonal.
class Coupling {
 public:
  Coupling(std::span<const double> values, std::size_t contacts) : values_(values), contacts_(contacts) {}
  double operator()(std::size_t i, std::size_t j) const { return values_[i * contacts_ + j]; }
  std::size_t size() const { return contacts_; }

 private:
  std::span<const double> values_;
  std::size_t contacts_;
};

/// Amplitudes >= 0. Each contact ends as deep as requested, or deeper with amplitude 0. Two contacts nearer than about
/// a hundredth of their radius may be left up to 0.01 mm short. A negative depth (as printed, E19) is its own
/// amplitude; the others do not feel it.
void solveDepths(const Coupling& coupling, std::span<const double> depths_mm, std::span<double> amplitudes_mm) noexcept;

/// The same for drags: shift vectors, none longer than the cap or the longest drag. Without the latter two fingers that
/// pull nearly the same skin apart would get large opposite shifts, and the skin around them would move and shear more
/// than any finger pulls; with it they get as much of their way as drags of that length can give.
void solveDrags(const Coupling& coupling, std::span<const Vec3> drags_mm, double cap_mm,
                std::span<Vec3> shifts_mm) noexcept;

/// A contact's region in one block; the entries of a block form a chain.
struct BlockEntry {
  std::uint64_t region;
  Index contact;
  Index next;
  bool is_level;  ///< as in BlockPart
};

/// Vectors have one entry per contact unless stated otherwise.
template <class Displacement>
struct Plan {
  using Frame = typename Displacement::Frame;
  using Mover = typename Displacement::Mover;

  Plan(const Skin& skin, std::size_t most_contacts);

  /// The entries of a block, from the last contact to the first.
  template <class Visit>
  void forEachOnBlock(Index block, const Visit& visit) const {
    for (Index e = first_entry[block]; e != kNoIndex; e = entries[e].next) visit(entries[e]);
  }

  float* areaOf(Index block) { return area.data() + std::size_t{block} * kBlockVertices; }
  const float* areaOf(Index block) const { return area.data() + std::size_t{block} * kBlockVertices; }

  // 1. The contacts that want to move something.
  std::vector<Frame> frames;
  // 2. Their regions, contact after contact, and what contact j moves the anchor of contact i by (i n + j).
  std::vector<BlockPart> parts;
  std::vector<Index> first_part;  ///< contacts + 1 entries
  std::vector<BlockPart> edges;   ///< where the regions end within their ellipses (Pull::edges)
  std::vector<Index> first_edge;  ///< contacts + 1 entries
  std::vector<double> press_coupling;
  std::vector<double> drag_coupling;
  // 3. Displacement wanted at each anchor, and motion of the centre that gives it.
  std::vector<double> depths_mm;
  std::vector<Vec3> drags_mm;
  std::vector<double> amplitudes_mm;
  std::vector<Vec3> shifts_mm;
  std::vector<Mover> movers;
  // 4. The regions once more, block by block.
  std::vector<BlockEntry> entries;
  std::vector<Index> first_entry;        ///< a block of `moved` each
  std::vector<OnBlock<Mover>> on_block;  ///< room for the movers of one block
  BlockSet moved;                        ///< blocks with vertices of a region
  AlignedVector<float> area;             ///< areas of those, DeformedBlock::area; room for every block
  std::vector<BlockPart> doubtful;       ///< part of `moved`, where triangles may fold: the vertices at which they may
  std::vector<Pull> pulls;               ///< the contacts that move something
  BlockSet affected;  ///< these, and where normals or strain come from neighbours the adjacent blocks
};

template <class Displacement>
Plan<Displacement>::Plan(const Skin& skin, std::size_t n)
    : press_coupling(n * n),
      drag_coupling(n * n),
      depths_mm(n),
      drags_mm(n, Vec3::Zero()),
      amplitudes_mm(n),
      shifts_mm(n, Vec3::Zero()),
      first_entry(skin.blocks, kNoIndex),
      moved(skin.blocks),
      area(std::size_t{skin.blocks} * kBlockVertices),
      affected(skin.blocks) {
  frames.reserve(n);
  parts.reserve(n * skin.blocks);
  first_part.reserve(n + 1);
  edges.reserve(n * skin.blocks);
  doubtful.reserve(skin.blocks);
  first_edge.reserve(n + 1);
  pulls.reserve(n);
  movers.reserve(n);
  entries.reserve(n * skin.blocks);
  on_block.reserve(n);
}

}  // namespace palpate::deform

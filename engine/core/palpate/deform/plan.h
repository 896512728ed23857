// Facts about the contacts of an apply, computed before it moves a vertex.
//
// The value that Deformer's steps hand on: each step reads what the steps before have filled in and fills in its own
// part. The memory stays from apply to apply, nothing else does.
#pragma once

#include "palpate/base/vec.h"
#include "palpate/deform/shear_limit.h"
#include "palpate/deform/skin.h"

namespace palpate::deform {

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

  /// For `n` contacts at most.
  Plan(const Skin& skin, std::size_t n)
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

}  // namespace palpate::deform

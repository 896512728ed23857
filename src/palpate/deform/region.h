// Which vertices belong to a contact: the search that keeps the far side of the body, the other leg and the arm out.
//
// The region of a contact is the set of vertices that lie in one of its ellipses (seen along the contact's normal),
// face the contact, and can be reached from the anchor's triangle along edges through such vertices; the three corners
// of that triangle always count as reached (E23: an ellipse smaller than a triangle must not end the search). The
// search is a flood over blocks of 64 vertices with one bit a vertex: it gives exactly that set and looks at no block
// that it does not touch. Based on: Ji, dissertation 2008, section 4.5 (rings of neighbour nodes), with E23.
#pragma once

#include <span>

#include "palpate/deform/kernels.h"
#include "palpate/deform/skin.h"

namespace palpate::deform {

/// A block and which of its vertices are meant.
struct BlockPart {
  Index block;
  std::uint64_t vertices;
};

/// The search and its working memory.
class RegionSearch {
 public:
  explicit RegionSearch(const Skin& skin);

  /// The region around `anchor_triangle` in the order of discovery. Valid until the next call. No allocation.
  std::span<const BlockPart> find(const Skin& skin, const ContactLanes& contact,
                                  const Triangle& anchor_triangle) noexcept;

  /// True if the last search reached this vertex.
  bool reached(Index vertex) const noexcept;
  /// Blocks that the last search looked at.
  Index visitedBlocks() const noexcept { return static_cast<Index>(visited_.size()); }

 private:
  /// What is known of a block. Half a cache line: the search lives on these.
  struct Block {
    std::uint64_t outside = 0;  // known not to belong; nothing is known before the block is looked at
    std::uint64_t reached = 0;
    std::uint64_t pending = 0;  // seeds since the block was last taken from the queue; not 0 means it waits there
    bool looked_at = false;
    std::uint64_t missing() const { return ~(outside | reached | pending); }
  };
  void seed(Index block, std::uint64_t fresh) noexcept;
  void seedVertex(Index vertex) noexcept;
  std::uint64_t grow(const Skin& skin, const ContactLanes& contact, Index block) noexcept;
  void spread(const Skin& skin, Index block, std::uint64_t from) noexcept;
  void forget() noexcept;

  std::vector<Block> blocks_;
  std::vector<Index> ring_;  // the queue: a ring with room for every block, its size a power of two
  std::size_t head_ = 0;
  std::size_t tail_ = 0;
  std::vector<Index> visited_;  // blocks that hold something
  std::vector<BlockPart> found_;
};

}  // namespace palpate::deform

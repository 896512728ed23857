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

/// Working memory of the search. The arrays are never cleared: a block's entries count only if its epoch is this one.
class RegionSearch {
 public:
  explicit RegionSearch(const Skin& skin);

  /// The region around `anchor_triangle` in the order of discovery. Valid until the next call. No allocation.
  std::span<const BlockPart> find(const Skin& skin, const ContactLanes& contact,
                                  const Triangle& anchor_triangle) noexcept;

  /// True if the last search reached this vertex.
  bool reached(Index vertex) const noexcept;
  /// Blocks that the last search looked at.
  Index visitedBlocks() const noexcept { return visited_; }

 private:
  struct Block {
    std::uint32_t epoch = 0;
    bool queued = false;
    std::uint64_t inside = 0;   // passes the test of the contact
    std::uint64_t reached = 0;  // inside, and connected to the anchor
    std::uint64_t pending = 0;  // reached, but not yet spread from
    std::uint64_t missing() const { return inside & ~reached & ~pending; }
  };
  const Block& visit(const Skin& skin, const ContactLanes& contact, Index block) noexcept {
    if (blocks_[block].epoch != epoch_) look(skin, contact, block);
    return blocks_[block];
  }
  void look(const Skin& skin, const ContactLanes& contact, Index block) noexcept;
  void enqueue(Index block, std::uint64_t fresh) noexcept;
  void seed(const Skin& skin, const ContactLanes& contact, Index block, std::uint64_t vertices) noexcept;
  void seedNeighbours(const Skin& skin, const ContactLanes& contact, Index vertex) noexcept;
  void spread(const Skin& skin, const ContactLanes& contact, Index block, std::uint64_t from) noexcept;
  void nextEpoch() noexcept;

  std::vector<Block> blocks_;
  std::vector<Index> queue_;
  std::vector<Index> touched_;  // blocks with reached vertices
  std::vector<BlockPart> found_;
  std::uint32_t epoch_ = 0;
  Index visited_ = 0;
};

}  // namespace palpate::deform

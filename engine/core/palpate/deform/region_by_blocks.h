// Finds the vertices of a contact by whole blocks: the search that keeps the far side of the body, the other leg and
// the arm out. Second step of an apply, for ellipses; regions of any shape are found in region_by_rings.h.
//
// The region of a contact is the set of vertices that lie in one of its ellipses (seen along the contact's normal, and
// not too far above or below its plane: kernels.h), face the contact, and can be reached from the anchor's triangle
// along edges through such vertices; the three corners of that triangle always count as reached (E23: an ellipse
// smaller than a triangle must not end the search).
//
// The search gives exactly that set, and decides most of it without looking at a vertex. Boxes show which blocks of a
// tile lie inside as a whole; those are flooded by words of blocks. The others at the rim are flooded by words of
// vertices, and only these have their vertices tested. Nothing is looked at that the flood does not touch.
// Based on: Ji, dissertation 2008, section 4.5 (rings of neighbour nodes), with E23.
#pragma once

#include <span>

#include "palpate/deform/kernels/kernels.h"
#include "palpate/deform/skin.h"

namespace palpate::deform {

/// The search and its working memory.
class RegionByBlocks {
 public:
  explicit RegionByBlocks(const Skin& skin);

  /// The region around `anchor_triangle`, in no particular order. Valid until the next call. No allocation.
  std::span<const BlockPart> find(const Skin& skin, const ContactLanes& contact,
                                  const Triangle& anchor_triangle) noexcept;

  /// Where the region has an edge or a wall: vertices in it that are steep (kernels.h), and vertices next to it that
  /// lie in an ellipse and stay because they face away; some more of that kind. Valid until the next call of find.
  std::span<const BlockPart> edges() const noexcept { return edges_; }
  /// True if the last search reached this vertex.
  bool reached(Index vertex) const noexcept;
  /// Blocks that the last search reached as a whole or looked into.
  Index visitedBlocks() const noexcept { return visited_blocks_; }

 private:
  /// A tile, by bits of its blocks. A block is `whole` if it lies inside and is connected: one vertex of it reached is
  /// all reached. It is at the `rim` if nothing is known of it as a whole. Any other lies outside.
  struct Tile {
    std::uint64_t whole = 0;
    std::uint64_t rim = 0;
    std::uint64_t level = 0;    // where the height over the contact's plane does not matter
    std::uint64_t facing = 0;   // where every vertex faces the contact
    std::uint64_t reached = 0;  // part of `whole`
    std::uint64_t pending = 0;  // part of `whole`, about to be reached; not 0 means the tile waits in open_tiles_
    bool known = false;
  };
  /// A block at the rim, by bits of its vertices. Half a cache line: the search lives on these.
  struct RimBlock {
    std::uint64_t outside = 0;  // known not to belong; nothing is known before the block is looked into
    std::uint64_t reached = 0;
    std::uint64_t pending = 0;  // joined to reached vertices of other blocks
    bool looked_into = false;
    bool waits = false;  // in the queue
    std::uint64_t missing() const { return ~(outside | reached | pending); }
  };

  /// One search: what find was called with.
  struct Query {
    const Skin& skin;
    const ContactLanes& contact;
  };
  Tile& tileAt(const Query& query, Index tile) noexcept;
  void seedVertex(const Query& query, Index vertex) noexcept;
  void seedWhole(Index tile, std::uint64_t blocks) noexcept;
  void wake(Index rim_block) noexcept;
  void wakeRim(Index tile, std::uint64_t blocks) noexcept;
  void growTile(const Query& query, Index tile) noexcept;
  void growBlock(const Query& query, Index block) noexcept;
  void lookInto(const Query& query, Index block) noexcept;
  std::uint64_t besideWholeBlocks(const Query& query, Index block) const noexcept;
  void spread(const Query& query, Index block, std::uint64_t from) noexcept;
  void listFound(const Skin& skin) noexcept;
  void forget() noexcept;

  std::vector<Tile> tiles_;
  std::vector<RimBlock> rim_;  // per block
  std::vector<Index> known_tiles_;
  std::vector<Index> open_tiles_;
  std::vector<Index> looked_into_;
  std::vector<Index> queue_;  // blocks at the rim: a ring with room for every block, its size a power of two
  std::size_t head_ = 0;
  std::size_t tail_ = 0;
  std::vector<BlockPart> found_;
  std::vector<BlockPart> edges_;
  Index visited_blocks_ = 0;
};

}  // namespace palpate::deform

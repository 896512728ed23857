// The flood: tiles of whole blocks as long as there are any, then a block at the rim, whose vertices may wake more.
//
// Data flow: ContactLanes -> find -> blocks and their vertices -> plan (plan.h). Boxes and vertices are tested by
// kernels.cpp, words are flooded by group_graph.cpp.
// Based on: Ji, dissertation 2008, section 4.5, with E23; the flood by words is not in it.
#include "palpate/deform/region_by_blocks.h"

namespace palpate::deform {

RegionByBlocks::RegionByBlocks(const Skin& skin)
    : tiles_(skin.block_graph.groups), rim_(skin.blocks), queue_(std::bit_ceil(std::size_t{skin.blocks} + 1)) {
  known_tiles_.reserve(tiles_.size());
  open_tiles_.reserve(tiles_.size());
  looked_into_.reserve(skin.blocks);
  found_.reserve(skin.blocks);
  edges_.reserve(skin.blocks);
}

std::span<const BlockPart> RegionByBlocks::find(const Skin& skin, const ContactLanes& contact,
                                                const Triangle& anchor_triangle) noexcept {
  const Query query{skin, contact};
  forget();
  for (const Index corner : anchor_triangle) {
    seedVertex(query, corner);
    for (const Index neighbour : skin.neighbours[corner]) seedVertex(query, neighbour);
  }
  // Whole blocks first: a block at the rim then has most of its seeds when its turn comes.
  while (!open_tiles_.empty() || head_ != tail_) {
    if (!open_tiles_.empty()) {
      const Index tile = open_tiles_.back();
      open_tiles_.pop_back();
      growTile(query, tile);
    } else {
      growBlock(query, queue_[head_++ & (queue_.size() - 1)]);
    }
  }
  listFound(skin);
  return found_;
}

bool RegionByBlocks::reached(Index vertex) const noexcept {
  const Index block = blockOf(vertex);
  return (tiles_[blockOf(block)].reached & bitOf(block)) != 0 || (rim_[block].reached & bitOf(vertex)) != 0;
}

/// The tile, its blocks distinguished on the first call.
RegionByBlocks::Tile& RegionByBlocks::tileAt(const Query& query, Index tile) noexcept {
  Tile& here = tiles_[tile];
  if (here.known) return here;
  const BlocksInside blocks = insideBlocks(query.contact, query.skin.tileBounds(tile));
  here.whole = blocks.whole & query.skin.connected_blocks[tile];
  here.rim = blocks.touched & query.skin.block_graph.members[tile] & ~here.whole;
  here.level = blocks.level;
  here.facing = blocks.facing;
  here.known = true;
  known_tiles_.push_back(tile);
  return here;
}

void RegionByBlocks::seedVertex(const Query& query, Index vertex) noexcept {
  const Index block = blockOf(vertex);
  const Tile& tile = tileAt(query, blockOf(block));
  if ((tile.whole & bitOf(block)) != 0) {
    seedWhole(blockOf(block), bitOf(block));
  } else if ((tile.rim & bitOf(block)) != 0) {
    rim_[block].pending |= bitOf(vertex);
    wake(block);
  }
}

/// Some blocks of the tile that lie inside as a whole.
void RegionByBlocks::seedWhole(Index tile, std::uint64_t blocks) noexcept {
  Tile& here = tiles_[tile];
  const std::uint64_t fresh = blocks & ~here.reached;
  if (fresh == 0) return;
  if (here.pending == 0) open_tiles_.push_back(tile);
  here.pending |= fresh;
}

void RegionByBlocks::wake(Index rim_block) noexcept {
  if (rim_[rim_block].waits) return;
  rim_[rim_block].waits = true;
  queue_[tail_++ & (queue_.size() - 1)] = rim_block;
}

void RegionByBlocks::wakeRim(Index tile, std::uint64_t blocks) noexcept {
  forEachBit(blocks & tiles_[tile].rim, [&](Index bit) { wake(tile * kTileBlocks + bit); });
}

/// Reaches the pending whole blocks of a tile and those connected to them; adjacent ones at the rim must look for them
/// (besideWholeBlocks).
void RegionByBlocks::growTile(const Query& query, Index tile) noexcept {
  Tile& here = tiles_[tile];
  const GroupGraph& graph = query.skin.block_graph;
  const std::uint64_t grown = grownWithin(graph, tile, here.pending, here.whole & ~here.reached);
  here.pending = 0;
  here.reached |= grown;
  const std::uint64_t* neighbours = graph.neighbours.data() + std::size_t{tile} * kTileBlocks;
  forEachBit(here.rim, [&](Index bit) {
    if ((neighbours[bit] & grown) != 0) wake(tile * kTileBlocks + bit);
  });
  for (const GroupLink& link : graph.linksOf(tile)) {
    const std::uint64_t across = acrossLink(graph, link, grown);
    if (across == 0) continue;
    const Tile& other = tileAt(query, link.group);
    seedWhole(link.group, across & other.whole);
    wakeRim(link.group, across);
  }
}

/// Reaches vertices connected to the seeds of a block at the rim, and seeds adjacent blocks.
void RegionByBlocks::growBlock(const Query& query, Index block) noexcept {
  RimBlock& here = rim_[block];
  here.waits = false;
  if (!here.looked_into) lookInto(query, block);
  const std::uint64_t allowed = ~(here.outside | here.reached);
  const std::uint64_t start = (here.pending | besideWholeBlocks(query, block)) & allowed;
  here.pending = 0;
  if (start == 0) return;
  const std::uint64_t grown = grownWithin(query.skin.vertex_graph, block, start, allowed);
  here.reached |= grown;
  spread(query, block, grown);
}

void RegionByBlocks::lookInto(const Query& query, Index block) noexcept {
  RimBlock& here = rim_[block];
  const Tile& tile = tiles_[blockOf(block)];
  const BlockSeen seen{(tile.level & bitOf(block)) != 0, (tile.facing & bitOf(block)) != 0};
  const VerticesInside inside = verticesInside(query.contact, query.skin.restBlock(block), seen);
  const std::uint64_t members = query.skin.vertex_graph.members[block];
  here.outside = ~(inside.facing & members);
  if ((inside.steep & members) != 0) edges_.push_back({block, false, inside.steep & members});
  here.looked_into = true;
  looked_into_.push_back(block);
}

/// The vertices of a block that are joined to a block reached as a whole.
std::uint64_t RegionByBlocks::besideWholeBlocks(const Query& query, Index block) const noexcept {
  std::uint64_t beside = 0;
  for (const GroupLink& link : query.skin.linksOf(block)) {
    const bool is_reached = (tiles_[blockOf(link.group)].reached & bitOf(link.group)) != 0;
    beside |= is_reached ? link.from : 0;
  }
  return beside;
}

void RegionByBlocks::spread(const Query& query, Index block, std::uint64_t from) noexcept {
  for (const GroupLink& link : query.skin.linksOf(block)) {
    if ((from & link.from) == 0) continue;
    const Tile& tile = tileAt(query, blockOf(link.group));
    const std::uint64_t bit = bitOf(link.group);
    if ((tile.whole & bit) != 0) {
      seedWhole(blockOf(link.group), bit);
    } else if ((tile.rim & bit) != 0) {
      RimBlock& other = rim_[link.group];
      if ((link.to & other.missing()) == 0) continue;
      const std::uint64_t fresh = acrossLink(query.skin.vertex_graph, link, from) & other.missing();
      if (fresh == 0) continue;
      other.pending |= fresh;
      wake(link.group);
    }
  }
}

void RegionByBlocks::listFound(const Skin& skin) noexcept {
  for (const Index tile : known_tiles_) {
    forEachBit(tiles_[tile].reached, [&](Index bit) {
      const Index block = tile * kTileBlocks + bit;
      found_.push_back({block, true, skin.vertex_graph.members[block]});
    });
  }
  visited_blocks_ = static_cast<Index>(found_.size() + looked_into_.size());
  for (const Index block : looked_into_) {
    if (rim_[block].reached == 0) continue;
    const bool is_level = (tiles_[blockOf(block)].level & bitOf(block)) != 0;
    found_.push_back({block, is_level, rim_[block].reached});
  }
}

void RegionByBlocks::forget() noexcept {
  for (const Index tile : known_tiles_) tiles_[tile] = {};
  for (const Index block : looked_into_) rim_[block] = {};
  known_tiles_.clear();
  looked_into_.clear();
  found_.clear();
  edges_.clear();
  head_ = tail_ = 0;
}

}  // namespace palpate::deform

#include "palpate/deform/region.h"

namespace palpate::deform {

namespace {

/// The vertices of `allowed` that hang together with `start` within the block. In a block that lies inside as a whole,
/// and those are most, the components are known.
std::uint64_t reachable(const Skin& skin, Index block, std::uint64_t start, std::uint64_t allowed) noexcept {
  if (allowed != skin.block_vertices[block]) {
    return grownWithin(skin.neighbours_in_block.data() + std::size_t{block} * kBlockVertices, start, allowed);
  }
  std::uint64_t grown = 0;
  for (const std::uint64_t component : skin.componentsOf(block)) grown |= (component & start) != 0 ? component : 0;
  return grown;
}

/// The vertices of the linked block that have an edge to one of `from`.
std::uint64_t acrossLink(const Skin& skin, const BlockLink& link, std::uint64_t from) noexcept {
  if ((from & link.from) == link.from) return link.to;
  if ((from & link.from) == 0) return 0;
  std::uint64_t to = 0;
  for (Index e = link.first_edge; e < link.end_edge; ++e) {
    const CrossEdge edge = skin.cross_edges[e];
    to |= (from >> edge.from & 1) << edge.to;
  }
  return to;
}

}  // namespace

RegionSearch::RegionSearch(const Skin& skin)
    : blocks_(skin.blocks), ring_(std::bit_ceil(std::size_t{skin.blocks} + 1)) {
  visited_.reserve(skin.blocks);
  found_.reserve(skin.blocks);
}

std::span<const BlockPart> RegionSearch::find(const Skin& skin, const ContactLanes& contact,
                                              const Triangle& anchor_triangle) noexcept {
  forget();
  for (const Index corner : anchor_triangle) {
    seedVertex(corner);
    for (const Index neighbour : skin.neighbours[corner]) seedVertex(neighbour);
  }
  while (head_ != tail_) {
    const Index block = ring_[head_++ & (ring_.size() - 1)];
    if (grow(skin, contact, block) != 0) spread(skin, block, blocks_[block].reached);
  }
  for (const Index block : visited_) {
    if (blocks_[block].reached != 0) found_.push_back({block, blocks_[block].reached});
  }
  return found_;
}

bool RegionSearch::reached(Index vertex) const noexcept {
  return (blocks_[blockOf(vertex)].reached & bitOf(vertex)) != 0;
}

/// Notes vertices that the block is missing and queues it. Runs eight times a block in no pattern that a branch
/// predictor could learn, hence without branches: the queue's next slot is written anyway and counts only if the tail
/// moves on.
inline void RegionSearch::seed(Index block, std::uint64_t fresh) noexcept {
  Block& here = blocks_[block];
  ring_[tail_ & (ring_.size() - 1)] = block;
  tail_ += static_cast<std::size_t>((fresh != 0) & (here.pending == 0));
  here.pending |= fresh;
}

void RegionSearch::seedVertex(Index vertex) noexcept {
  seed(blockOf(vertex), bitOf(vertex) & blocks_[blockOf(vertex)].missing());
}

/// Takes the block's seeds and adds what they reach within it; returns what is new.
std::uint64_t RegionSearch::grow(const Skin& skin, const ContactLanes& contact, Index block) noexcept {
  Block& here = blocks_[block];
  if (!here.looked_at) {
    here.outside = ~(insideMask(contact, skin.restBlock(block)) & skin.block_vertices[block]);
    here.looked_at = true;
    visited_.push_back(block);
  }
  const std::uint64_t start = here.pending & ~here.outside;
  here.pending = 0;
  if (start == 0) return 0;
  const std::uint64_t grown = reachable(skin, block, start, ~here.outside) & ~here.reached;
  here.reached |= grown;
  return grown;
}

void RegionSearch::spread(const Skin& skin, Index block, std::uint64_t from) noexcept {
  for (const BlockLink& link : skin.linksOf(block)) {
    const std::uint64_t missing = link.to & blocks_[link.block].missing();
    if (missing != 0) seed(link.block, acrossLink(skin, link, from) & missing);
  }
}

void RegionSearch::forget() noexcept {
  for (const Index block : visited_) blocks_[block] = {};
  visited_.clear();
  found_.clear();
  head_ = tail_ = 0;
}

}  // namespace palpate::deform

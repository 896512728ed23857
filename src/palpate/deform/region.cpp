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
  std::uint64_t to = 0;
  for (Index e = link.first_edge; e < link.end_edge; ++e) {
    const CrossEdge edge = skin.cross_edges[e];
    to |= (from >> edge.from & 1) << edge.to;
  }
  return to;
}

}  // namespace

RegionSearch::RegionSearch(const Skin& skin) : blocks_(skin.blocks) {
  queue_.reserve(skin.blocks);
  touched_.reserve(skin.blocks);
  found_.reserve(skin.blocks);
}

std::span<const BlockPart> RegionSearch::find(const Skin& skin, const ContactLanes& contact,
                                              const Triangle& anchor_triangle) noexcept {
  nextEpoch();
  for (const Index corner : anchor_triangle) {
    seed(skin, contact, blockOf(corner), bitOf(corner));
    seedNeighbours(skin, contact, corner);
  }
  while (!queue_.empty()) {
    const Index block = queue_.back();
    queue_.pop_back();
    Block& here = blocks_[block];
    here.queued = false;
    const std::uint64_t grown = reachable(skin, block, here.pending, here.inside) & ~here.reached;
    here.pending = 0;
    here.reached |= grown;
    spread(skin, contact, block, here.reached);
  }
  for (const Index block : touched_) found_.push_back({block, blocks_[block].reached});
  return found_;
}

bool RegionSearch::reached(Index vertex) const noexcept {
  const Block& block = blocks_[blockOf(vertex)];
  return block.epoch == epoch_ && (block.reached & bitOf(vertex)) != 0;
}

void RegionSearch::look(const Skin& skin, const ContactLanes& contact, Index block) noexcept {
  const std::uint64_t inside = insideMask(contact, skin.restBlock(block)) & skin.block_vertices[block];
  blocks_[block] = {epoch_, false, inside, 0, 0};
  ++visited_;
}

void RegionSearch::seed(const Skin& skin, const ContactLanes& contact, Index block, std::uint64_t vertices) noexcept {
  const std::uint64_t fresh = vertices & visit(skin, contact, block).missing();
  if (fresh != 0) enqueue(block, fresh);
}

void RegionSearch::enqueue(Index block, std::uint64_t fresh) noexcept {
  Block& here = blocks_[block];
  if (here.reached == 0 && here.pending == 0) touched_.push_back(block);
  here.pending |= fresh;
  if (here.queued) return;
  here.queued = true;
  queue_.push_back(block);
}

void RegionSearch::seedNeighbours(const Skin& skin, const ContactLanes& contact, Index vertex) noexcept {
  for (const Index w : skin.neighbours[vertex]) seed(skin, contact, blockOf(w), bitOf(w));
}

void RegionSearch::spread(const Skin& skin, const ContactLanes& contact, Index block, std::uint64_t from) noexcept {
  for (const BlockLink& link : skin.linksOf(block)) {
    if ((from & link.from) == 0) continue;
    const std::uint64_t missing = link.to & visit(skin, contact, link.block).missing();
    if (missing == 0) continue;
    const std::uint64_t fresh = acrossLink(skin, link, from) & missing;
    if (fresh != 0) enqueue(link.block, fresh);
  }
}

void RegionSearch::nextEpoch() noexcept {
  touched_.clear();
  found_.clear();
  visited_ = 0;
  if (++epoch_ != 0) return;
  for (Block& block : blocks_) block.epoch = 0;  // once in four billion searches the stamps start over
  epoch_ = 1;
}

}  // namespace palpate::deform

// Finds the vertices of a contact, ring by ring of neighbour nodes: for regions of any shape, and as printed. Second
// step of an apply, like region_by_blocks.cpp.
//
// The search of the dissertation's section 4.5 with the corrections of E23, which finds what RegionByBlocks finds; or
// its literal stopping rule: all neighbours of a whole ring make the next one, and the first ring without a vertex
// inside ends the search. O(vertices looked at). Based on: Ji, dissertation 2008, section 4.5.
#pragma once

#include <span>
#include <vector>

#include "palpate/deform/skin.h"

namespace palpate::deform {

/// Where a vertex lies.
enum class Place : std::uint8_t {
  outside,
  staying,  ///< in an ellipse, but it faces away
  inside,
  steep,  ///< inside, on a wall (kernels.h)
};

enum class RingRule : std::uint8_t {
  connected,  ///< only vertices of the region lead on; the anchor's corners always do
  printed,    ///< every vertex of a ring leads on, until a ring has none inside (E23)
};

/// The search and its working memory.
class RegionByRings {
 public:
  explicit RegionByRings(const Skin& skin) : seen_(skin.blocks, 0), inside_(skin.blocks, 0), at_edge_(skin.blocks, 0) {
    order_.reserve(skin.vertices);
    found_.reserve(skin.blocks);
    edges_.reserve(skin.blocks);
  }

  /// The region around the anchor's triangle, where `placeOf(vertex)` decides which vertices lie in it. Blocks in the
  /// order of discovery; valid until the next call. No allocation.
  template <class PlaceOf>
  std::span<const BlockPart> find(const Skin& skin, const Triangle& anchor_triangle, RingRule rule,
                                  const PlaceOf& place_of) noexcept {
    forget();
    for (const Index corner : anchor_triangle) see(corner);
    std::size_t first = 0;
    for (bool corners = true; first < order_.size(); corners = false) {
      const std::size_t end = order_.size();
      const bool any = judge(first, end, place_of);
      if (rule == RingRule::printed && !any) break;
      for (std::size_t i = first; i < end; ++i) {
        const bool leads_on = corners || rule == RingRule::printed || reached(order_[i]);
        if (leads_on) seeNeighbours(skin, order_[i]);
      }
      first = end;
    }
    return finished();
  }

  /// The same among vertices that another search has listed, each once: however they are connected.
  template <class PlaceOf>
  std::span<const BlockPart> findAmong(std::span<const Index> vertices, const PlaceOf& place_of) noexcept {
    forget();
    for (const Index v : vertices) see(v);
    judge(0, order_.size(), place_of);
    return finished();
  }

  /// Vertices next to the region that lie in an ellipse and stay, and those in it that are steep. Valid until the next
  /// call of find.
  std::span<const BlockPart> edges() const noexcept { return edges_; }

  /// True if the last search found this vertex inside.
  bool reached(Index vertex) const noexcept { return isIn(vertex, inside_); }
  /// Vertices that the last search looked at.
  Index visited() const noexcept { return static_cast<Index>(order_.size()); }

 private:
  void see(Index vertex) noexcept {
    if (insertNew(vertex, seen_)) order_.push_back(vertex);
  }

  void seeNeighbours(const Skin& skin, Index vertex) noexcept {
    for (const Index neighbour : skin.neighbours[vertex]) see(neighbour);
  }

  template <class PlaceOf>
  bool judge(std::size_t first, std::size_t end, const PlaceOf& place_of) noexcept {
    bool any = false;
    for (std::size_t i = first; i < end; ++i) {
      const Place place = place_of(order_[i]);
      if (place == Place::outside) continue;
      if (place != Place::inside) note(order_[i], at_edge_, edges_);
      if (place == Place::staying) continue;
      note(order_[i], inside_, found_);
      any = true;
    }
    return any;
  }

  std::span<const BlockPart> finished() noexcept {
    for (BlockPart& part : found_) part.vertices = inside_[part.block];
    for (BlockPart& part : edges_) part.vertices = at_edge_[part.block];
    return found_;
  }

  static void note(Index vertex, std::vector<std::uint64_t>& words, std::vector<BlockPart>& parts) noexcept {
    std::uint64_t& word = words[blockOf(vertex)];
    if (word == 0) parts.push_back({blockOf(vertex), false, 0});
    word |= bitOf(vertex);
  }

  void forget() noexcept {
    for (const Index vertex : order_) seen_[blockOf(vertex)] = inside_[blockOf(vertex)] = at_edge_[blockOf(vertex)] = 0;
    order_.clear();
    found_.clear();
    edges_.clear();
  }

  std::vector<std::uint64_t> seen_;     // one bit a vertex
  std::vector<std::uint64_t> inside_;   // likewise
  std::vector<std::uint64_t> at_edge_;  // likewise
  std::vector<Index> order_;            // all that were seen, ring by ring
  std::vector<BlockPart> found_;
  std::vector<BlockPart> edges_;
};

}  // namespace palpate::deform

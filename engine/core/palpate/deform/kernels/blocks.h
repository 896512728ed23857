// Vertices in blocks of 64: one bit a vertex, one 64-bit word a block.
//
// The skin is worked on in blocks, so that the kernels run over whole vectors, the search for a region moves many
// vertices with one instruction, and what changed is named by a few ranges.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "palpate/base/aligned.h"
#include "palpate/base/vec.h"

namespace palpate::deform {

inline constexpr Index kBlockVertices = 64;
/// Blocks come in tiles of as many, so that the search moves many blocks with one instruction too.
inline constexpr Index kTileBlocks = 64;

inline constexpr Index blockOf(Index vertex) { return vertex / kBlockVertices; }
inline constexpr std::uint64_t bitOf(Index vertex) { return std::uint64_t{1} << (vertex % kBlockVertices); }
inline constexpr Index blocksFor(Index vertices) { return (vertices + kBlockVertices - 1) / kBlockVertices; }

/// Whether a thing is in a set of one bit a thing.
inline bool isIn(Index thing, const std::vector<std::uint64_t>& bits) {
  return (bits[blockOf(thing)] & bitOf(thing)) != 0;
}
/// Puts it there. True if it was not.
inline bool insertNew(Index thing, std::vector<std::uint64_t>& bits) {
  if (isIn(thing, bits)) return false;
  bits[blockOf(thing)] |= bitOf(thing);
  return true;
}

/// A block and which of its vertices are meant.
struct BlockPart {
  Index block;
  bool is_level;  ///< known to lie where the height over the contact's plane does not matter (kernels.h)
  std::uint64_t vertices;
};

/// A contact in the form of its way to displace, and which vertices of a block belong to its region.
template <class Mover>
struct OnBlock {
  const Mover* mover;
  std::uint64_t region;
  bool is_level = false;  ///< as in BlockPart
};

/// Rest positions and normals, x y z nx ny nz, at a block's first vertex.
struct RestBlock {
  const float* values[6];
  /// The block this many further on.
  RestBlock after(Index blocks) const {
    RestBlock block = *this;
    for (const float*& first : block.values) first += std::size_t{blocks} * kBlockVertices;
    return block;
  }
};

/// Skin where a region may have an edge.
struct EdgeBlock {
  RestBlock rest;
  const float* room_mm;  ///< for vertices joined to one that stays (roomBesideStaying)
  float longest_mm;      ///< edge at its vertices
};

/// Skin of which a triangle may fold.
struct FoldBlock {
  RestBlock rest;
  const float* gradient_mm;  ///< per vertex (Skin::fold_gradient_mm)
  const float* crease;       ///< likewise (Skin::fold_crease)
  const float* area;         ///< likewise (DeformedBlock::area)
};

/// The boxes of a tile's blocks (Skin::bounds) at its first block.
struct TileBounds {
  const float* values[12];
};

/// Deformed positions, normals and displacements, x y z nx ny nz dx dy dz, at a block's first vertex.
struct DeformedBlock {
  float* values[9];
  /// A number a vertex, if wanted: the share of the skin's area left by the displacement, as seen along its normal;
  /// below 0 the skin is folded there.
  float* area = nullptr;
  DeformedBlock after(Index blocks) const {
    DeformedBlock block = *this;
    for (float*& first : block.values) first += std::size_t{blocks} * kBlockVertices;
    if (block.area != nullptr) block.area += std::size_t{blocks} * kBlockVertices;
    return block;
  }
};

/// Calls `visit(bit index)` for every set bit, ascending.
template <class Visit>
void forEachBit(std::uint64_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<Index>(std::countr_zero(bits)));
}

/// A set of blocks as a bitmap: 4 million triangles need 4 KiB, so that clearing and walking it costs next to nothing.
class BlockSet {
 public:
  BlockSet() = default;
  explicit BlockSet(Index blocks) : words_(blocksFor(blocks), 0) {}

  void clear() { words_.assign(words_.size(), 0); }
  void insert(Index block) { words_[blockOf(block)] |= bitOf(block); }
  bool contains(Index block) const { return isIn(block, words_); }

  /// Visits the blocks of those tiles that `in_tile(tile)` is true of, ascending.
  template <class InTile, class Visit>
  void forEachIn(const InTile& in_tile, const Visit& visit) const {
    for (std::size_t w = 0; w < words_.size(); ++w) {
      const auto tile = static_cast<Index>(w);
      if (words_[w] != 0 && in_tile(tile)) forEachBit(words_[w], [&](Index bit) { visit(tile * kTileBlocks + bit); });
    }
  }

  /// Visits the blocks of both sets, ascending, each once.
  template <class Visit>
  static void forEachOfBoth(const BlockSet& a, const BlockSet& b, const Visit& visit) {
    for (std::size_t w = 0; w < a.words_.size(); ++w) {
      const Index base = static_cast<Index>(w) * kBlockVertices;
      forEachBit(a.words_[w] | b.words_[w], [&](Index bit) { visit(base + bit); });
    }
  }
  template <class Visit>
  void forEach(const Visit& visit) const {
    forEachOfBoth(*this, *this, visit);
  }

 private:
  std::vector<std::uint64_t> words_;
};

/// Several float arrays of one length in one allocation, each on a cache line and none on the same place of its page. A
/// kernel that walks fifteen arrays side by side stalls when they all start at the same offset of a 4 KiB page: loads
/// and stores then look as if they hit each other (4K aliasing). Array i starts 256 (first_phase + i) bytes further
/// into its page than the allocation does; large allocations start at the same place of a page.
class FloatStreams {
 public:
  FloatStreams() = default;
  FloatStreams(std::size_t count, std::size_t length, std::size_t first_phase)
      : stride_(paddedToPage(length) + kPhaseFloats), first_(first_phase * kPhaseFloats) {
    values_.assign(first_ + count * stride_, 0.0f);
  }

  float* operator[](std::size_t i) { return values_.data() + first_ + i * stride_; }
  const float* operator[](std::size_t i) const { return values_.data() + first_ + i * stride_; }

 private:
  static constexpr std::size_t kPageFloats = 1024;
  static constexpr std::size_t kPhaseFloats = 64;
  static std::size_t paddedToPage(std::size_t n) { return (n + kPageFloats - 1) / kPageFloats * kPageFloats; }

  AlignedVector<float> values_;
  std::size_t stride_ = 0;
  std::size_t first_ = 0;
};

}  // namespace palpate::deform

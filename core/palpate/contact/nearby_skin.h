// The skin near a few pads of a tool, laid out for vectors: one descent of the tree serves every pad for many ticks.
//
//   tree ─ gatherSkin (once in some ten ticks) ─► NearbySkin ─ listNearer (every pad, every tick) ─► a few triangles
//
// It only leaves out triangles that are surely too far away. Whatever is listed is asked exactly, in doubles, and in
// the order in which the tree would have come to it, so that an answer from here is the tree's answer to the last bit.
#pragma once

#include <array>
#include <cstdint>

#include "palpate/contact/surface.h"

namespace palpate::contact {

/// Triangles tested side by side.
inline constexpr int kSkinLanes = 8;

/// Eight triangles as floats, mm from NearbySkin::middle.
struct alignas(64) SkinBlock {
  float corners[3][3][kSkinLanes];  ///< by corner and axis
  float normal[3][kSkinLanes];      ///< unit; zero for a triangle without area: always listed
  std::array<Index, kSkinLanes> records;
  std::array<std::uint16_t, kSkinLanes> leaves;  ///< into NearbySkin::leaves
};

/// Where the tree keeps something: below which node that was passed, in which slot.
struct SkinBranch {
  std::uint32_t node = 0;    ///< of the tree; of a leaf: unused
  std::uint16_t parent = 0;  ///< into NearbySkin::nodes
  std::uint8_t slot = 0;     ///< of the parent's children
  std::uint8_t level = 0;    ///< of the root: 0
};

/// About 40 kB, made once and filled again and again. Plain data.
struct NearbySkin {
  static constexpr int kMaxBlocks = 64;
  static constexpr int kMaxLeaves = kMaxBlocks * kSkinLanes;
  static constexpr int kMaxNodes = 256;

  bool known = false;
  Vec3 middle = Vec3::Zero();
  double reach = 0.0;  ///< every triangle nearer to the middle than this is here, mm
  int blocks = 0;
  int triangles = 0;
  int leaf_count = 0;
  int node_count = 0;
  // Boxes of the blocks, mm from the middle, and what rounding may take from a distance to a block's triangles.
  alignas(64) float low[3][kMaxBlocks];
  alignas(64) float high[3][kMaxBlocks];
  alignas(64) float slack[kMaxBlocks];
  std::array<SkinBlock, kMaxBlocks> block;
  std::array<SkinBranch, kMaxLeaves> leaves;
  std::array<SkinBranch, kMaxNodes> nodes;
};

/// Fills it with what is nearer to `middle` than `reach`. False when that is too much: then nothing is known. About 15
/// ns a triangle.
bool gatherSkin(const tree::TriangleTree& tree, const Vec3& middle, double reach, NearbySkin& skin) noexcept;

/// Whether everything nearer to the point than `reach` is there.
inline bool covers(const NearbySkin& skin, const Vec3& point, double reach) noexcept {
  constexpr double kRounding = 1.0 - 1e-9;
  const double room = kRounding * skin.reach - reach;
  return skin.known && room > 0.0 && (point - skin.middle).squaredNorm() <= room * room;
}

/// Some triangles of a NearbySkin: lane l of block b is b * kSkinLanes + l.
struct SkinList {
  static constexpr int kMax = 64;
  std::array<std::uint16_t, kMax> places;
  int count = 0;
};

/// Lists every triangle nearer to the point than `reach`, and perhaps a few more. False when the answer is not known
/// here: ask the tree. `skin` may be null.
bool listNearer(const NearbySkin* skin, const Vec3& point, double reach, SkinList& list) noexcept;

inline Index recordAt(const NearbySkin& skin, std::uint16_t place) noexcept {
  return skin.block[place / kSkinLanes].records[place % kSkinLanes];
}

/// Whether a search for minima round the query's point (tree::visitNearMinima) comes to the one place before the other.
bool visitedBefore(const tree::TriangleTree& tree, const NearbySkin& skin, const tree::PointQuery& query,
                   std::uint16_t one, std::uint16_t other) noexcept;

/// tree::firstFrontCrossing. `skin` may be null.
tree::Crossing firstCrossing(const Surface& surface, const NearbySkin* skin, const Vec3& from, const Vec3& to) noexcept;

}  // namespace palpate::contact

// The skin near a sphere, or near a few pads of a tool, laid out for vectors: one descent of the tree serves many
// ticks.
//
//   geometry ─ planesOf (once) ─► SkinPlanes ─┐
//   tree ─ gatherSkin (once in some ten ticks) ─► NearbySkin ─ listNearer (every pad, every tick) ─► a few triangles
//
// It only leaves out triangles that are surely too far away. Whatever is listed is asked exactly, in doubles, and in
// the order in which the tree would have come to it, so that an answer from here is the tree's answer to the last bit.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "palpate/base/aligned.h"
#include "palpate/contact/surface.h"

namespace palpate::contact {

/// Triangles tested side by side.
inline constexpr int kSkinLanes = 8;

/// Eight triangles that follow each other in the tree, each as the plane of its face and three planes across it along
/// its edges: n . x = offset, n unit and of an edge outwards. As floats, mm from the middle of the eight. All zero for
/// a triangle without area: it is always listed.
struct alignas(kCacheLineBytes) SkinBlock {
  struct Plane {
    float normal[3][kSkinLanes];
    float offset[kSkinLanes];
  };
  Plane face;
  Plane edges[3];
  Vec3 middle;  ///< mm in the body's frame
  // Their box: across the first axis, which is how they face on the whole, it is open downwards. From the middle.
  std::array<Vec3, 3> axes;
  std::array<double, 3> centre;  ///< along each axis; of the first: the top
  std::array<double, 3> half;    ///< of the first: 0
  float slack;                   ///< what rounding may take from the distance of a point near the box
};

/// Covers a whole surface: 88 bytes per triangle. Immutable, shared by every tool on it.
struct SkinPlanes {
  std::shared_ptr<const SurfaceGeometry> geometry;  ///< never null
  AlignedVector<SkinBlock> blocks;                  ///< block b holds the records from b * kSkinLanes on
};

/// With more triangles, too many lie under a fingertip to be gathered.
inline constexpr std::size_t kMaxPlanes = 400'000;

/// About 50 ns a triangle.
std::shared_ptr<const SkinPlanes> planesOf(std::shared_ptr<const SurfaceGeometry> geometry);

/// Where the tree keeps something: in which slot of which node that was passed.
struct SkinBranch {
  std::uint32_t node = 0;    ///< of a node: its index in the tree; of a leaf: its first record
  std::uint16_t parent = 0;  ///< into NearbySkin::nodes
  std::uint8_t slot = 0;     ///< of the parent's children
  std::uint8_t level = 0;    ///< of the root: 0
};

/// About 17 kB, made once and filled again and again. Plain data.
struct NearbySkin {
  static constexpr int kMaxBlocks = 128;
  static constexpr int kMaxLeaves = 512;
  static constexpr int kMaxNodes = 256;

  const SkinPlanes* planes = nullptr;  ///< null: nothing is known
  Vec3 middle = Vec3::Zero();
  double reach = 0.0;  ///< every triangle nearer to the middle than this is in these blocks, mm
  int blocks = 0;
  int leaf_count = 0;
  int node_count = 0;
  // Boxes of the blocks as SkinBlock has them, mm from the middle.
  alignas(kCacheLineBytes) float axes[3][3][kMaxBlocks];  ///< by axis and coordinate
  alignas(kCacheLineBytes) float centre[3][kMaxBlocks];
  alignas(kCacheLineBytes) float half[3][kMaxBlocks];
  float slack = 0.0f;                           ///< what rounding may take from a distance to a box
  std::array<std::uint32_t, kMaxBlocks> block;  ///< into SkinPlanes::blocks
  std::array<SkinBranch, kMaxLeaves> leaves;    ///< in the order of their records
  std::array<SkinBranch, kMaxNodes> nodes;
};

/// Fills it with what is nearer to `middle` than `reach`. False when that is too much: then nothing is known. About 2
/// us.
bool gatherSkin(const SkinPlanes& planes, const Vec3& middle, double reach, NearbySkin& skin) noexcept;

// How much farther than it must the skin is gathered: a moving finger's margin lasts for some ticks.

/// The margin, mm, that makes gathering worth its while for so many pads that go so far in a tick.
double profitableMargin(std::size_t pads, double step_mm) noexcept;
/// Adapted to the skin that was met.
double adaptedMargin(const NearbySkin& gathered, double margin_mm) noexcept;
/// From where they are to the middle of what is gathered for pads that move so in a tick.
Vec3 gatheredAhead(const Vec3& motion, double margin_mm) noexcept;
/// After there was too much skin the tree is asked for so many ticks.
inline constexpr int kTicksOfRest = 64;

/// The nearby skin that a sphere keeps from tick to tick; never changes what it feels.
struct FingerSkin {
  NearbySkin skin;
  double margin_mm = 0.0;
  int rest_ticks = 0;
};

/// Whether everything nearer to the point than `reach` is there.
inline bool covers(const NearbySkin& skin, const Vec3& point, double reach) noexcept {
  constexpr double kRounding = 1.0 - 1e-9;
  const double room = kRounding * skin.reach - reach;
  return skin.planes != nullptr && room > 0.0 && (point - skin.middle).squaredNorm() <= room * room;
}

/// Some triangles, as records of the tree.
struct SkinList {
  static constexpr int kMax = 64;
  std::array<Index, kMax> records;
  int count = 0;
  std::span<const Index> all() const { return std::span(records).first(static_cast<std::size_t>(count)); }
};

/// Lists every triangle nearer to the point than `reach`, and perhaps a few more. False when the answer is not known
/// here: ask the tree. `skin` may be null.
bool listNearer(const NearbySkin* skin, const Vec3& point, double reach, SkinList& list) noexcept;

/// Whether a search for minima round the query's point (tree::visitNearMinima) comes to the record `one` before
/// `other`.
bool visitedBefore(const NearbySkin& skin, const tree::PointQuery& query, Index one, Index other) noexcept;

/// tree::firstFrontCrossing. `skin` may be null.
tree::Crossing firstCrossing(const Surface& surface, const NearbySkin* skin, const Vec3& from, const Vec3& to) noexcept;

}  // namespace palpate::contact

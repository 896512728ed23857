// One node of the triangle tree: the boxes of eight children side by side, tested together.
//
// Boxes are floats in the tree's own unit frame (triangle_tree.h), rounded outwards, and every test errs on the safe
// side: it may say "maybe" too often, it never misses a child. That keeps the exactness of the double predicates
// behind.
#pragma once

#include <array>
#include <cstdint>

namespace palpate::tree {

inline constexpr int kNodeWidth = 8;

/// Target of a node's slot: another node or a run of triangles, packed in 32 bits.
class ChildLink {
 public:
  static constexpr std::uint32_t kMaxTrianglesPerLeaf = 8;
  static constexpr std::uint32_t kMaxTriangles = 1u << 28;

  ChildLink() = default;
  static ChildLink toNode(std::uint32_t node) { return ChildLink(node); }
  /// 1 to kMaxTrianglesPerLeaf triangles, from the triangle `first` on.
  static ChildLink toLeaf(std::uint32_t first, std::uint32_t count) {
    return ChildLink(kLeafBit | ((count - 1) << 28) | first);
  }
  bool isLeaf() const { return (bits_ & kLeafBit) != 0; }
  std::uint32_t node() const { return bits_; }
  std::uint32_t firstTriangle() const { return bits_ & (kMaxTriangles - 1); }
  std::uint32_t triangleCount() const { return ((bits_ >> 28) & 7u) + 1; }

 private:
  static constexpr std::uint32_t kLeafBit = 1u << 31;
  explicit ChildLink(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_ = 0;
};

/// An unused slot has the box [+infinity, -infinity], which no query touches. 256 bytes, four cache lines.
///
/// Besides its box each child has a *plate*: the plane across its facing that it stays below, and how far the normals
/// of its surface turn away from that facing. A box is as thick as the surface in it is tilted, a plate only as the
/// surface in it is bent, so that on a smooth surface only near triangles are tested (node_plates.cpp).
struct alignas(64) WideNode {
  float low[3][kNodeWidth];
  float high[3][kNodeWidth];
  ChildLink children[kNodeWidth];
  std::int8_t facing[2][kNodeWidth];  ///< see facingVector
  std::int8_t top[kNodeWidth];        ///< top of the plate over the box's middle, in 127ths of half the box's diagonal
  std::uint8_t spread[kNodeWidth];    ///< sine of the widest angle from facing to a normal, in kSpreadStep
};

inline constexpr int kFacingLength = 127;
inline constexpr int kMaxTop = 127;
/// Rounded up; the widest spread that can be stored is 45 degrees.
inline constexpr float kSpreadStep = 0.70710678f / 254.0f;
/// No normal is excluded.
inline constexpr std::uint8_t kAnySpread = 255;

/// The direction that two bytes encode: a point of the octahedron |x| + |y| + |z| = kFacingLength, whose lower half is
/// folded over the corners of its upper half. Whole numbers, 73 to 127 long.
std::array<int, 3> facingVector(std::int8_t u, std::int8_t v) noexcept;

/// A point widened to the box of floats that holds it.
struct PointQuery {
  std::array<float, 3> low;
  std::array<float, 3> high;
  std::array<float, 3> middle;
  float slack;  ///< largest rounding error of one coordinate of `middle` and of differences with it
};

/// A segment as its middle, its half extents and its box, with the rounding of the separating-axis test as slack.
struct SegmentQuery {
  std::array<float, 3> low;
  std::array<float, 3> high;
  std::array<float, 3> middle;
  std::array<float, 3> half;  ///< signed half of (to - from)
  float slack;                ///< largest rounding error of one coordinate difference
};

/// Lower bounds of the squared distances to the eight boxes; +infinity for an unused slot.
void squaredDistanceBounds(const WideNode& node, const PointQuery& query, float* bounds) noexcept;

/// The same for places of the surface from which the point is straight above (or below): where a local minimum of the
/// distance may be. +infinity for a child none of whose normals points to the point.
void squaredDistanceBoundsOfMinima(const WideNode& node, const PointQuery& query, float* bounds) noexcept;

/// Bit i is set when the segment may touch box i.
std::uint32_t segmentMayTouch(const WideNode& node, const SegmentQuery& query) noexcept;

}  // namespace palpate::tree

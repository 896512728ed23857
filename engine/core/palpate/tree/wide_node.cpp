// Eight box tests at once, compiled for every vector instruction set and chosen at run time.
//
// Products and sums are written apart, never fused, so every instruction set gives the same bits (-ffp-contract=off).
//
// Based on: Wald, Benthin, Boulos, "Getting rid of packets" (2008) for the wide node; Ericson (2005), 5.3.3, for the
// segment-box separating axes.
#include "palpate/tree/wide_node.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "palpate/tree/wide_node.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace palpate::tree::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Takes back more than the few roundings (6e-8 each) of a squared distance.
constexpr float kRoundDown = 1.0f - 1e-6f;
/// Covers the roundings of the sums and products of one separating-axis test.
constexpr float kRoundUp = 1.0f + 1e-6f;
/// Relative rounding of a squared way and of its share along a facing.
constexpr float kWayRounding = 2e-6f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <class D>
HWY_INLINE hn::Vec<D> gap(D d, const WideNode& node, const PointQuery& query, int axis, int lane) {
  const auto below = hn::Sub(hn::Load(d, node.low[axis] + lane), hn::Set(d, query.high[axis]));
  const auto above = hn::Sub(hn::Set(d, query.low[axis]), hn::Load(d, node.high[axis] + lane));
  return hn::Max(hn::Max(below, above), hn::Zero(d));
}

template <class D>
struct Vector {
  hn::Vec<D> x, y, z;
};

template <class D>
HWY_INLINE hn::Vec<D> dot(const Vector<D>& a, const Vector<D>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

template <class D, class Byte>
HWY_INLINE hn::Vec<D> fromBytes(D d, const Byte* bytes) {
  const hn::Rebind<Byte, D> bytes_tag;
  const hn::RebindToSigned<D> wide_tag;
  return hn::ConvertTo(d, hn::PromoteTo(wide_tag, hn::LoadU(bytes_tag, bytes)));
}

/// The query's point as eight children see it.
template <class D>
struct Sight {
  Vector<D> facing;
  hn::Vec<D> facing2;  ///< its squared length
  Vector<D> way;       ///< from the middle of the box to the point
  hn::Vec<D> way2;
  hn::Vec<D> radius2;  ///< radius of the box round its middle
};

/// facingVector, eight at once.
template <class D>
HWY_INLINE Vector<D> facingVectors(D d, const WideNode& node, int lane) {
  const auto u = fromBytes(d, node.facing[0] + lane);
  const auto v = fromBytes(d, node.facing[1] + lane);
  const auto length = hn::Set(d, static_cast<float>(kFacingLength));
  const auto z = hn::Sub(hn::Sub(length, hn::Abs(u)), hn::Abs(v));
  const auto fold = hn::Max(hn::Neg(z), hn::Zero(d));
  return {hn::Sub(u, hn::CopySign(fold, u)), hn::Sub(v, hn::CopySign(fold, v)), z};
}

template <class D>
HWY_INLINE Sight<D> computeSight(D d, const WideNode& node, const PointQuery& query, int lane) {
  Sight<D> sight;
  sight.facing = facingVectors(d, node, lane);
  sight.facing2 = dot<D>(sight.facing, sight.facing);
  const auto one_half = hn::Set(d, 0.5f);
  const auto slack = hn::Set(d, query.slack);
  Vector<D> half;
  const auto along = [&](int axis, hn::Vec<D>& way, hn::Vec<D>& half_width) {
    const auto low = hn::Load(d, node.low[axis] + lane);
    const auto high = hn::Load(d, node.high[axis] + lane);
    way = hn::Sub(hn::Set(d, query.middle[axis]), hn::Mul(hn::Add(low, high), one_half));
    half_width = hn::Add(hn::Mul(hn::Sub(high, low), one_half), slack);
  };
  along(0, sight.way.x, half.x);
  along(1, sight.way.y, half.y);
  along(2, sight.way.z, half.z);
  sight.way2 = dot<D>(sight.way, sight.way);
  sight.radius2 = dot<D>(half, half);
  return sight;
}

/// Squared distance to the surface below the plate's plane and in the ball round the box: above the one, off the other.
template <class D>
HWY_INLINE hn::Vec<D> plateDistance2(D d, const WideNode& node, const PointQuery& query, int lane,
                                     const Sight<D>& sight) {
  const auto zero = hn::Zero(d);
  const auto radius = hn::Sqrt(sight.radius2);
  const auto height = dot<D>(sight.facing, sight.way);
  const auto top = hn::Mul(hn::Mul(fromBytes(d, node.top + lane), hn::Set(d, 1.0f / kMaxTop)),
                           hn::Mul(radius, hn::Sqrt(sight.facing2)));
  const auto height_rounding = hn::Set(d, kFacingLength * query.slack);
  const auto above = hn::Max(hn::Sub(hn::Sub(height, top), height_rounding), zero);

  const auto way_rounding = hn::Add(hn::Mul(sight.way2, hn::Set(d, kWayRounding)),
                                    hn::Mul(hn::Sqrt(sight.way2), hn::Set(d, 4.0f * query.slack)));
  const auto across2 = hn::Sub(hn::Sub(sight.way2, hn::Div(hn::Mul(height, height), sight.facing2)), way_rounding);
  const auto beside = hn::Max(hn::Sub(hn::Sqrt(hn::Max(across2, zero)), radius), zero);
  const auto distance2 = hn::Add(hn::Div(hn::Mul(above, above), sight.facing2), hn::Mul(beside, beside));
  return hn::IfThenZeroElse(hn::IsNaN(distance2), distance2);  // an unused slot
}

/// The larger of the distances to the box and to the plate.
template <class D>
HWY_INLINE hn::Vec<D> distanceBound(D d, const WideNode& node, const PointQuery& query, int lane,
                                    const Sight<D>& sight) {
  const Vector<D> gaps{gap(d, node, query, 0, lane), gap(d, node, query, 1, lane), gap(d, node, query, 2, lane)};
  const auto plate = plateDistance2(d, node, query, lane, sight);
  return hn::Mul(hn::Max(dot<D>(gaps, gaps), plate), hn::Set(d, kRoundDown));
}

/// Whether some normal of the child's surface may point to the query's point (or straight away from it, but from there
/// the surface is seen from behind).
///
/// Seen from the point, the child lies within an angle b round the direction to its box's middle, sin b = radius /
/// distance; its normals within an angle s of its facing. So the facing must lie within b + s of that direction:
/// facing . way >= distance cos(b + s) = cos s sqrt(distance^2 - radius^2) - radius sin s.
template <class D>
HWY_INLINE hn::Mask<D> mayFace(D d, const WideNode& node, const PointQuery& query, int lane, const Sight<D>& sight) {
  const auto zero = hn::Zero(d);
  const auto clear2 = hn::Sub(sight.way2, sight.radius2);
  const auto spread = fromBytes(d, node.spread + lane);
  const auto sine = hn::Mul(spread, hn::Set(d, kSpreadStep));
  const auto cosine = hn::Sqrt(hn::Max(hn::Sub(hn::Set(d, 1.0f), hn::Mul(sine, sine)), zero));
  const auto least = hn::Sub(hn::Mul(cosine, hn::Sqrt(hn::Max(clear2, zero))),
                             hn::Add(hn::Mul(sine, hn::Sqrt(sight.radius2)), hn::Set(d, 4.0f * query.slack)));
  const auto reached = hn::Ge(dot<D>(sight.facing, sight.way), hn::Mul(least, hn::Sqrt(sight.facing2)));
  const auto no_plate = hn::Ge(spread, hn::Set(d, static_cast<float>(kAnySpread)));
  return hn::Or(hn::Or(no_plate, hn::Le(clear2, zero)), reached);
}

void squaredDistanceBounds(const WideNode& node, const PointQuery& query, float* bounds) {
  const hn::CappedTag<float, kNodeWidth> d;
  for (int lane = 0; lane < kNodeWidth; lane += static_cast<int>(hn::Lanes(d))) {
    hn::StoreU(distanceBound(d, node, query, lane, computeSight(d, node, query, lane)), d, bounds + lane);
  }
}

void squaredDistanceBoundsOfMinima(const WideNode& node, const PointQuery& query, float* bounds) {
  const hn::CappedTag<float, kNodeWidth> d;
  for (int lane = 0; lane < kNodeWidth; lane += static_cast<int>(hn::Lanes(d))) {
    const auto sight = computeSight(d, node, query, lane);
    const auto bound = distanceBound(d, node, query, lane, sight);
    const auto may_face = mayFace(d, node, query, lane, sight);
    hn::StoreU(hn::IfThenElse(may_face, bound, hn::Set(d, kInfinity)), d, bounds + lane);
  }
}

/// Centre of the boxes relative to the segment's middle, and their half widths, along one axis.
template <class D>
struct Slab {
  hn::Vec<D> offset;
  hn::Vec<D> half;
};

template <class D>
HWY_INLINE Slab<D> loadSlab(D d, const WideNode& node, const SegmentQuery& query, int axis, int lane) {
  const auto low = hn::Load(d, node.low[axis] + lane);
  const auto high = hn::Load(d, node.high[axis] + lane);
  const auto one_half = hn::Set(d, 0.5f);
  const auto centre = hn::Mul(hn::Add(low, high), one_half);
  const auto half = hn::Add(hn::Mul(hn::Sub(high, low), one_half), hn::Set(d, query.slack));
  return {hn::Sub(hn::Set(d, query.middle[axis]), centre), half};
}

/// Whether the axis (box axis i) x (segment) does not separate; a and b are the two other box axes.
template <class D>
HWY_INLINE hn::Mask<D> notSeparated(D d, const Slab<D>& a, const Slab<D>& b, float half_a, float half_b) {
  const auto da = hn::Set(d, half_a);
  const auto db = hn::Set(d, half_b);
  const auto distance = hn::Abs(hn::Sub(hn::Mul(a.offset, db), hn::Mul(b.offset, da)));
  const auto reach = hn::Add(hn::Mul(a.half, hn::Abs(db)), hn::Mul(b.half, hn::Abs(da)));
  return hn::Le(distance, hn::Mul(reach, hn::Set(d, kRoundUp)));
}

template <class D>
HWY_INLINE hn::Mask<D> boxesOverlap(D d, const WideNode& node, const SegmentQuery& query, int axis, int lane) {
  const auto starts_before = hn::Le(hn::Load(d, node.low[axis] + lane), hn::Set(d, query.high[axis]));
  const auto ends_after = hn::Ge(hn::Load(d, node.high[axis] + lane), hn::Set(d, query.low[axis]));
  return hn::And(starts_before, ends_after);
}

std::uint32_t segmentMayTouch(const WideNode& node, const SegmentQuery& query) {
  const hn::CappedTag<float, kNodeWidth> d;
  std::uint32_t result = 0;
  for (int lane = 0; lane < kNodeWidth; lane += static_cast<int>(hn::Lanes(d))) {
    auto touch = hn::And(boxesOverlap(d, node, query, 0, lane),
                         hn::And(boxesOverlap(d, node, query, 1, lane), boxesOverlap(d, node, query, 2, lane)));
    const auto x = loadSlab(d, node, query, 0, lane);
    const auto y = loadSlab(d, node, query, 1, lane);
    const auto z = loadSlab(d, node, query, 2, lane);
    touch = hn::And(touch, notSeparated(d, y, z, query.half[1], query.half[2]));
    touch = hn::And(touch, notSeparated(d, z, x, query.half[2], query.half[0]));
    touch = hn::And(touch, notSeparated(d, x, y, query.half[0], query.half[1]));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, touch, bits);
    result |= static_cast<std::uint32_t>(bits[0]) << lane;
  }
  return result;
}

}  // namespace palpate::tree::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace palpate::tree {

std::array<int, 3> facingVector(std::int8_t u, std::int8_t v) noexcept {
  const int z = kFacingLength - std::abs(u) - std::abs(v);
  const int fold = std::max(-z, 0);
  return {u < 0 ? u + fold : u - fold, v < 0 ? v + fold : v - fold, z};
}

HWY_EXPORT(squaredDistanceBounds);
HWY_EXPORT(squaredDistanceBoundsOfMinima);
HWY_EXPORT(segmentMayTouch);

void squaredDistanceBounds(const WideNode& node, const PointQuery& query, float* bounds) noexcept {
  HWY_DYNAMIC_DISPATCH(squaredDistanceBounds)(node, query, bounds);
}

void squaredDistanceBoundsOfMinima(const WideNode& node, const PointQuery& query, float* bounds) noexcept {
  HWY_DYNAMIC_DISPATCH(squaredDistanceBoundsOfMinima)(node, query, bounds);
}

std::uint32_t segmentMayTouch(const WideNode& node, const SegmentQuery& query) noexcept {
  return HWY_DYNAMIC_DISPATCH(segmentMayTouch)(node, query);
}

}  // namespace palpate::tree
#endif

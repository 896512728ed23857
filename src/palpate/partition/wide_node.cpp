// Eight box tests at once, compiled for every vector instruction set and chosen at run time.
//
// Products and sums are written apart, never fused, so every instruction set gives the same bits (-ffp-contract=off).
//
// Based on: Wald, Benthin, Boulos, "Getting rid of packets" (2008) for the wide node; Ericson (2005), 5.3.3, for the
// segment-box separating axes.
#include "palpate/partition/wide_node.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "palpate/partition/wide_node.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace palpate::partition::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Takes back more than the few roundings (6e-8 each) of a squared distance.
constexpr float kRoundDown = 1.0f - 1e-6f;
/// Covers the roundings of the sums and products of one separating-axis test.
constexpr float kRoundUp = 1.0f + 1e-6f;

template <class D>
hn::Vec<D> gap(D d, const WideNode& node, const PointQuery& query, int axis, int lane) {
  const auto below = hn::Sub(hn::Load(d, node.low[axis] + lane), hn::Set(d, query.high[axis]));
  const auto above = hn::Sub(hn::Set(d, query.low[axis]), hn::Load(d, node.high[axis] + lane));
  return hn::Max(hn::Max(below, above), hn::Zero(d));
}

void squaredDistanceBounds(const WideNode& node, const PointQuery& query, float* bounds) {
  const hn::CappedTag<float, kNodeWidth> d;
  for (int lane = 0; lane < kNodeWidth; lane += static_cast<int>(hn::Lanes(d))) {
    const auto x = gap(d, node, query, 0, lane);
    const auto y = gap(d, node, query, 1, lane);
    const auto z = gap(d, node, query, 2, lane);
    const auto sum = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    hn::StoreU(hn::Mul(sum, hn::Set(d, kRoundDown)), d, bounds + lane);
  }
}

/// Centre of the boxes relative to the segment's middle, and their half widths, along one axis.
template <class D>
struct Slab {
  hn::Vec<D> offset;
  hn::Vec<D> half;
};

template <class D>
Slab<D> slabOf(D d, const WideNode& node, const SegmentQuery& query, int axis, int lane) {
  const auto low = hn::Load(d, node.low[axis] + lane);
  const auto high = hn::Load(d, node.high[axis] + lane);
  const auto one_half = hn::Set(d, 0.5f);
  const auto centre = hn::Mul(hn::Add(low, high), one_half);
  const auto half = hn::Add(hn::Mul(hn::Sub(high, low), one_half), hn::Set(d, query.slack));
  return {hn::Sub(hn::Set(d, query.middle[axis]), centre), half};
}

/// Whether the axis (box axis i) x (segment) does not separate; a and b are the two other box axes.
template <class D>
hn::Mask<D> notSeparated(D d, const Slab<D>& a, const Slab<D>& b, float half_a, float half_b) {
  const auto da = hn::Set(d, half_a);
  const auto db = hn::Set(d, half_b);
  const auto distance = hn::Abs(hn::Sub(hn::Mul(a.offset, db), hn::Mul(b.offset, da)));
  const auto reach = hn::Add(hn::Mul(a.half, hn::Abs(db)), hn::Mul(b.half, hn::Abs(da)));
  return hn::Le(distance, hn::Mul(reach, hn::Set(d, kRoundUp)));
}

template <class D>
hn::Mask<D> boxesOverlap(D d, const WideNode& node, const SegmentQuery& query, int axis, int lane) {
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
    const auto x = slabOf(d, node, query, 0, lane);
    const auto y = slabOf(d, node, query, 1, lane);
    const auto z = slabOf(d, node, query, 2, lane);
    touch = hn::And(touch, notSeparated(d, y, z, query.half[1], query.half[2]));
    touch = hn::And(touch, notSeparated(d, z, x, query.half[2], query.half[0]));
    touch = hn::And(touch, notSeparated(d, x, y, query.half[0], query.half[1]));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, touch, bits);
    result |= static_cast<std::uint32_t>(bits[0]) << lane;
  }
  return result;
}

}  // namespace palpate::partition::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace palpate::partition {

HWY_EXPORT(squaredDistanceBounds);
HWY_EXPORT(segmentMayTouch);

void squaredDistanceBounds(const WideNode& node, const PointQuery& query, float* bounds) noexcept {
  HWY_DYNAMIC_DISPATCH(squaredDistanceBounds)(node, query, bounds);
}

std::uint32_t segmentMayTouch(const WideNode& node, const SegmentQuery& query) noexcept {
  return HWY_DYNAMIC_DISPATCH(segmentMayTouch)(node, query);
}

}  // namespace palpate::partition
#endif

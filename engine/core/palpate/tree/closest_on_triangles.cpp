// closestOnTriangle for several triangles side by side, compiled for every vector instruction set and chosen at run
// time: all regions of a triangle are worked out and the one that holds is selected, so that no branch is guessed.
//
// The same sums in the same order as one by one, products and sums written apart (-ffp-contract=off): the same bits.
// Rare cases - slivers, and places that rounding leaves in no region - are computed one by one.
//
// Data flow: leaves of the tree (triangle_tree.h) -> here. Not worth it for fewer than three triangles.
// Based on: Ericson, "Real-Time Collision Detection" (2005), section 5.1.5, as closest_on_triangle.cpp.
#include <algorithm>
#include <array>
#include <bit>

#include "palpate/tree/triangle_tree.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "palpate/tree/closest_on_triangles.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace palpate::tree::HWY_NAMESPACE {

#if HWY_HAVE_FLOAT64

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 4>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

struct V3 {
  V x, y, z;
};

HWY_INLINE V set(double value) { return hn::Set(D(), value); }
HWY_INLINE V3 sub(const V3& a, const V3& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
/// a + s b
HWY_INLINE V3 mulAdd(V s, const V3& b, const V3& a) {
  return {hn::Add(a.x, hn::Mul(s, b.x)), hn::Add(a.y, hn::Mul(s, b.y)), hn::Add(a.z, hn::Mul(s, b.z))};
}
/// In the order of Eigen's.
HWY_INLINE V dot(const V3& a, const V3& b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Add(hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)));
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE V3 select(M mask, const V3& yes, const V3& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}

struct Corners {
  V3 a, b, c;
};

#if HWY_CAP_GE256

/// Four doubles from each of four places on: the first of each, the second, ...
HWY_INLINE void loadTurned(const std::array<const double*, 4>& from, int first, V& v0, V& v1, V& v2, V& v3) {
  const D d;
  const V row0 = hn::LoadU(d, from[0] + first);
  const V row1 = hn::LoadU(d, from[1] + first);
  const V row2 = hn::LoadU(d, from[2] + first);
  const V row3 = hn::LoadU(d, from[3] + first);
  const V even01 = hn::InterleaveLower(d, row0, row1);
  const V odd01 = hn::InterleaveUpper(d, row0, row1);
  const V even23 = hn::InterleaveLower(d, row2, row3);
  const V odd23 = hn::InterleaveUpper(d, row2, row3);
  v0 = hn::ConcatLowerLower(d, even23, even01);
  v1 = hn::ConcatLowerLower(d, odd23, odd01);
  v2 = hn::ConcatUpperUpper(d, even23, even01);
  v3 = hn::ConcatUpperUpper(d, odd23, odd01);
}

HWY_INLINE Corners cornersOf(const TriangleRecord* records, const Index* which) {
  std::array<const double*, 4> from;
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = records[which[i]].corners[0].data();
  Corners corners;
  loadTurned(from, 0, corners.a.x, corners.a.y, corners.a.z, corners.b.x);
  loadTurned(from, 4, corners.b.y, corners.b.z, corners.c.x, corners.c.y);
  HWY_ALIGN const double last[4] = {from[0][8], from[1][8], from[2][8], from[3][8]};
  corners.c.z = hn::Load(D(), last);
  return corners;
}

#else

HWY_INLINE Corners cornersOf(const TriangleRecord* records, const Index* which) {
  const D d;
  HWY_ALIGN double turned[9][4];
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
    const double* const from = records[which[i]].corners[0].data();
    for (int k = 0; k < 9; ++k) turned[k][i] = from[k];
  }
  const auto column = [&](int k) HWY_ATTR { return hn::Load(d, turned[k]); };
  return {{column(0), column(1), column(2)}, {column(3), column(4), column(5)}, {column(6), column(7), column(8)}};
}

#endif

/// Selects one of three corners, or of three edges, each from its start to its end; or none.
struct Three {
  M first, second, third;
  HWY_INLINE M any() const { return hn::Or(first, hn::Or(second, third)); }
};

HWY_INLINE V select(const Three& which, V first, V second, V third) {
  return hn::IfThenElse(which.second, second, hn::IfThenElse(which.third, third, first));
}

HWY_INLINE V3 select(const Three& which, const V3& first, const V3& second, const V3& third) {
  return select(which.second, second, select(which.third, third, first));
}

HWY_INLINE V select(const Three& which, Feature first, Feature second, Feature third) {
  const auto number = [](Feature feature) HWY_ATTR { return set(static_cast<double>(feature)); };
  return select(which, number(first), number(second), number(third));
}

/// Where in a triangle the point lies. The first corner or edge that holds counts.
struct Regions {
  Three corner, edge;  ///< an edge also where a corner holds
  M unclear;           ///< a sliver, or no region at all
  V share;             ///< along the edge, from its start; else b's, on the face
  V share_c;           ///< c's, on the face
};

HWY_INLINE Regions classifyRegions(const Corners& corners, const V3& point) {
  const V zero = hn::Zero(D());
  const V3 ab = sub(corners.b, corners.a);
  const V3 ac = sub(corners.c, corners.a);
  const V3 bc = sub(corners.c, corners.b);
  const V3 ap = sub(point, corners.a);
  const V ab_ap = dot(ab, ap);
  const V ac_ap = dot(ac, ap);
  const V ab_ab = dot(ab, ab);
  const V ac_ac = dot(ac, ac);
  const V ab_ac = dot(ab, ac);
  const V ab_bp = hn::Sub(ab_ap, ab_ab);
  const V ac_bp = hn::Sub(ac_ap, ab_ac);
  const V ab_cp = hn::Sub(ab_ap, ab_ac);
  const V ac_cp = hn::Sub(ac_ap, ac_ac);
  Regions at;
  at.corner.first = hn::And(hn::Le(ab_ap, zero), hn::Le(ac_ap, zero));
  at.corner.second = hn::AndNot(at.corner.first, hn::And(hn::Ge(ab_bp, zero), hn::Le(ac_bp, ab_bp)));
  at.corner.third =
      hn::AndNot(hn::Or(at.corner.first, at.corner.second), hn::And(hn::Ge(ac_cp, zero), hn::Le(ab_cp, ac_cp)));

  const V3 normal = cross(ab, ac);
  const V area2_squared = dot(normal, normal);
  const V on_border = hn::Mul(set(kOnBorder), area2_squared);
  const V weight_a = dot(normal, cross(bc, sub(point, corners.b)));
  const V weight_b = dot(normal, cross(ap, ac));
  const V weight_c = dot(normal, cross(ab, ap));
  const V towards_c = hn::Sub(ac_bp, ab_bp);
  const V towards_b = hn::Sub(ab_cp, ac_cp);
  const auto is_beside = [&](V weight, M after_start, M before_end)
                             HWY_ATTR { return hn::And(hn::Le(weight, on_border), hn::And(after_start, before_end)); };
  at.edge.first = is_beside(weight_c, hn::Ge(ab_ap, zero), hn::Le(ab_bp, zero));
  at.edge.third = hn::AndNot(at.edge.first, is_beside(weight_b, hn::Ge(ac_ap, zero), hn::Le(ac_cp, zero)));
  at.edge.second = hn::AndNot(hn::Or(at.edge.first, at.edge.third),
                              is_beside(weight_a, hn::Ge(towards_c, zero), hn::Ge(towards_b, zero)));
  const M by_edge = at.edge.any();

  const M inside = hn::And(hn::Gt(weight_a, zero), hn::And(hn::Gt(weight_b, zero), hn::Gt(weight_c, zero)));
  const V longest2 = hn::Max(hn::Max(ab_ab, ac_ac), dot(bc, bc));
  const M is_sliver = hn::Le(area2_squared, hn::Mul(hn::Mul(set(kSliverShare), longest2), longest2));
  at.unclear = hn::AndNot(at.corner.any(), hn::Or(is_sliver, hn::Not(hn::Or(by_edge, inside))));

  const V sum = hn::Add(hn::Add(weight_a, weight_b), weight_c);
  const V over = hn::IfThenElse(by_edge, select(at.edge, ab_ap, towards_c, ac_ap), weight_b);
  const V under = hn::IfThenElse(by_edge, select(at.edge, ab_ab, hn::Add(towards_c, towards_b), ac_ac), sum);
  const V share = hn::Div(over, under);
  at.share = hn::IfThenElse(at.edge.third, hn::Sub(set(1.0), share), share);
  at.share_c = hn::Div(weight_c, sum);
  return at;
}

/// Writes the lanes from `lane` on. Returns those that have to be asked one by one.
HWY_INLINE std::uint32_t computeClosest(const Corners& corners, const V3& point, int lane, ClosestSideBySide& closest) {
  const D d;
  const auto& [a, b, c] = corners;
  const Regions at = classifyRegions(corners, point);
  const M by_edge = at.edge.any();
  const V3 start = select(at.edge, a, b, c);
  const V3 end = select(at.edge, b, c, a);
  const V3 on_edge = mulAdd(at.share, sub(end, start), start);
  const V3 on_face = mulAdd(at.share_c, sub(c, a), on_edge);  // no edge: from a on towards b, then c
  const M at_start = hn::And(by_edge, hn::Le(at.share, set(kOnBorder)));
  const M at_end = hn::And(by_edge, hn::Ge(at.share, set(1.0 - kOnBorder)));
  V3 place = select(at_start, start, select(at_end, end, select(by_edge, on_edge, on_face)));
  place = select(at.corner.any(), select(at.corner, a, b, c), place);

  static_assert(Feature::face == Feature{});
  const V starts = select(at.edge, Feature::corner0, Feature::corner1, Feature::corner2);
  const V ends = select(at.edge, Feature::corner1, Feature::corner2, Feature::corner0);
  const V edges = select(at.edge, Feature::edge0, Feature::edge1, Feature::edge2);
  V feature = hn::IfThenElse(at_start, starts, hn::IfThenElse(at_end, ends, hn::IfThenElseZero(by_edge, edges)));
  feature =
      hn::IfThenElse(at.corner.any(), select(at.corner, Feature::corner0, Feature::corner1, Feature::corner2), feature);

  const V3 way = sub(place, point);
  hn::Store(place.x, d, closest.x + lane);
  hn::Store(place.y, d, closest.y + lane);
  hn::Store(place.z, d, closest.z + lane);
  hn::Store(dot(way, way), d, closest.squared_distance + lane);
  hn::Store(feature, d, closest.feature + lane);
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, at.unclear, bits);
  return static_cast<std::uint32_t>(bits[0]) << lane;
}

std::uint32_t closestOnTriangles(const TriangleRecord* records, const Index* which, int count, const Vec3& place,
                                 ClosestSideBySide& closest) {
  const V3 point{set(place.x()), set(place.y()), set(place.z())};
  Index padded[kMaxSideBySide];
  for (int i = 0; i < kMaxSideBySide; ++i) padded[i] = which[std::min(i, count - 1)];
  std::uint32_t unclear = 0;
  for (int lane = 0; lane < count; lane += static_cast<int>(hn::Lanes(D()))) {
    unclear |= computeClosest(cornersOf(records, padded + lane), point, lane, closest);
  }
  return unclear & ((1u << count) - 1u);
}

#else  // Highway has no vectors of doubles in WebAssembly: all one by one

std::uint32_t closestOnTriangles(const TriangleRecord* /*records*/, const Index* /*which*/, int count,
                                 const Vec3& /*place*/, ClosestSideBySide& /*closest*/) {
  return (1u << count) - 1u;
}

#endif

}  // namespace palpate::tree::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace palpate::tree {

HWY_EXPORT(closestOnTriangles);

void closestOnTriangles(const TriangleRecord* records, const Index* which, int count, const Vec3& point,
                        ClosestSideBySide& closest) noexcept {
  std::uint32_t unclear = HWY_DYNAMIC_DISPATCH(closestOnTriangles)(records, which, count, point, closest);
  for (; unclear != 0; unclear &= unclear - 1) {
    const int i = std::countr_zero(unclear);
    closest.set(i, closestOnTriangle(records[which[i]].corners, point));
  }
}

}  // namespace palpate::tree
#endif

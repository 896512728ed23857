// A contact with layered tissue, eight vertices at a time: the curves of tissue/layered_curve.h, of a press that also
// moves outward and of a drag. Included once for each instruction set (kernels.cpp).
//
// The press moves a vertex by -depth down(q) n + depth q outward(q) e; with flat = s along + t across, half the
// gradient of q^2 in the plane, on a circle q / radius long, the second part is outward_mm2 outward(q) flat. Gradients
// are those of q^2 times the curves' own derivatives by it, so that no root is taken.
#if defined(PALPATE_DEFORM_LAYERED_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef PALPATE_DEFORM_LAYERED_LANES_INL
#undef PALPATE_DEFORM_LAYERED_LANES_INL
#else
#define PALPATE_DEFORM_LAYERED_LANES_INL
#endif

#include "palpate/deform/kernels/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace palpate::deform {
namespace HWY_NAMESPACE {

/// Where a vertex lies on the bell of a curve.
struct OnBell {
  V x;  ///< 1 in the middle, 0 on the rim
  V y;  ///< 2 x - 1
  V x_by_q2;
};

HWY_INLINE OnBell onBell(const CurveLanes& curve, V q2) {
  const Lanes d;
  const V one = hn::Set(d, 1.0f);
  const V bell = hn::Div(one, mulAdd(hn::Set(d, curve.bend), q2, one));
  const V x = hn::Mul(hn::Sub(bell, hn::Set(d, curve.rim)), hn::Set(d, curve.scale));
  const V fall = hn::Mul(hn::Mul(bell, bell), hn::Set(d, -curve.bend * curve.scale));
  return {x, hn::Sub(hn::Add(x, x), one), fall};
}

/// A curve's value, and twice its derivative by q^2, which times the half gradient of q^2 is its gradient.
struct CurveLane {
  V value, slope;
};

HWY_INLINE CurveLane curveOn(const float (&terms)[tissue::kCurveTerms], const OnBell& at) {
  const Lanes d;
  V sum = hn::Set(d, terms[tissue::kCurveTerms - 1]);
  V slope = hn::Zero(d);
  for (int k = tissue::kCurveTerms - 2; k >= 0; --k) {
    slope = mulAdd(slope, at.y, sum);
    sum = mulAdd(sum, at.y, hn::Set(d, terms[k]));
  }
  const V by_x = hn::Mul(hn::Add(at.x, at.x), mulAdd(at.x, slope, sum));
  return {hn::Mul(hn::Mul(at.x, at.x), sum), hn::Mul(hn::Add(at.x_by_q2, at.x_by_q2), by_x)};
}

/// Where a vertex lies in a part: q^2, half its gradient, and that without the rise.
struct Place {
  V q2;
  V3 gradient, flat;
};

template <bool kLevel>
HWY_INLINE Place placeIn(const ContactLanes& contact, const PartLanes& part, const V3& offset) {
  const Location at = locate(part, offset);
  const V3 flat = mulAdd(at.s, broadcast(part.along), scaled(at.t, broadcast(part.across)));
  if constexpr (kLevel) return {at.q2, flat, flat};
  const V3 facing = broadcast(contact.facing);
  const V height = dot(facing, offset);
  const V rise = riseAt(part, hn::Abs(height));
  const V up = hn::CopySign(hn::Mul(rise, hn::Set(Lanes(), part.slope)), height);
  return {mulAdd(rise, rise, at.q2), mulAdd(up, facing, flat), flat};
}

template <bool kLevel>
HWY_INLINE void addLayeredPress(const ContactLanes& contact, const V3& offset, M region, Motion& motion) {
  const Lanes d;
  const PartLanes& part = contact.normal;
  const Place at = placeIn<kLevel>(contact, part, offset);
  const M acts = hn::And(region, hn::Lt(at.q2, hn::Set(d, 1.0f)));
  if (hn::AllFalse(d, acts)) return;
  const OnBell bell = onBell(part.share, at.q2);
  const CurveLane down = curveOn(part.share.terms, bell);
  const CurveLane outward = curveOn(contact.outward, bell);
  const V outward_mm2 = hn::IfThenElseZero(acts, hn::Set(d, contact.outward_mm2));
  const V weight = hn::IfThenElseZero(acts, down.value);
  const V slope = hn::IfThenElseZero(acts, down.slope);
  const V pull = hn::Mul(outward_mm2, outward.value);
  const V pull_slope = hn::Mul(outward_mm2, outward.slope);
  const V3 shift = broadcast(part.shift);
  motion.displacement = mulAdd(pull, at.flat, mulAdd(weight, shift, motion.displacement));
  const auto plane = [&](int i) HWY_ATTR { return hn::Mul(pull, hn::Set(d, contact.plane[i])); };
  const V xy = plane(1);
  const V xz = plane(2);
  const V yz = plane(4);
  const V3 along{mulAdd(pull_slope, at.flat.x, hn::Mul(slope, shift.x)),
                 mulAdd(pull_slope, at.flat.y, hn::Mul(slope, shift.y)),
                 mulAdd(pull_slope, at.flat.z, hn::Mul(slope, shift.z))};
  motion.row_x = mulAdd(along.x, at.gradient, add(motion.row_x, {plane(0), xy, xz}));
  motion.row_y = mulAdd(along.y, at.gradient, add(motion.row_y, {xy, plane(3), yz}));
  motion.row_z = mulAdd(along.z, at.gradient, add(motion.row_z, {xz, yz, plane(5)}));
}

/// Weight and gradient of a layered drag.
template <bool kLevel>
HWY_INLINE Profile computeLayeredDrag(const ContactLanes& contact, const V3& offset, M region) {
  const Lanes d;
  const PartLanes& part = contact.tangential;
  const Place at = placeIn<kLevel>(contact, part, offset);
  const M acts = hn::And(region, hn::Lt(at.q2, hn::Set(d, 1.0f)));
  const CurveLane share = curveOn(part.share.terms, onBell(part.share, at.q2));
  return {hn::IfThenElseZero(acts, share.value), scaled(hn::IfThenElseZero(acts, share.slope), at.gradient)};
}

template <bool kLevel>
HWY_INLINE void addLayeredDrag(const ContactLanes& contact, const V3& offset, M region, Motion& motion) {
  if (!drags(contact)) return;
  const Profile profile = computeLayeredDrag<kLevel>(contact, offset, region);
  const V3 shift = broadcast(contact.tangential.shift);
  motion.displacement = mulAdd(profile.weight, shift, motion.displacement);
  motion.row_x = mulAdd(shift.x, profile.gradient, motion.row_x);
  motion.row_y = mulAdd(shift.y, profile.gradient, motion.row_y);
  motion.row_z = mulAdd(shift.z, profile.gradient, motion.row_z);
}

/// cof(F) n of a drag alone: (1 + b.v) n - (b.n) v.
HWY_INLINE void moveByLayeredDrag(const ContactLanes& contact, const V3& offset, M region, V3& displacement,
                                  V3& normal) {
  const Profile drag = computeLayeredDrag<true>(contact, offset, region);
  const V3 b = broadcast(contact.tangential.shift);
  displacement = scaled(drag.weight, b);
  const V stretch = hn::Add(dot(b, drag.gradient), hn::Set(Lanes(), 1.0f));
  normal = mulSub(dot(b, normal), drag.gradient, scaled(stretch, normal));
}

/// Most of a dragged region lies outside of the press: those vertices need no more than their drag.
HWY_INLINE M beyondPress(const ContactLanes& contact, const V3& offset) {
  return hn::Not(hn::Lt(locate(contact.normal, offset).q2, hn::Set(Lanes(), 1.0f)));
}

/// One contact with layered tissue, on a level block. Each vertex branches alone, whatever shares its vector: else its
/// bits would follow the vectors' width.
HWY_INLINE void moveByOneLayered(const ContactLanes& contact, const V3& position, M region, V3& displacement,
                                 V3& normal) {
  const Lanes d;
  const V3 offset = sub(position, broadcast(contact.anchor));
  const M beyond = beyondPress(contact, offset);
  V3 dragged = normal;
  V3 dragged_by = offset;
  if (!hn::AllFalse(d, beyond)) moveByLayeredDrag(contact, offset, region, dragged_by, dragged);
  if (!hn::AllTrue(d, beyond)) {
    Motion motion = noMotion();
    addLayeredPress<true>(contact, offset, region, motion);
    addLayeredDrag<true>(contact, offset, region, motion);
    displacement = motion.displacement;
    turn(motion, normal);
  }
  displacement = select(beyond, dragged_by, displacement);
  normal = select(beyond, dragged, normal);
}

}  // namespace HWY_NAMESPACE
}  // namespace palpate::deform
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard

// The kernels of the deformation, written once, compiled for each instruction set.
//
// Displacement: u = sum over contacts and parts of profile(q) shift, profile = scale exp(-rate q^2) - offset (E18), q
// of the true ellipse (E14): a quadratic form, no root. Normal: the deformation x -> x + u(x) has the gradient F = I +
// sum shift (x) grad profile; a surface normal n becomes cof(F) n, normalised. The profile's gradient lies in the
// contact's tangent plane: grad profile = -2 rate scale exp(-rate q^2) (s along + t across), with s = along . d and t =
// across . d. Everything is exact for the smooth surface; against the facets of a mesh it differs by what the facets
// differ from the surface (docs/deformation.md). Based on: Ji, dissertation 2008, sections 4.2 to 4.4; the rule for
// normals is Nanson's formula.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "palpate/deform/kernels.cpp"
#include <hwy/foreach_target.h>
// The order matters: foreach_target compiles this file once more for every further instruction set.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <cstring>

#include "palpate/deform/blocks.h"
#include "palpate/deform/kernels.h"
#include "palpate/tissue/profile.h"

HWY_BEFORE_NAMESPACE();
namespace palpate::deform {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, kBlockVertices>;
using V = hn::Vec<Lanes>;
using M = hn::Mask<Lanes>;

struct V3 {
  V x, y, z;
};

HWY_INLINE V3 broadcast(const float (&v)[3]) {
  const Lanes d;
  return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
}

HWY_INLINE V3 load(const float* const* values, size_t lane) {
  const Lanes d;
  return {hn::Load(d, values[0] + lane), hn::Load(d, values[1] + lane), hn::Load(d, values[2] + lane)};
}

HWY_INLINE void store(const V3& v, float* const* values, size_t lane) {
  const Lanes d;
  hn::Store(v.x, d, values[0] + lane);
  hn::Store(v.y, d, values[1] + lane);
  hn::Store(v.z, d, values[2] + lane);
}

HWY_INLINE V dot(const V3& a, const V3& b) { return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z))); }
HWY_INLINE V3 sub(const V3& a, const V3& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE V3 add(const V3& a, const V3& b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
/// a + s b
HWY_INLINE V3 mulAdd(V s, const V3& b, const V3& a) {
  return {hn::MulAdd(s, b.x, a.x), hn::MulAdd(s, b.y, a.y), hn::MulAdd(s, b.z, a.z)};
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
HWY_INLINE V3 select(M mask, const V3& yes, const V3& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}

/// The mask of the vector that starts at `lane`, out of a block's word.
HWY_INLINE M maskAt(std::uint64_t bits, size_t lane) {
  bits >>= lane;
  std::uint8_t bytes[8];
  std::memcpy(bytes, &bits, sizeof(bits));
  return hn::LoadMaskBits(Lanes(), bytes);
}

struct Location {
  V s, t, q2;
};

HWY_INLINE Location locate(const PartLanes& part, const V3& offset) {
  const V s = dot(broadcast(part.along), offset);
  const V t = dot(broadcast(part.across), offset);
  return {s, t, hn::MulAdd(s, s, hn::MulAdd(t, t, hn::Set(Lanes(), part.outside)))};
}

std::uint64_t insideMask(const ContactLanes& contact, const RestBlock& rest) {
  const Lanes d;
  const V one = hn::Set(d, 1.0f);
  std::uint64_t inside = 0;
  for (size_t lane = 0; lane < kBlockVertices; lane += hn::Lanes(d)) {
    const V3 offset = sub(load(rest.values, lane), broadcast(contact.anchor));
    const M facing = hn::Gt(dot(load(rest.values + 3, lane), broadcast(contact.facing)), hn::Zero(d));
    const M near =
        hn::Or(hn::Lt(locate(contact.normal, offset).q2, one), hn::Lt(locate(contact.tangential, offset).q2, one));
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, hn::And(facing, near), bytes);
    std::uint64_t bits;
    std::memcpy(&bits, bytes, sizeof(bits));
    inside |= bits << lane;
  }
  return inside;
}

/// Rows of F - I and the displacement so far.
struct Motion {
  V3 displacement;
  V3 row_x, row_y, row_z;
};

HWY_INLINE void addPart(const PartLanes& part, const V3& offset, M region, Motion& motion) {
  const Lanes d;
  const Location at = locate(part, offset);
  const M acts = hn::And(region, hn::Lt(at.q2, hn::Set(d, 1.0f)));
  const V bell =
      hn::IfThenElseZero(acts, hn::Mul(hn::Set(d, static_cast<float>(tissue::kProfileScale)),
                                       hn::Exp(d, hn::Mul(hn::Set(d, -static_cast<float>(kGaussianRate)), at.q2))));
  const V weight = hn::IfThenElseZero(acts, hn::Sub(bell, hn::Set(d, static_cast<float>(tissue::kProfileOffset))));
  const V3 shift = broadcast(part.shift);
  motion.displacement = mulAdd(weight, shift, motion.displacement);
  const V slope = hn::Mul(bell, hn::Set(d, -2.0f * static_cast<float>(kGaussianRate)));
  const V3 along = broadcast(part.along);
  const V3 across = broadcast(part.across);
  const V s = hn::Mul(slope, at.s);
  const V t = hn::Mul(slope, at.t);
  const V3 gradient = mulAdd(s, along, {hn::Mul(t, across.x), hn::Mul(t, across.y), hn::Mul(t, across.z)});
  motion.row_x = mulAdd(shift.x, gradient, motion.row_x);
  motion.row_y = mulAdd(shift.y, gradient, motion.row_y);
  motion.row_z = mulAdd(shift.z, gradient, motion.row_z);
}

/// cof(F) n, normalised; n itself where it vanishes (skin folded flat).
HWY_INLINE V3 turnedNormal(const Motion& motion, const V3& n) {
  const Lanes d;
  const V one = hn::Set(d, 1.0f);
  const V3 x{hn::Add(motion.row_x.x, one), motion.row_x.y, motion.row_x.z};
  const V3 y{motion.row_y.x, hn::Add(motion.row_y.y, one), motion.row_y.z};
  const V3 z{motion.row_z.x, motion.row_z.y, hn::Add(motion.row_z.z, one)};
  const V3 turned{dot(cross(y, z), n), dot(cross(z, x), n), dot(cross(x, y), n)};
  const V length2 = dot(turned, turned);
  const V scale = hn::Div(one, hn::Sqrt(length2));
  const V3 unit{hn::Mul(turned.x, scale), hn::Mul(turned.y, scale), hn::Mul(turned.z, scale)};
  return select(hn::Gt(length2, hn::Zero(d)), unit, n);
}

void displaceBlock(std::span<const ContactOnBlock> contacts, const RestBlock& rest, const DeformedBlock& out) {
  const Lanes d;
  const V zero = hn::Zero(d);
  std::uint64_t touched = 0;
  for (const ContactOnBlock& on : contacts) touched |= on.region;
  for (size_t lane = 0; lane < kBlockVertices; lane += hn::Lanes(d)) {
    const V3 position = load(rest.values, lane);
    const V3 normal = load(rest.values + 3, lane);
    Motion motion{{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}};
    for (const ContactOnBlock& on : contacts) {
      const M region = maskAt(on.region, lane);
      const V3 offset = sub(position, broadcast(on.contact->anchor));
      addPart(on.contact->normal, offset, region, motion);
      if (on.contact->tangential.outside == 0.0f) addPart(on.contact->tangential, offset, region, motion);
    }
    const M moved = maskAt(touched, lane);
    store(select(moved, add(position, motion.displacement), position), out.values, lane);
    store(select(moved, turnedNormal(motion, normal), normal), out.values + 3, lane);
    store(motion.displacement, out.values + 6, lane);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace palpate::deform
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace palpate::deform {

HWY_EXPORT(insideMask);
HWY_EXPORT(displaceBlock);

std::uint64_t insideMask(const ContactLanes& contact, const RestBlock& rest) noexcept {
  return HWY_DYNAMIC_DISPATCH(insideMask)(contact, rest);
}

void displaceBlock(std::span<const ContactOnBlock> contacts, const RestBlock& rest, const DeformedBlock& out) noexcept {
  HWY_DYNAMIC_DISPATCH(displaceBlock)(contacts, rest, out);
}

}  // namespace palpate::deform
#endif

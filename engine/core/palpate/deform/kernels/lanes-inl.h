// Common base of all kernels of the deformation: vectors of three, masks out of a block's word, where vertices lie in a
// part, and the motion that contacts add up to. Included once for each instruction set (kernels.cpp).
#if defined(PALPATE_DEFORM_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef PALPATE_DEFORM_LANES_INL
#undef PALPATE_DEFORM_LANES_INL
#else
#define PALPATE_DEFORM_LANES_INL
#endif

#include <hwy/highway.h>

#include <cstring>

#include "palpate/deform/kernels/kernels.h"

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

/// a b + c. Products are rounded before they are added: the skin has the same bits on every processor, with fused
/// multiply-add or without. The machine's estimates of 1 / x and 1 / sqrt(x) would not have them either.
HWY_INLINE V mulAdd(V a, V b, V c) { return hn::Add(hn::Mul(a, b), c); }
/// c - a b
HWY_INLINE V mulSub(V a, V b, V c) { return hn::Sub(c, hn::Mul(a, b)); }

HWY_INLINE V dot(const V3& a, const V3& b) { return mulAdd(a.x, b.x, mulAdd(a.y, b.y, hn::Mul(a.z, b.z))); }
HWY_INLINE V3 sub(const V3& a, const V3& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE V3 add(const V3& a, const V3& b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
/// a + s b
HWY_INLINE V3 mulAdd(V s, const V3& b, const V3& a) {
  return {mulAdd(s, b.x, a.x), mulAdd(s, b.y, a.y), mulAdd(s, b.z, a.z)};
}
HWY_INLINE V3 scaled(V s, const V3& a) { return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)}; }
/// a - s b
HWY_INLINE V3 mulSub(V s, const V3& b, const V3& a) {
  return {mulSub(s, b.x, a.x), mulSub(s, b.y, a.y), mulSub(s, b.z, a.z)};
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {mulSub(a.z, b.y, hn::Mul(a.y, b.z)), mulSub(a.x, b.z, hn::Mul(a.z, b.x)),
          mulSub(a.y, b.x, hn::Mul(a.x, b.y))};
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
  return {s, t, mulAdd(s, s, mulAdd(t, t, hn::Set(Lanes(), part.outside)))};
}

/// Rise of heights without their sign.
HWY_INLINE V riseAt(const PartLanes& part, V height) {
  const Lanes d;
  return hn::Mul(hn::Max(hn::Sub(height, hn::Set(d, part.level)), hn::Zero(d)), hn::Set(d, part.slope));
}

/// The bits of a mask at `lane` of a word of 64.
HWY_INLINE std::uint64_t bitsOf(M mask, size_t lane) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Lanes(), mask, bytes);
  std::uint64_t bits;
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits << lane;
}

HWY_INLINE bool drags(const ContactLanes& contact) { return contact.tangential.outside == 0.0f; }

HWY_INLINE V3 absolute(const V3& v) { return {hn::Abs(v.x), hn::Abs(v.y), hn::Abs(v.z)}; }

/// profile(q) and its gradient at 16 (8, 4) vertices; both 0 outside the region and from q = 1 on.
struct Profile {
  V weight;
  V3 gradient;
};

/// Rows of F and the displacement so far, of any number of contacts.
struct Motion {
  V3 displacement;
  V3 row_x, row_y, row_z;
};

/// cof(F) n.
HWY_INLINE void turn(const Motion& motion, V3& normal) {
  normal = {dot(cross(motion.row_y, motion.row_z), normal), dot(cross(motion.row_z, motion.row_x), normal),
            dot(cross(motion.row_x, motion.row_y), normal)};
}

HWY_INLINE Motion noMotion() {
  const Lanes d;
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, 1.0f);
  return {{zero, zero, zero}, {one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
}

}  // namespace HWY_NAMESPACE
}  // namespace palpate::deform
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard

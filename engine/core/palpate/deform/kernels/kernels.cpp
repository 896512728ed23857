// The kernels of the deformation, written once, compiled for each instruction set.
//
// Displacement: u = sum over contacts and parts of profile(q) shift, profile = scale exp(-rate q^2) - offset (E18), q
// of the true ellipse (E14): a quadratic form, no root. Normal: the deformation x -> x + u(x) has the gradient F = I +
// sum shift (x) grad profile; a surface normal n becomes cof(F) n, normalised. On level blocks the profile's gradient
// lies in the contact's tangent plane: grad profile = -2 rate scale exp(-rate q^2) (s along + t across), with s = along
// . d and t = across . d; where the skin rises farther off that plane a part along the normal joins it, and the general
// sum is taken. Everything is exact for the smooth surface; against the facets of a mesh it differs by what the facets
// differ from the surface (docs/explanation/deformation.md). Based on: Ji, dissertation 2008, sections 4.2 to 4.4; the
// rule for normals is Nanson's formula.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "palpate/deform/kernels/kernels.cpp"
#include <hwy/foreach_target.h>
// The order matters: foreach_target compiles this file once more for every further instruction set.
#include <hwy/highway.h>

#include <cmath>
#include <cstring>

#include "palpate/deform/kernels/blocks.h"
#include "palpate/deform/kernels/kernels.h"
#include "palpate/deform/kernels/lanes-inl.h"
#include "palpate/deform/kernels/layered_lanes-inl.h"
#include "palpate/tissue/profile.h"

HWY_BEFORE_NAMESPACE();
namespace palpate::deform {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Bounds over boxes.
struct Reach {
  V least, most;
};

/// Reach in q^2; `flat_least` leaves the rise out.
struct RegionReach : Reach {
  V flat_least;
};

HWY_INLINE RegionReach reachOf(const PartLanes& part, const V3& centre, const V3& half, const Reach& height) {
  const Lanes d;
  const V outside = hn::Set(d, part.outside);
  if (part.outside != 0.0f) return {{outside, outside}, outside};  // does not act
  const V rise_least = riseAt(part, height.least);
  const V rise_most = riseAt(part, height.most);
  const V3 along = broadcast(part.along);
  const V3 across = broadcast(part.across);
  const V s = hn::Abs(dot(along, centre));
  const V t = hn::Abs(dot(across, centre));
  const V s_half = dot(absolute(along), half);
  const V t_half = dot(absolute(across), half);
  const V s_least = hn::Max(hn::Sub(s, s_half), hn::Zero(d));
  const V t_least = hn::Max(hn::Sub(t, t_half), hn::Zero(d));
  const V s_most = hn::Add(s, s_half);
  const V t_most = hn::Add(t, t_half);
  const V flat_least = mulAdd(s_least, s_least, hn::Mul(t_least, t_least));
  const V flat_most = mulAdd(s_most, s_most, hn::Mul(t_most, t_most));
  return {{mulAdd(rise_least, rise_least, flat_least), mulAdd(rise_most, rise_most, flat_most)}, flat_least};
}

/// Boxes whose vertices do not rise in this part, or that it does not move however high they lie.
HWY_INLINE M isLevel(const PartLanes& part, const RegionReach& reach, const Reach& height) {
  const Lanes d;
  return hn::Or(hn::Le(height.most, hn::Set(d, part.level)), hn::Ge(reach.flat_least, hn::Set(d, 1.0f)));
}

BlocksInside insideBlocks(const ContactLanes& contact, const TileBounds& bounds) {
  const Lanes d;
  const V one = hn::Set(d, 1.0f);
  const V rounding = hn::Set(d, 1e-6f);
  const V3 facing = broadcast(contact.facing);
  BlocksInside blocks{0, 0, 0, 0};
  for (size_t lane = 0; lane < kTileBlocks; lane += hn::Lanes(d)) {
    const V3 centre = sub(load(bounds.values, lane), broadcast(contact.anchor));
    const V3 half = mulAdd(rounding, absolute(centre), load(bounds.values + 3, lane));
    const V height_middle = hn::Abs(dot(facing, centre));
    const V height_half = dot(absolute(facing), half);
    const Reach height{hn::Max(hn::Sub(height_middle, height_half), hn::Zero(d)), hn::Add(height_middle, height_half)};
    const RegionReach normal = reachOf(contact.normal, centre, half, height);
    const RegionReach tangential = reachOf(contact.tangential, centre, half, height);
    const V face = dot(load(bounds.values + 6, lane), facing);
    const V face_half = hn::Add(dot(load(bounds.values + 9, lane), absolute(facing)), rounding);
    // Written so that boxes of NaN are touched but not whole.
    const M near = hn::Or(hn::Lt(normal.most, one), hn::Lt(tangential.most, one));
    const M far = hn::And(hn::Ge(normal.least, one), hn::Ge(tangential.least, one));
    const M level = hn::And(isLevel(contact.normal, normal, height), isLevel(contact.tangential, tangential, height));
    const M faces = hn::Gt(hn::Sub(face, face_half), hn::Set(d, kSteepFacing));
    blocks.whole |= bitsOf(hn::And(hn::And(near, faces), level), lane);
    blocks.touched |= bitsOf(hn::Not(far), lane);
    blocks.level |= bitsOf(level, lane);
    blocks.facing |= bitsOf(faces, lane);
  }
  return blocks;
}

template <bool kLevel>
HWY_INLINE M isNear(const PartLanes& part, const V3& offset, V height) {
  V q2 = locate(part, offset).q2;
  if constexpr (!kLevel) {
    const V rise = riseAt(part, height);
    q2 = mulAdd(rise, rise, q2);
  }
  return hn::Lt(q2, hn::Set(Lanes(), 1.0f));
}

template <bool kLevel, bool kFacing>
HWY_INLINE VerticesInside findVerticesInside(const ContactLanes& contact, const RestBlock& rest) {
  const Lanes d;
  VerticesInside inside{0, 0};
  for (size_t lane = 0; lane < kBlockVertices; lane += hn::Lanes(d)) {
    const V3 offset = sub(load(rest.values, lane), broadcast(contact.anchor));
    const V height = kLevel ? hn::Zero(d) : hn::Abs(dot(broadcast(contact.facing), offset));
    M near = isNear<kLevel>(contact.normal, offset, height);
    if (drags(contact)) near = hn::Or(near, isNear<kLevel>(contact.tangential, offset, height));
    if constexpr (kFacing) {
      inside.facing |= bitsOf(near, lane);
      continue;
    }
    const V facing = dot(load(rest.values + 3, lane), broadcast(contact.facing));
    inside.facing |= bitsOf(hn::And(near, hn::Gt(facing, hn::Zero(d))), lane);
    const M steep = hn::AndNot(hn::Gt(facing, hn::Set(d, kSteepFacing)), near);
    if (!hn::AllFalse(d, steep)) inside.steep |= bitsOf(steep, lane);  // seldom
  }
  return inside;
}

VerticesInside verticesInside(const ContactLanes& contact, const RestBlock& rest, BlockSeen seen) {
  if (seen.is_facing)
    return seen.is_level ? findVerticesInside<true, true>(contact, rest)
                         : findVerticesInside<false, true>(contact, rest);
  return seen.is_level ? findVerticesInside<true, false>(contact, rest)
                       : findVerticesInside<false, false>(contact, rest);
}

/// exp(-rate q^2) for 0 <= q^2 <= 1, within 3e-7 of its value; anything outside. 2^t is split into a whole power, added
/// to the exponent's bits, and the Taylor series of 2^f for |f| <= 1/2: a third of the work of an exp for every number.
HWY_INLINE V gaussian(V q2) {
  const Lanes d;
  const hn::RebindToSigned<Lanes> di;
  constexpr double kLn2 = 0.6931471805599453;
  const auto series = [&](V sum, V f, double coefficient)
                          HWY_ATTR { return mulAdd(sum, f, hn::Set(d, static_cast<float>(coefficient))); };
  const V t = hn::Mul(q2, hn::Set(d, static_cast<float>(-kGaussianRate / kLn2)));
  // Added to 1.5 * 2^23 a small number is rounded to a whole one, which is then in the last bits.
  const V shift = hn::Set(d, 12582912.0f);
  const V shifted = hn::Add(t, shift);
  const V f = hn::Sub(t, hn::Sub(shifted, shift));
  constexpr double kLn2To2 = kLn2 * kLn2;
  V sum = hn::Set(d, static_cast<float>(kLn2To2 * kLn2To2 * kLn2To2 / 720));
  sum = series(sum, f, kLn2To2 * kLn2To2 * kLn2 / 120);
  sum = series(sum, f, kLn2To2 * kLn2To2 / 24);
  sum = series(sum, f, kLn2To2 * kLn2 / 6);
  sum = series(sum, f, kLn2To2 / 2);
  sum = series(sum, f, kLn2);
  sum = series(sum, f, 1.0);
  constexpr int kExponentBit = 23;
  return hn::BitCast(d, hn::Add(hn::BitCast(di, sum), hn::ShiftLeft<kExponentBit>(hn::BitCast(di, shifted))));
}

HWY_INLINE V profileScaled(V gauss) {
  const Lanes d;
  return hn::Sub(hn::Mul(hn::Set(d, static_cast<float>(tissue::kProfileScale)), gauss),
                 hn::Set(d, static_cast<float>(tissue::kProfileOffset)));
}

HWY_INLINE float lengthOf(const float (&v)[3]) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// The room of layered tissue from q on.
HWY_INLINE V roomFrom(const PartLanes& part, V q) {
  const Lanes d;
  V room = hn::Set(d, part.room[0]);
  for (int i = 1; i < kRoomSteps; ++i) {
    const M beyond = hn::Ge(q, hn::Set(d, static_cast<float>(i) / static_cast<float>(kRoomSteps)));
    room = hn::IfThenElse(beyond, hn::Set(d, part.room[i]), room);
  }
  return hn::IfThenElseZero(hn::Lt(q, hn::Set(d, 1.0f)), room);
}

/// Adds to each of some vertices of a block the longest that a part moves anything by within an edge's length of it: q
/// falls by the inverse of the minor half axis a mm at most.
HWY_INLINE void addMostMoved(const ContactLanes& contact, const PartLanes& moving, const EdgeBlock& edge,
                             std::uint64_t of, float* most_mm) {
  const Lanes d;
  if (moving.outside != 0.0f) return;  // does not act
  const PartLanes part = moving;       // a copy that no store can alias
  const V3 anchor = broadcast(contact.anchor);
  const V3 facing = broadcast(contact.facing);
  const V nearer_by = hn::Set(d, edge.longest_mm * lengthOf(part.across));
  const V length = hn::Set(d, lengthOf(part.shift));
  for (size_t lane = 0; lane < kBlockVertices; lane += hn::Lanes(d)) {
    if (hn::AllFalse(d, maskAt(of, lane))) continue;
    const V3 offset = sub(load(edge.rest.values, lane), anchor);
    const V rise = riseAt(part, hn::Abs(dot(facing, offset)));
    const V q = hn::Sqrt(mulAdd(rise, rise, locate(part, offset).q2));
    const V nearer = hn::Max(hn::Sub(q, nearer_by), hn::Zero(d));
    const V weight = contact.layered ? roomFrom(part, nearer)
                                     : profileScaled(gaussian(hn::Min(hn::Mul(nearer, nearer), hn::Set(d, 1.0f))));
    hn::Store(mulAdd(weight, length, hn::Load(d, most_mm + lane)), d, most_mm + lane);
  }
}

std::uint64_t strainedVertices(std::span<const ContactLanes> contacts, const EdgeBlock& edge, std::uint64_t of,
                               float most_mm) {
  const Lanes d;
  HWY_ALIGN float moved_mm[kBlockVertices] = {};
  for (const ContactLanes& contact : contacts) {
    addMostMoved(contact, contact.normal, edge, of, moved_mm);
    addMostMoved(contact, contact.tangential, edge, of, moved_mm);
  }
  std::uint64_t strained = 0;
  for (size_t lane = 0; lane < kBlockVertices; lane += hn::Lanes(d)) {
    const V room = hn::Min(hn::Load(d, edge.room_mm + lane), hn::Set(d, most_mm));
    strained |= bitsOf(hn::Gt(hn::Load(d, moved_mm + lane), room), lane);
  }
  return strained & of;
}

/// Where the height over the contact's plane matters (not kLevel) its slope along the normal joins the gradient.
/// kAllInside: the vertices are known to lie in this part's ellipse.
template <bool kLevel, bool kAllInside>
HWY_INLINE Profile profileOf(const ContactLanes& contact, const PartLanes& part, const V3& offset, M region) {
  const Lanes d;
  const Location at = locate(part, offset);
  const V3 facing = broadcast(contact.facing);
  const V height = kLevel ? hn::Zero(d) : dot(facing, offset);
  const V rise = kLevel ? hn::Zero(d) : riseAt(part, hn::Abs(height));
  const V q2 = kLevel ? at.q2 : mulAdd(rise, rise, at.q2);
  const V gauss = gaussian(q2);
  constexpr double kSlope = -2.0 * kGaussianRate * tissue::kProfileScale;
  V weight = profileScaled(gauss);
  V slope = hn::Mul(hn::Set(d, static_cast<float>(kSlope)), gauss);
  if constexpr (!kAllInside) {
    const M acts = hn::And(region, hn::Lt(q2, hn::Set(d, 1.0f)));
    weight = hn::IfThenElseZero(acts, weight);
    slope = hn::IfThenElseZero(acts, slope);
  }
  const V3 across = scaled(hn::Mul(slope, at.t), broadcast(part.across));
  const V3 flat = mulAdd(hn::Mul(slope, at.s), broadcast(part.along), across);
  if constexpr (kLevel) return {weight, flat};
  const V up = hn::CopySign(hn::Mul(rise, hn::Set(d, part.slope)), height);
  return {weight, mulAdd(hn::Mul(slope, up), facing, flat)};
}

/// One contact: cof(F) n written out. The press a = amplitude times the contact's normal is orthogonal to both
/// gradients u (of the press) and v (of the drag b), so that cof(F) n = (1 + b.v) (n - (a.n) u) - ((b.n) - (a.n) (b.u))
/// v. kWhole: the vertices are in the region; with a press alone that is its ellipse.
template <bool kDrags, bool kWhole>
HWY_INLINE void moveByOne(const ContactLanes& contact, const V3& position, M region, V3& displacement, V3& normal) {
  const V3 offset = sub(position, broadcast(contact.anchor));
  const V3 a = broadcast(contact.normal.shift);
  const Profile press = profileOf<true, (kWhole && !kDrags)>(contact, contact.normal, offset, region);
  const V a_n = dot(a, normal);
  const V3 pressed = mulSub(a_n, press.gradient, normal);
  displacement = scaled(press.weight, a);
  if constexpr (!kDrags) {
    normal = pressed;
    return;
  }
  const Lanes d;
  const V3 b = broadcast(contact.tangential.shift);
  const Profile drag = profileOf<true, false>(contact, contact.tangential, offset, region);
  const V stretch = hn::Add(dot(b, drag.gradient), hn::Set(d, 1.0f));
  const V tilt = mulSub(a_n, dot(b, press.gradient), dot(b, normal));
  displacement = mulAdd(drag.weight, b, displacement);
  normal = mulSub(tilt, drag.gradient, scaled(stretch, pressed));
}

template <bool kLevel>
HWY_INLINE void addPart(const ContactLanes& contact, const PartLanes& part, const V3& offset, M region,
                        Motion& motion) {
  if (part.outside != 0.0f) return;  // does not act
  const Profile profile = profileOf<kLevel, false>(contact, part, offset, region);
  const V3 shift = broadcast(part.shift);
  motion.displacement = mulAdd(profile.weight, shift, motion.displacement);
  motion.row_x = mulAdd(shift.x, profile.gradient, motion.row_x);
  motion.row_y = mulAdd(shift.y, profile.gradient, motion.row_y);
  motion.row_z = mulAdd(shift.z, profile.gradient, motion.row_z);
}

template <bool kLevel>
HWY_INLINE void moveByMany(std::span<const ContactOnBlock> contacts, const V3& position, size_t lane, V3& displacement,
                           V3& normal) {
  Motion motion = noMotion();
  for (const ContactOnBlock& on : contacts) {
    const ContactLanes& contact = *on.mover;
    const M region = maskAt(on.region, lane);
    const V3 offset = sub(position, broadcast(contact.anchor));
    if (contact.layered) {
      addLayeredPress<kLevel>(contact, offset, region, motion);
      addLayeredDrag<kLevel>(contact, offset, region, motion);
    } else {
      addPart<kLevel>(contact, contact.normal, offset, region, motion);
      addPart<kLevel>(contact, contact.tangential, offset, region, motion);
    }
  }
  displacement = motion.displacement;
  turn(motion, normal);
}

HWY_INLINE V inverseRoot(V x) { return hn::Div(hn::Set(Lanes(), 1.0f), hn::Sqrt(x)); }

/// The normal made unit; the rest normal where it vanishes (skin folded flat).
HWY_INLINE V3 unitOr(const V3& normal, const V3& rest) {
  const V flat = hn::Set(Lanes(), 1e-30f);
  const V length2 = dot(normal, normal);
  return select(hn::Gt(length2, flat), scaled(inverseRoot(length2), normal), rest);
}

HWY_INLINE void storeRest(const V3& position, const V3& normal, const DeformedBlock& out, size_t lane) {
  const V zero = hn::Zero(Lanes());
  store(position, out.values, lane);
  store(normal, out.values + 3, lane);
  store({zero, zero, zero}, out.values + 6, lane);
}

HWY_INLINE void storeArea(V area, const DeformedBlock& out, size_t lane) {
  if (out.area != nullptr) hn::Store(area, Lanes(), out.area + lane);
}

/// Runs `move(position, lane, displacement, normal)` over the block and writes what it gives for the touched vertices;
/// `normal` comes in as the rest normal and leaves as cof(F) of it. Results go through references: returned structs of
/// vectors are spilled to the stack.
template <class Move>
HWY_INLINE void overBlock(std::uint64_t touched, const RestBlock& rest, const DeformedBlock& out, const Move& move) {
  const V whole = hn::Set(Lanes(), 1.0f);
  for (size_t lane = 0; lane < kBlockVertices; lane += hn::Lanes(Lanes())) {
    const V3 position = load(rest.values, lane);
    const V3 normal = load(rest.values + 3, lane);
    const M mask = maskAt(touched, lane);
    if (hn::AllFalse(Lanes(), mask)) {
      storeRest(position, normal, out, lane);
      storeArea(whole, out, lane);
      continue;
    }
    V3 displacement = position;
    V3 turned = normal;
    move(position, lane, displacement, turned);
    storeArea(hn::IfThenElse(mask, dot(turned, normal), whole), out, lane);
    store(select(mask, add(position, displacement), position), out.values, lane);
    store(select(mask, unitOr(turned, normal), normal), out.values + 3, lane);
    store(displacement, out.values + 6, lane);
  }
}

/// `kMove`: moveByOne or moveByOneLayered.
template <auto kMove>
void displaceByOne(const ContactOnBlock& on, const RestBlock& rest, const DeformedBlock& out) {
  const ContactLanes contact = *on.mover;  // a copy that no store can alias
  overBlock(on.region, rest, out, [&](const V3& position, size_t lane, V3& displacement, V3& normal) HWY_ATTR {
    kMove(contact, position, maskAt(on.region, lane), displacement, normal);
  });
}

template <bool kLevel>
void displaceByMany(std::span<const ContactOnBlock> contacts, const RestBlock& rest, const DeformedBlock& out) {
  std::uint64_t touched = 0;
  for (const ContactOnBlock& on : contacts) touched |= on.region;
  overBlock(touched, rest, out, [&](const V3& position, size_t lane, V3& displacement, V3& normal) HWY_ATTR {
    moveByMany<kLevel>(contacts, position, lane, displacement, normal);
  });
}

void displaceBlock(std::span<const ContactOnBlock> contacts, const RestBlock& rest, const DeformedBlock& out) {
  bool is_level = true;
  for (const ContactOnBlock& on : contacts) is_level = is_level && on.is_level;
  if (!is_level) return displaceByMany<false>(contacts, rest, out);
  if (contacts.size() != 1) return displaceByMany<true>(contacts, rest, out);
  const ContactOnBlock& on = contacts[0];
  if (on.mover->layered) return displaceByOne<moveByOneLayered>(on, rest, out);
  drags(*on.mover) ? displaceByOne<moveByOne<true, false>>(on, rest, out)
                   : displaceByOne<moveByOne<false, false>>(on, rest, out);
}

/// The same over a run of blocks all of whose vertices are touched.
template <class Move>
HWY_INLINE void overWhole(Index blocks, const RestBlock& rest, const DeformedBlock& out, const Move& move) {
  for (Index block = 0; block < blocks; ++block) {
    const size_t first = size_t{block} * kBlockVertices;
    for (size_t lane = first; lane < first + kBlockVertices; lane += hn::Lanes(Lanes())) {
      const V3 position = load(rest.values, lane);
      const V3 normal = load(rest.values + 3, lane);
      V3 displacement = position;
      V3 turned = normal;
      move(position, displacement, turned);
      storeArea(dot(turned, normal), out, lane);
      store(add(position, displacement), out.values, lane);
      store(unitOr(turned, normal), out.values + 3, lane);
      store(displacement, out.values + 6, lane);
    }
  }
}

template <auto kMove>
void displaceWholeByOne(const ContactLanes& lanes, Index blocks, const RestBlock& rest, const DeformedBlock& out) {
  const ContactLanes contact = lanes;  // a copy that no store can alias
  const M everyone = hn::FirstN(Lanes(), hn::Lanes(Lanes()));
  overWhole(blocks, rest, out, [&](const V3& position, V3& displacement, V3& normal) HWY_ATTR {
    kMove(contact, position, everyone, displacement, normal);
  });
}

void displaceWholeBlocks(const ContactLanes& contact, Index blocks, const RestBlock& rest, const DeformedBlock& out) {
  if (contact.layered) return displaceWholeByOne<moveByOneLayered>(contact, blocks, rest, out);
  drags(contact) ? displaceWholeByOne<moveByOne<true, true>>(contact, blocks, rest, out)
                 : displaceWholeByOne<moveByOne<false, true>>(contact, blocks, rest, out);
}

std::uint64_t doubtfulVertices(const ShearLanes& shear, const FoldBlock& block) {
  const Lanes d;
  const V one = hn::Set(d, 1.0f);
  const V half = hn::Set(d, 0.5f);
  const V press = hn::Set(d, shear.press);
  const V drag = hn::Set(d, shear.drag);
  const V both = hn::Add(press, drag);
  const V turned = mulAdd(hn::Mul(half, both), both, drag);
  std::uint64_t doubtful = 0;
  for (size_t lane = 0; lane < kBlockVertices; lane += hn::Lanes(d)) {
    const V gradient_mm = hn::Load(d, block.gradient_mm + lane);
    const V crease = hn::Load(d, block.crease + lane);
    // The largest sine between the normals there and the press.
    const V cosine = hn::Max(dot(load(block.rest.values + 3, lane), broadcast(shear.towards)), hn::Zero(d));
    const V at_vertex = hn::Sqrt(hn::Max(mulSub(cosine, cosine, one), hn::Zero(d)));
    const V sine = hn::Min(hn::Add(at_vertex, crease), one);
    const V slope = mulAdd(sine, press, drag);
    const V bend = mulAdd(sine, hn::Set(d, shear.press_bend), hn::Set(d, shear.drag_bend));
    const V off = mulAdd(bend, gradient_mm, hn::Mul(hn::Set(d, shear.jump), slope));
    const V creased = mulAdd(crease, turned, hn::Mul(hn::Min(crease, sine), press));
    const V lost = mulAdd(hn::Add(mulAdd(half, off, one), slope), off, hn::Add(creased, creased));
    const V left = hn::Sub(hn::Load(d, block.area + lane), lost);
    // Written so that NaN is in doubt.
    doubtful |= bitsOf(hn::Not(hn::Gt(left, hn::Set(d, shear.least_area))), lane);
  }
  return doubtful;
}

void restoreBlocks(Index blocks, const RestBlock& rest, const DeformedBlock& out) {
  const size_t vertices = size_t{blocks} * kBlockVertices;
  for (size_t lane = 0; lane < vertices; lane += hn::Lanes(Lanes())) {
    storeRest(load(rest.values, lane), load(rest.values + 3, lane), out, lane);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace palpate::deform
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace palpate::deform {

HWY_EXPORT(insideBlocks);
HWY_EXPORT(verticesInside);
HWY_EXPORT(strainedVertices);
HWY_EXPORT(doubtfulVertices);
HWY_EXPORT(displaceBlock);
HWY_EXPORT(displaceWholeBlocks);
HWY_EXPORT(restoreBlocks);

BlocksInside insideBlocks(const ContactLanes& contact, const TileBounds& bounds) noexcept {
  return HWY_DYNAMIC_DISPATCH(insideBlocks)(contact, bounds);
}

VerticesInside verticesInside(const ContactLanes& contact, const RestBlock& rest, BlockSeen seen) noexcept {
  return HWY_DYNAMIC_DISPATCH(verticesInside)(contact, rest, seen);
}

std::uint64_t strainedVertices(std::span<const ContactLanes> contacts, const EdgeBlock& edge, std::uint64_t of,
                               float most_mm) noexcept {
  return HWY_DYNAMIC_DISPATCH(strainedVertices)(contacts, edge, of, most_mm);
}

std::uint64_t doubtfulVertices(const ShearLanes& shear, const FoldBlock& block) noexcept {
  return HWY_DYNAMIC_DISPATCH(doubtfulVertices)(shear, block);
}

void displaceBlock(std::span<const ContactOnBlock> contacts, const RestBlock& rest, const DeformedBlock& out) noexcept {
  HWY_DYNAMIC_DISPATCH(displaceBlock)(contacts, rest, out);
}

void displaceWholeBlocks(const ContactLanes& contact, Index blocks, const RestBlock& rest,
                         const DeformedBlock& out) noexcept {
  HWY_DYNAMIC_DISPATCH(displaceWholeBlocks)(contact, blocks, rest, out);
}

void restoreBlocks(Index blocks, const RestBlock& rest, const DeformedBlock& out) noexcept {
  HWY_DYNAMIC_DISPATCH(restoreBlocks)(blocks, rest, out);
}

}  // namespace palpate::deform
#endif

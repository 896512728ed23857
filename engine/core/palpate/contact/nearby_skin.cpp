// How far a point is from a triangle, at least, without a branch and without a corner: as far as from its plane and, in
// that plane, as far as beyond the farthest of its edges. That is the distance but for places beyond a corner.
//
// Floats count from the middle of a block, so that kFloatSlack of the block and of the reach covers every rounding: of
// the planes, of the point, of the sums. That is 20 nm under a fingertip, less than the share of a radius (kTight) by
// which a sphere that stands on one place clears the limit it is asked for; so hardly any triangle is listed in vain.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "palpate/contact/nearby_skin.cpp"
#include <hwy/foreach_target.h>
// The order matters: foreach_target compiles this file once more for every further instruction set.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "palpate/contact/nearby_skin.h"

#ifndef PALPATE_FLOAT_SLACK
#define PALPATE_FLOAT_SLACK
namespace palpate::contact {
/// Relative to the farthest coordinate: more than all rounding in a distance between floats.
inline constexpr float kFloatSlack = 1e-6f;
}  // namespace palpate::contact
#endif

HWY_BEFORE_NAMESPACE();
namespace palpate::contact::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kSkinLanes>;
using V = hn::Vec<F>;

template <class Mask>
HWY_INLINE std::uint32_t bitsOf(F d, Mask mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  return bits[0];
}

/// Height of the point above the planes of the lanes from `lane` on.
HWY_INLINE V heightOver(const SkinBlock::Plane& plane, V x, V y, V z, int lane) {
  const F d;
  const V sum =
      hn::Add(hn::Add(hn::Mul(hn::Load(d, plane.normal[0] + lane), x), hn::Mul(hn::Load(d, plane.normal[1] + lane), y)),
              hn::Mul(hn::Load(d, plane.normal[2] + lane), z));
  return hn::Sub(sum, hn::Load(d, plane.offset + lane));
}

/// Lanes of the block that may be nearer than the square root of `limit2`.
HWY_INLINE std::uint32_t nearLanes(const SkinBlock& block, V x, V y, V z, float limit2, int lane) {
  const F d;
  const V height = heightOver(block.face, x, y, z, lane);
  V beyond = hn::Zero(d);
  for (const SkinBlock::Plane& edge : block.edges) beyond = hn::Max(beyond, heightOver(edge, x, y, z, lane));
  const V distance2 = hn::Add(hn::Mul(height, height), hn::Mul(beyond, beyond));
  return bitsOf(d, hn::Lt(distance2, hn::Set(d, limit2))) << lane;
}

/// Blocks from `first` on whose boxes may be nearer than the square root of `limit2`.
HWY_INLINE std::uint32_t nearBlocks(const NearbySkin& skin, const float* point, float limit2, int first) {
  const F d;
  const V zero = hn::Zero(d);
  V distance2 = zero;
  for (int axis = 0; axis < 3; ++axis) {
    V along = hn::Neg(hn::Load(d, skin.centre[axis] + first));
    for (int i = 0; i < 3; ++i) {
      along = hn::Add(along, hn::Mul(hn::Load(d, skin.axes[axis][i] + first), hn::Set(d, point[i])));
    }
    // Above the one, beside the others.
    const V gap = axis == 0 ? along : hn::Sub(hn::Abs(along), hn::Load(d, skin.half[axis] + first));
    const V outside = hn::Max(gap, zero);
    distance2 = hn::Add(distance2, hn::Mul(outside, outside));
  }
  return bitsOf(d, hn::Lt(distance2, hn::Set(d, limit2)));
}

/// How many triangles may be nearer to the point, which is given from the skin's middle too; -1 when the list is too
/// short for them.
int nearTriangles(const NearbySkin& skin, const Vec3& point, const float* from_middle, float reach, SkinList& list) {
  const F d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const float limit = reach * (1.0f + kFloatSlack);
  // Boxes count from the middle of all: their coordinates are as large as the reach and a block more.
  const float limit_of_boxes = limit + 4.0f * kFloatSlack * static_cast<float>(skin.reach) + skin.slack;
  list.count = 0;
  for (int first = 0; first < skin.blocks; first += lanes) {
    for (std::uint32_t near = nearBlocks(skin, from_middle, limit_of_boxes * limit_of_boxes, first); near != 0;
         near &= near - 1) {
      const auto after_first = static_cast<std::size_t>(std::countr_zero(near));
      const std::uint32_t b = skin.block[static_cast<std::size_t>(first) + after_first];
      const SkinBlock& block = skin.planes->blocks[b];
      const V x = hn::Set(d, static_cast<float>(point.x() - block.middle.x()));
      const V y = hn::Set(d, static_cast<float>(point.y() - block.middle.y()));
      const V z = hn::Set(d, static_cast<float>(point.z() - block.middle.z()));
      const float limit_here = limit + block.slack;
      std::uint32_t bits = 0;
      for (int lane = 0; lane < kSkinLanes; lane += lanes) {
        bits |= nearLanes(block, x, y, z, limit_here * limit_here, lane);
      }
      for (; bits != 0; bits &= bits - 1) {
        if (list.count == SkinList::kMax) return -1;
        list.records[static_cast<std::size_t>(list.count++)] =
            b * kSkinLanes + static_cast<Index>(std::countr_zero(bits));
      }
    }
  }
  return list.count;
}

}  // namespace palpate::contact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace palpate::contact {

HWY_EXPORT(nearTriangles);

namespace {

/// Squared sine below which a triangle's normal is not trusted.
constexpr double kNoArea = 1e-12;
/// How far lanes are that hold no triangle, mm: their squares are still floats.
constexpr double kNowhere = 1e18;
/// A surface or a device farther out than this is not gathered, mm.
constexpr double kFarthest = 1e15;

void setPlane(SkinBlock::Plane& plane, std::size_t lane, const Vec3& normal, double offset) {
  for (int axis = 0; axis < 3; ++axis) plane.normal[axis][lane] = static_cast<float>(normal[axis]);
  plane.offset[lane] = static_cast<float>(offset);
}

/// Corners from the block's middle.
void setPlanes(const std::array<Vec3, 3>& at, SkinBlock& block, std::size_t lane) {
  const std::array<Vec3, 3> along = {at[1] - at[0], at[2] - at[1], at[0] - at[2]};
  const Vec3 normal = along[0].cross(along[1]);
  const double area2 = normal.squaredNorm();
  const bool has_area = area2 > kNoArea * along[0].squaredNorm() * along[1].squaredNorm();
  const Vec3 unit = has_area ? Vec3(normal / std::sqrt(area2)) : Vec3::Zero();
  setPlane(block.face, lane, unit, unit.dot(at[0]));
  for (int edge = 0; edge < 3; ++edge) {
    const Vec3 outwards = has_area ? Vec3(along[edge].cross(unit) / along[edge].norm()) : Vec3::Zero();
    setPlane(block.edges[edge], lane, outwards, outwards.dot(at[edge]));
  }
}

/// The records of a block.
std::span<const tree::TriangleRecord> blockRecords(const tree::TriangleTree& tree, std::size_t block) {
  const std::size_t first = block * kSkinLanes;
  return std::span(tree.records).subspan(first, std::min<std::size_t>(kSkinLanes, tree.records.size() - first));
}

/// How far corners reach along a direction, from the block's middle.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Extent extentAlong(std::span<const tree::TriangleRecord> records, const Vec3& middle, const Vec3& direction) {
  Extent extent;
  for (const tree::TriangleRecord& record : records) {
    for (const Vec3& corner : record.corners) {
      const double at = direction.dot(corner - middle);
      extent.low = std::min(extent.low, at);
      extent.high = std::max(extent.high, at);
    }
  }
  return extent;
}

/// How the triangles face on the whole, a unit vector.
Vec3 meanNormal(std::span<const tree::TriangleRecord> records) {
  Vec3 sum = Vec3::Zero();
  for (const tree::TriangleRecord& r : records) sum += mesh::areaVector2(r.corners[0], r.corners[1], r.corners[2]);
  sum.stableNormalize();
  return sum.squaredNorm() > 0.5 ? sum : Vec3::UnitZ();
}

/// Chooses the box with the smallest area among several turned about the facing.
void setBox(std::span<const tree::TriangleRecord> records, SkinBlock& block) {
  // Within a right angle; a box turned by a right angle is the same.
  constexpr std::array<std::array<double, 2>, 6> kTurns = {{{1, 0}, {3, 1}, {2, 1}, {1, 1}, {1, 2}, {1, 3}}};
  const Vec3 facing = meanNormal(records);
  const Vec3 across = facing.unitOrthogonal();
  const Vec3 along = facing.cross(across);
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& [c, s] : kTurns) {
    const Vec3 one = (c * across + s * along).normalized();
    const Vec3 other = facing.cross(one);
    const Extent x = extentAlong(records, block.middle, one);
    const Extent y = extentAlong(records, block.middle, other);
    const double area = (x.high - x.low) * (y.high - y.low);
    if (!(area < smallest)) continue;
    smallest = area;
    block.axes = {facing, one, other};
    block.centre = {extentAlong(records, block.middle, facing).high, 0.5 * (x.low + x.high), 0.5 * (y.low + y.high)};
    block.half = {0.0, 0.5 * (x.high - x.low), 0.5 * (y.high - y.low)};
  }
}

void fillBlock(std::span<const tree::TriangleRecord> records, SkinBlock& block) {
  Box3 box;
  for (const tree::TriangleRecord& record : records) {
    for (const Vec3& corner : record.corners) box.extend(corner);
  }
  block.middle = box.center();
  block.slack = kFloatSlack * static_cast<float>(box.diagonal().norm());
  setBox(records, block);
  for (std::size_t lane = 0; lane < kSkinLanes; ++lane) {
    if (lane >= records.size()) {
      setPlane(block.face, lane, Vec3::Zero(), kNowhere);
      for (SkinBlock::Plane& edge : block.edges) setPlane(edge, lane, Vec3::Zero(), 0.0);
      continue;
    }
    const auto& corners = records[lane].corners;
    setPlanes({corners[0] - block.middle, corners[1] - block.middle, corners[2] - block.middle}, block, lane);
  }
}

/// False when `skin` is full.
bool addBlock(std::uint32_t b, NearbySkin& skin) {
  if (skin.blocks > 0 && skin.block[static_cast<std::size_t>(skin.blocks - 1)] == b) return true;
  if (skin.blocks == NearbySkin::kMaxBlocks) return false;
  const SkinBlock& block = skin.planes->blocks[b];
  const Vec3 middle = block.middle - skin.middle;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 3; ++i) skin.axes[axis][i][skin.blocks] = static_cast<float>(block.axes[axis][i]);
    skin.centre[axis][skin.blocks] = static_cast<float>(block.axes[axis].dot(middle) + block.centre[axis]);
    skin.half[axis][skin.blocks] = static_cast<float>(block.half[axis]);
  }
  skin.slack = std::max(skin.slack, 4.0f * block.slack);
  skin.block[static_cast<std::size_t>(skin.blocks++)] = b;
  return true;
}

bool addLeaf(const tree::ChildLink& link, SkinBranch branch, NearbySkin& skin) {
  if (skin.leaf_count == NearbySkin::kMaxLeaves) return false;
  branch.node = link.firstTriangle();
  skin.leaves[static_cast<std::size_t>(skin.leaf_count++)] = branch;
  const std::uint32_t last = (link.firstTriangle() + link.triangleCount() - 1) / kSkinLanes;
  for (std::uint32_t b = link.firstTriangle() / kSkinLanes; b <= last; ++b) {
    if (!addBlock(b, skin)) return false;
  }
  return true;
}

/// A child that is still to be looked into.
struct OpenBranch {
  tree::ChildLink link;
  SkinBranch branch;
};

/// In the order of records.
bool gatherBelow(const tree::TriangleTree& tree, const tree::PointQuery& query, float limit, NearbySkin& skin) {
  std::array<OpenBranch, tree::detail::kMaxPending> open;
  open[0] = {tree::ChildLink::toNode(0), {}};
  for (std::size_t size = 1; size > 0;) {
    OpenBranch here = open[--size];
    if (here.link.isLeaf()) {
      if (!addLeaf(here.link, here.branch, skin)) return false;
      continue;
    }
    if (skin.node_count == NearbySkin::kMaxNodes) return false;
    const auto index = static_cast<std::uint16_t>(skin.node_count++);
    here.branch.node = here.link.node();
    skin.nodes[index] = here.branch;
    const tree::WideNode& node = tree.nodes[here.link.node()];
    float bounds[tree::kNodeWidth];
    tree::squaredDistanceBounds(node, query, bounds);
    for (int slot = tree::kNodeWidth - 1; slot >= 0; --slot) {
      if (!(bounds[slot] <= limit)) continue;
      const auto level = static_cast<std::uint8_t>(here.branch.level + 1);
      open[size++] = {node.children[slot], {0, index, static_cast<std::uint8_t>(slot), level}};
    }
  }
  return true;
}

/// The share of the margin by which the skin is gathered ahead of a moving finger.
constexpr double kShareAhead = 0.5;
/// Blocks that are gathered where there is a choice: of fewer the margin grows, of more it shrinks.
constexpr int kFewBlocks = 30;
constexpr int kManyBlocks = 60;
constexpr double kGrow = 1.25;
constexpr double kShrink = 0.75;
/// To gather costs about as much as so many pads that ask the tree in one tick, and has to last for as many.
constexpr double kGatheringCost = 8.0;

/// The leaf that holds the record: the last that does not begin after it.
const SkinBranch& findLeaf(const NearbySkin& skin, Index record) {
  const auto* end = skin.leaves.data() + skin.leaf_count;
  return *(std::upper_bound(skin.leaves.data() + 1, end, record,
                            [](Index wanted, const SkinBranch& leaf) { return wanted < leaf.node; }) -
           1);
}

}  // namespace

std::shared_ptr<const SkinPlanes> planesOf(std::shared_ptr<const SurfaceGeometry> geometry) {
  auto planes = std::make_shared<SkinPlanes>();
  const tree::TriangleTree& tree = geometry->tree;
  planes->blocks.resize((tree.records.size() + kSkinLanes - 1) / kSkinLanes);
  for (std::size_t b = 0; b < planes->blocks.size(); ++b) fillBlock(blockRecords(tree, b), planes->blocks[b]);
  planes->geometry = std::move(geometry);
  return planes;
}

bool gatherSkin(const SkinPlanes& planes, const Vec3& middle, double reach, NearbySkin& skin) noexcept {
  const tree::TriangleTree& tree = planes.geometry->tree;
  skin.planes = nullptr;
  skin.middle = middle;
  skin.reach = reach;
  skin.blocks = skin.leaf_count = skin.node_count = 0;
  skin.slack = 0.0f;
  if (!((middle - tree.center).norm() + reach + tree.diagonal < kFarthest)) return false;
  skin.planes = &planes;
  const float limit = tree::detail::unitSquaredDistance(tree, reach * reach);
  if (!gatherBelow(tree, tree::detail::pointQuery(tree, middle), limit, skin)) {
    skin.planes = nullptr;
    return false;
  }
  for (int b = skin.blocks; b < NearbySkin::kMaxBlocks && b % kSkinLanes != 0; ++b) {  // the lanes that are left over
    for (auto& axis : skin.axes) axis[0][b] = axis[1][b] = axis[2][b] = 0.0f;
    for (auto& half : skin.half) half[b] = 0.0f;
    for (auto& centre : skin.centre) centre[b] = static_cast<float>(-kNowhere);
  }
  return true;
}

double profitableMargin(std::size_t pads, double step_mm) noexcept {
  // The rest of the margin must hold for the next tick, too.
  const double ticks = kGatheringCost / static_cast<double>(pads) + 2.0;
  return ticks * step_mm / (1.0 + kShareAhead);
}

double adaptedMargin(const NearbySkin& gathered, double margin_mm) noexcept {
  if (gathered.blocks > 0 && gathered.blocks < kFewBlocks) return kGrow * margin_mm;
  return gathered.blocks > kManyBlocks ? kShrink * margin_mm : margin_mm;
}

Vec3 gatheredAhead(const Vec3& motion, double margin_mm) noexcept {
  constexpr double kTicksAhead = 20.0;
  const double ahead = kTicksAhead * motion.norm();
  const double most = kShareAhead * margin_mm;
  return ahead > most ? Vec3(motion * (kTicksAhead * most / ahead)) : Vec3(kTicksAhead * motion);
}

bool listNearer(const NearbySkin* skin, const Vec3& point, double reach, SkinList& list) noexcept {
  if (skin == nullptr || !covers(*skin, point, reach)) return false;
  const Vec3 way = point - skin->middle;
  const float from_middle[3] = {static_cast<float>(way.x()), static_cast<float>(way.y()), static_cast<float>(way.z())};
  return HWY_DYNAMIC_DISPATCH(nearTriangles)(*skin, point, from_middle, static_cast<float>(reach), list) >= 0;
}

bool visitedBefore(const NearbySkin& skin, const tree::PointQuery& query, Index one, Index other) noexcept {
  const SkinBranch* a = &findLeaf(skin, one);
  const SkinBranch* b = &findLeaf(skin, other);
  if (a == b) return one < other;
  while (a->level > b->level) a = &skin.nodes[a->parent];
  while (b->level > a->level) b = &skin.nodes[b->parent];
  while (a->parent != b->parent) {
    a = &skin.nodes[a->parent];
    b = &skin.nodes[b->parent];
  }
  float bounds[tree::kNodeWidth];
  const tree::TriangleTree& tree = skin.planes->geometry->tree;
  tree::squaredDistanceBoundsOfMinima(tree.nodes[skin.nodes[a->parent].node], query, bounds);
  // Among equally near children the last one is on top (tree::detail::pushNearestLast).
  return bounds[a->slot] < bounds[b->slot] || (bounds[a->slot] == bounds[b->slot] && a->slot > b->slot);
}

tree::Crossing firstCrossing(const Surface& surface, const NearbySkin* skin, const Vec3& from,
                             const Vec3& to) noexcept {
  constexpr double kRounding = 1.0 + 1e-9;
  const tree::TriangleTree& tree = surface.geometry->tree;
  SkinList list;
  const bool is_known = listNearer(skin, to, kRounding * (to - from).norm(), list);
  return is_known ? firstFrontCrossingAmong(tree, list.all(), from, to) : firstFrontCrossing(tree, from, to);
}

}  // namespace palpate::contact
#endif

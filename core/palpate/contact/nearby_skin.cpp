// A distance to a triangle without a branch: to the plane where the point is over the triangle, else to the nearest of
// its edges.
//
// Floats count from the middle of what is near, so that kFloatSlack of its size covers every rounding: of the corners,
// of the point, of the sums. That is 20 nm under a fingertip, less than the share of a radius (kTight) by which a sphere
// that stands on one place clears the limit it is asked for; so hardly any triangle is listed in vain.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "palpate/contact/nearby_skin.cpp"
#include <hwy/foreach_target.h>
// The order matters: foreach_target compiles this file once more for every further instruction set.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "palpate/contact/nearby_skin.h"

HWY_BEFORE_NAMESPACE();
namespace palpate::contact::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kSkinLanes>;
using V = hn::Vec<F>;

HWY_INLINE V dot(V ax, V ay, V az, V bx, V by, V bz) {
  return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
}

template <class Mask>
HWY_INLINE std::uint32_t bitsOf(F d, Mask mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  return bits[0];
}

/// Lanes of the block that may be nearer than the square root of `limit2`.
HWY_INLINE std::uint32_t nearLanes(const SkinBlock& block, const float* point, float limit2, int lane) {
  const F d;
  const auto zero = hn::Zero(d);
  const auto at = [&](int corner, int axis) {
    return hn::Sub(hn::Set(d, point[axis]), hn::Load(d, block.corners[corner][axis] + lane));
  };
  const V nx = hn::Load(d, block.normal[0] + lane);
  const V ny = hn::Load(d, block.normal[1] + lane);
  const V nz = hn::Load(d, block.normal[2] + lane);
  const V ax = at(0, 0), ay = at(0, 1), az = at(0, 2);
  const V bx = at(1, 0), by = at(1, 1), bz = at(1, 2);
  const V cx = at(2, 0), cy = at(2, 1), cz = at(2, 2);
  const V height = dot(ax, ay, az, nx, ny, nz);
  const V limit = hn::Set(d, limit2);
  // If the plane is far enough, so is the triangle.
  const V height2 = hn::Mul(height, height);
  const auto plane_far = hn::Ge(height2, limit);
  if (hn::AllTrue(d, plane_far)) return 0u;
  V nearest = hn::Set(d, std::numeric_limits<float>::infinity());
  auto over = hn::Eq(zero, zero);
  // p: from the edge's start to the point; q: from its end.
  const auto along = [&](V px, V py, V pz, V qx, V qy, V qz) {
    const V ex = hn::Sub(px, qx), ey = hn::Sub(py, qy), ez = hn::Sub(pz, qz);
    const V length2 = hn::Max(dot(ex, ey, ez, ex, ey, ez), hn::Set(d, std::numeric_limits<float>::min()));
    const V share = hn::Min(hn::Max(hn::Div(dot(px, py, pz, ex, ey, ez), length2), zero), hn::Set(d, 1.0f));
    const V wx = hn::Sub(px, hn::Mul(share, ex));
    const V wy = hn::Sub(py, hn::Mul(share, ey));
    const V wz = hn::Sub(pz, hn::Mul(share, ez));
    nearest = hn::Min(nearest, dot(wx, wy, wz, wx, wy, wz));
    // n . (e x p)
    const V side = dot(nx, ny, nz, hn::Sub(hn::Mul(ey, pz), hn::Mul(ez, py)),
                       hn::Sub(hn::Mul(ez, px), hn::Mul(ex, pz)), hn::Sub(hn::Mul(ex, py), hn::Mul(ey, px)));
    over = hn::And(over, hn::Ge(side, zero));
  };
  along(ax, ay, az, bx, by, bz);
  along(bx, by, bz, cx, cy, cz);
  along(cx, cy, cz, ax, ay, az);
  const auto far = hn::Or(plane_far, hn::And(hn::Ge(nearest, limit), hn::Not(over)));
  return ~bitsOf(d, far) & ((1u << hn::Lanes(d)) - 1u);
}

/// Blocks from `first` on whose boxes may be nearer than `reach`.
HWY_INLINE std::uint32_t nearBlocks(const NearbySkin& skin, const float* point, float reach, int first) {
  const F d;
  V distance2 = hn::Zero(d);
  for (int axis = 0; axis < 3; ++axis) {
    const V at = hn::Set(d, point[axis]);
    const V below = hn::Sub(hn::Load(d, skin.low[axis] + first), at);
    const V above = hn::Sub(at, hn::Load(d, skin.high[axis] + first));
    const V gap = hn::Max(hn::Max(below, above), hn::Zero(d));
    distance2 = hn::Add(distance2, hn::Mul(gap, gap));
  }
  const V limit = hn::Add(hn::Set(d, reach), hn::Load(d, skin.slack + first));
  return bitsOf(d, hn::Lt(distance2, hn::Mul(limit, limit)));
}

/// How many triangles may be nearer; -1 when the list is too short for them.
int nearTriangles(const NearbySkin& skin, const float* point, float reach, SkinList& list) {
  const F d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  list.count = 0;
  for (int first = 0; first < skin.blocks; first += lanes) {
    for (std::uint32_t near = nearBlocks(skin, point, reach, first); near != 0; near &= near - 1) {
      const int b = first + std::countr_zero(near);
      const float limit = reach + skin.slack[b];
      for (int lane = 0; lane < kSkinLanes; lane += lanes) {
        std::uint32_t bits = nearLanes(skin.block[b], point, limit * limit, lane);
        for (; bits != 0; bits &= bits - 1) {
          if (list.count == SkinList::kMax) return -1;
          list.places[list.count++] = static_cast<std::uint16_t>(b * kSkinLanes + lane + std::countr_zero(bits));
        }
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

/// Of the farthest coordinate: more than all roundings of a distance between floats.
constexpr double kFloatSlack = 1.5e-6;
/// Squared sine below which a triangle's normal is not trusted.
constexpr double kNoArea = 1e-12;
/// A box that no point is near to.
constexpr float kNowhere = 1e18f;

/// Fills a NearbySkin block by block.
class Gatherer {
 public:
  Gatherer(const tree::TriangleTree& tree, NearbySkin& skin) : tree_(tree), skin_(skin) {}

  /// False when it does not fit.
  bool addLeaf(const tree::ChildLink& link, std::uint16_t parent, std::uint8_t slot) {
    if (skin_.leaf_count == NearbySkin::kMaxLeaves) return false;
    const auto leaf = static_cast<std::uint16_t>(skin_.leaf_count++);
    skin_.leaves[leaf] = {0, parent, slot, static_cast<std::uint8_t>(skin_.nodes[parent].level + 1)};
    const Index end = link.firstTriangle() + link.triangleCount();
    for (Index t = link.firstTriangle(); t < end; ++t) {
      if (!addTriangle(t, leaf)) return false;
    }
    return true;
  }

  /// Lanes that are left over count as far away.
  void finish() {
    const int used = skin_.triangles % kSkinLanes;
    if (used != 0) {
      for (int lane = used; lane < kSkinLanes; ++lane) putAway(skin_.block[skin_.blocks - 1], lane);
    }
    for (int b = skin_.blocks; b < NearbySkin::kMaxBlocks && b % kSkinLanes != 0; ++b) {
      for (int axis = 0; axis < 3; ++axis) skin_.low[axis][b] = skin_.high[axis][b] = kNowhere;
      skin_.slack[b] = 0.0f;
    }
  }

 private:
  static void putAway(SkinBlock& block, int lane) {
    for (auto& corner : block.corners) {
      for (auto& axis : corner) axis[lane] = kNowhere;
    }
    for (int axis = 0; axis < 3; ++axis) block.normal[axis][lane] = axis == 2 ? 1.0f : 0.0f;
    block.records[lane] = kNoIndex;
    block.leaves[lane] = 0;
  }

  bool addTriangle(Index t, std::uint16_t leaf) {
    const int lane = skin_.triangles % kSkinLanes;
    if (lane == 0) {
      if (skin_.blocks == NearbySkin::kMaxBlocks) return false;
      startBlock(skin_.blocks++);
    }
    ++skin_.triangles;
    const int b = skin_.blocks - 1;
    SkinBlock& block = skin_.block[b];
    block.records[lane] = t;
    block.leaves[lane] = leaf;
    const auto& corners = tree_.records[t].corners;
    const Vec3 ab = corners[1] - corners[0];
    const Vec3 ac = corners[2] - corners[0];
    const Vec3 normal = ab.cross(ac);
    const double area2 = normal.squaredNorm();
    const bool has_area = area2 > kNoArea * ab.squaredNorm() * ac.squaredNorm();
    const double per_length = has_area ? 1.0 / std::sqrt(area2) : 0.0;
    float farthest = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
      float& low = skin_.low[axis][b];
      float& high = skin_.high[axis][b];
      for (int c = 0; c < 3; ++c) {
        const auto value = static_cast<float>(corners[c][axis] - skin_.middle[axis]);
        block.corners[c][axis][lane] = value;
        low = std::min(low, value);
        high = std::max(high, value);
        farthest = std::max(farthest, std::abs(value));
      }
      block.normal[axis][lane] = static_cast<float>(per_length * normal[axis]);
    }
    skin_.slack[b] = std::max(skin_.slack[b], static_cast<float>(kFloatSlack) * farthest);
    return true;
  }

  void startBlock(int b) {
    for (int axis = 0; axis < 3; ++axis) {
      skin_.low[axis][b] = std::numeric_limits<float>::infinity();
      skin_.high[axis][b] = -std::numeric_limits<float>::infinity();
    }
    skin_.slack[b] = static_cast<float>(kFloatSlack * skin_.reach);
  }

  const tree::TriangleTree& tree_;
  NearbySkin& skin_;
};

/// Triangles beyond this many are not counted in floats any more.
constexpr double kFarthestFloat = 1e15;

}  // namespace

bool gatherSkin(const tree::TriangleTree& tree, const Vec3& middle, double reach, NearbySkin& skin) noexcept {
  skin.known = false;
  skin.middle = middle;
  skin.reach = reach;
  skin.blocks = skin.triangles = skin.leaf_count = skin.node_count = 0;
  if (!((middle - tree.center).norm() + reach + tree.diagonal < kFarthestFloat)) return false;
  const tree::PointQuery query = tree::detail::pointQuery(tree, middle);
  const float limit = tree::detail::unitSquaredDistance(tree, reach * reach);
  Gatherer gatherer(tree, skin);
  std::array<std::uint16_t, NearbySkin::kMaxNodes> open;  // of skin.nodes, still to be looked into
  skin.nodes[skin.node_count++] = {};
  open[0] = 0;
  for (int size = 1; size > 0;) {
    const std::uint16_t here = open[--size];
    const tree::WideNode& node = tree.nodes[skin.nodes[here].node];
    float bounds[tree::kNodeWidth];
    tree::squaredDistanceBounds(node, query, bounds);
    for (std::uint8_t slot = 0; slot < tree::kNodeWidth; ++slot) {
      if (!(bounds[slot] <= limit)) continue;
      const tree::ChildLink child = node.children[slot];
      if (child.isLeaf()) {
        if (!gatherer.addLeaf(child, here, slot)) return false;
        continue;
      }
      if (skin.node_count == NearbySkin::kMaxNodes) return false;
      const auto level = static_cast<std::uint8_t>(skin.nodes[here].level + 1);
      skin.nodes[skin.node_count] = {child.node(), here, slot, level};
      open[size++] = static_cast<std::uint16_t>(skin.node_count++);
    }
  }
  gatherer.finish();
  skin.known = true;
  return true;
}

bool listNearer(const NearbySkin* skin, const Vec3& point, double reach, SkinList& list) noexcept {
  if (skin == nullptr || !covers(*skin, point, reach)) return false;
  const Vec3 from_middle = point - skin->middle;
  const float at[3] = {static_cast<float>(from_middle.x()), static_cast<float>(from_middle.y()),
                       static_cast<float>(from_middle.z())};
  return HWY_DYNAMIC_DISPATCH(nearTriangles)(*skin, at, static_cast<float>(reach), list) >= 0;
}

bool visitedBefore(const tree::TriangleTree& tree, const NearbySkin& skin, const tree::PointQuery& query,
                   std::uint16_t one, std::uint16_t other) noexcept {
  const std::uint16_t leaf = skin.block[one / kSkinLanes].leaves[one % kSkinLanes];
  const std::uint16_t other_leaf = skin.block[other / kSkinLanes].leaves[other % kSkinLanes];
  if (leaf == other_leaf) return recordAt(skin, one) < recordAt(skin, other);
  SkinBranch a = skin.leaves[leaf];
  SkinBranch b = skin.leaves[other_leaf];
  while (a.level > b.level) a = skin.nodes[a.parent];
  while (b.level > a.level) b = skin.nodes[b.parent];
  while (a.parent != b.parent) {
    a = skin.nodes[a.parent];
    b = skin.nodes[b.parent];
  }
  float bounds[tree::kNodeWidth];
  tree::squaredDistanceBoundsOfMinima(tree.nodes[skin.nodes[a.parent].node], query, bounds);
  // Of children equally near the last one lies on top (tree::detail::pushNearestLast).
  return bounds[a.slot] < bounds[b.slot] || (bounds[a.slot] == bounds[b.slot] && a.slot > b.slot);
}

tree::Crossing firstCrossing(const Surface& surface, const NearbySkin* skin, const Vec3& from,
                             const Vec3& to) noexcept {
  const tree::TriangleTree& tree = surface.geometry->tree;
  constexpr double kRounding = 1.0 + 1e-9;
  SkinList list;
  if (!listNearer(skin, to, kRounding * (to - from).norm(), list)) return tree::firstFrontCrossing(tree, from, to);
  tree::Crossing first;
  for (int i = 0; i < list.count; ++i) {
    const Index t = recordAt(*skin, list.places[i]);
    tree::Crossing crossing;
    if (!tree::detail::crossingOf(tree.records[t], from, to, crossing)) continue;
    crossing.triangle = t;
    const bool earlier = first.triangle == kNoIndex || crossing.fraction < first.fraction ||
                         (crossing.fraction == first.fraction && t < first.triangle);
    if (earlier) first = crossing;
  }
  return first;
}

}  // namespace palpate::contact
#endif

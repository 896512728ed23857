// Cracks are found by ways along the normals of triangles that meet the front of other skin within the width.
#include "palpate/contact/narrow_cracks.h"

#include <algorithm>
#include <array>

#include "palpate/base/background.h"
#include "palpate/contact/press.h"
#include "palpate/contact/surface_walk.h"
#include "palpate/mesh/components.h"

namespace palpate::contact {

using tree::TriangleRecord;

namespace {

/// Walls that share a vertex, as at the bottom of a fold, face each other when they are nearly parallel (25 degrees);
/// otherwise every sharp crease of a fine mesh were a crack.
constexpr double kFacingWalls = -0.9;
/// A place at the rim is asked for a little farther in: this share of the width.
constexpr double kOffTheRim = 0.05;
/// Fewer nodes, of 30 triangles each, are looked at by one processor.
constexpr std::size_t kMinSharedNodes = 200;

Vec3 centreOf(const TriangleRecord& record) {
  return (record.corners[0] + record.corners[1] + record.corners[2]) / 3.0;
}

bool shareVertex(const TriangleRecord& one, const TriangleRecord& other) {
  return std::any_of(one.vertices.begin(), one.vertices.end(), [&](Index v) {
    return std::find(other.vertices.begin(), other.vertices.end(), v) != other.vertices.end();
  });
}

/// A triangle that a place of another faces across a crack, or kNoIndex.
Index facedFrom(const tree::TriangleTree& tree, double width, Index triangle, const Vec3& place) noexcept {
  const TriangleRecord& own = tree.records[triangle];
  const Vec3 normal = faceNormal(own);
  const Vec3 end = place + width * normal;
  Index faced = kNoIndex;
  tree::visitTrianglesAlong(tree, place, end, [&](Index other) {
    const TriangleRecord& record = tree.records[other];
    if (faced != kNoIndex || other == triangle) return;
    // The exact test is dear: first what of smooth skin nearly always says no.
    if (mesh::areaVector2(record.corners[0], record.corners[1], record.corners[2]).dot(normal) >= 0.0) return;
    if (shareVertex(own, record) && !(normal.dot(faceNormal(record)) < kFacingWalls)) return;
    tree::Crossing crossing;
    if (tree::detail::crossingOf(record, place, end, crossing)) faced = other;
  });
  return faced;
}

/// Whether other skin within the width is in front of the place and has it in front, in whatever direction: at the
/// corners of a jagged crack the way along the normal misses it.
bool facesAnything(const tree::TriangleTree& tree, double width, Index triangle, const Vec3& place) noexcept {
  constexpr double kInFront = 0.3;  // of the distance: what lies to the side belongs to the bank
  const TriangleRecord& own = tree.records[triangle];
  const Vec3 normal = faceNormal(own);
  const auto is_faced = [&](Index other, const tree::ClosestOnTriangle& closest) {
    const Vec3 way = closest.point - place;
    if (!(way.dot(normal) > kInFront * way.norm())) return false;
    const Vec3 its_normal = faceNormal(tree.records[other]);
    return way.dot(its_normal) < 0.0 &&
           (!shareVertex(own, tree.records[other]) || normal.dot(its_normal) < kFacingWalls);
  };
  return nearestPointIf(tree, place, width, is_faced).triangle != kNoIndex;
}

/// Corners and middles of sides, a little inside.
std::array<Vec3, 6> samplesOf(const TriangleRecord& record) {
  constexpr double kInwards = 0.02;
  const Vec3 centre = centreOf(record);
  std::array<Vec3, 6> samples;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& corner = record.corners[i];
    samples[2 * i] = corner + kInwards * (centre - corner);
    const Vec3 middle = 0.5 * (corner + record.corners[(i + 1) % 3]);
    samples[2 * i + 1] = middle + kInwards * (centre - middle);
  }
  return samples;
}

/// A part of the surface below one child of a node: its box, widened, and its normals.
struct FacingPart {
  std::array<float, 3> low, high;  // unit frame
  std::array<int, 3> facing;
  float squared_length;  // of `facing`
  float spread;          // sine of the widest angle between it and a normal; 2: any
};

FacingPart makeFacingPart(const tree::WideNode& node, int child, float widened) {
  FacingPart part;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    part.low[axis] = node.low[axis][child] - widened;
    part.high[axis] = node.high[axis][child] + widened;
  }
  part.facing = tree::facingVector(node.facing[0][child], node.facing[1][child]);
  const auto& [x, y, z] = part.facing;
  part.squared_length = static_cast<float>(x * x + y * y + z * z);
  part.spread =
      node.spread[child] == tree::kAnySpread ? 2.0f : static_cast<float>(node.spread[child]) * tree::kSpreadStep;
  return part;
}

bool overlap(const FacingPart& part, const tree::WideNode& node, int child) {
  bool apart = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    apart = apart || part.low[axis] > node.high[axis][child] || part.high[axis] < node.low[axis][child];
  }
  return !apart;
}

/// Whether normals of two parts may be more than a right angle apart. The sine of two angles is less than the sum of
/// theirs.
bool mayFace(const FacingPart& one, const FacingPart& other) {
  const auto dot = static_cast<float>(one.facing[0] * other.facing[0] + one.facing[1] * other.facing[1] +
                                      one.facing[2] * other.facing[2]);
  const float spread = one.spread + other.spread;
  return dot <= 0.0f || dot * dot < spread * spread * one.squared_length * other.squared_length;
}

/// Whether a leaf may face other skin near it. Of smooth skin it never does, and nothing more is asked.
bool mayFaceOther(const tree::TriangleTree& tree, const FacingPart& leaf) {
  Index stack[tree::detail::kMaxPending];
  stack[0] = 0;
  for (int size = 1; size > 0;) {
    const tree::WideNode& node = tree.nodes[stack[--size]];
    for (int child = 0; child < tree::kNodeWidth; ++child) {
      if (!overlap(leaf, node, child) || !mayFace(leaf, makeFacingPart(node, child, 0.0f))) continue;
      if (node.children[child].isLeaf()) return true;
      stack[size++] = node.children[child].node();
    }
  }
  return false;
}

/// From what the middles of triangles face the marks spread to triangles that face something with another part.
class CrackSearch {
 public:
  explicit CrackSearch(const Surface& surface)
      : surface_(surface), tree_(surface.geometry->tree), width_(crackWidth(*surface.geometry)) {}

  std::vector<std::uint8_t> find() {
    lookFromMiddles();
    findBorders();
    if (found_.empty()) return {};
    cracked_.assign(tree_.records.size(), 0);
    for (const Index t : found_) mark(t);
    while (!to_spread_.empty()) {
      const Index t = to_spread_.back();
      to_spread_.pop_back();
      for (const Index across : tree_.records[t].neighbours) {
        if (across == kNoIndex || cracked_[across] != 0) continue;
        for (const Vec3& sample : samplesOf(tree_.records[across])) {
          const Index faced = facedFrom(tree_, width_, across, sample);
          if (faced == kNoIndex) continue;
          mark(across);
          mark(faced);
        }
      }
    }
    return std::move(cracked_);
  }

 private:
  void mark(Index triangle) {
    if (cracked_[triangle] != 0) return;
    cracked_[triangle] = 1;
    to_spread_.push_back(triangle);
  }

  void lookFromMiddles() {
    std::vector<Index> faced(tree_.records.size(), kNoIndex);
    const auto widened = static_cast<float>(1.001 * width_ * tree_.to_unit);
    shareOut(tree_.nodes.size(), kMinSharedNodes, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        const tree::WideNode& node = tree_.nodes[n];
        for (int child = 0; child < tree::kNodeWidth; ++child) {
          const bool is_used = node.low[0][child] <= node.high[0][child];
          const tree::ChildLink leaf = node.children[child];
          if (!is_used || !leaf.isLeaf() || !mayFaceOther(tree_, makeFacingPart(node, child, widened))) continue;
          for (Index t = leaf.firstTriangle(); t < leaf.firstTriangle() + leaf.triangleCount(); ++t) {
            faced[t] = facedFrom(tree_, width_, t, centreOf(tree_.records[t]));
          }
        }
      }
    });
    for (Index t = 0; t < faced.size(); ++t) {
      if (faced[t] != kNoIndex) found_.insert(found_.end(), {t, faced[t]});
    }
  }

  /// Sheets that end beside each other.
  void findBorders() {
    for (Index t = 0; t < tree_.records.size(); ++t) {
      const TriangleRecord& record = tree_.records[t];
      for (std::size_t side = 0; side < 3; ++side) {
        if (record.neighbours[side] != kNoIndex) continue;
        const Vec3 middle = 0.5 * (record.corners[side] + record.corners[(side + 1) % 3]);
        const auto is_beside = [&](Index other, const tree::ClosestOnTriangle& closest) {
          return !shareVertex(record, tree_.records[other]) &&
                 onBorder(surface_, {closest.point, other, closest.feature}) &&
                 faceNormal(record).dot(faceNormal(tree_.records[other])) > 0.0;
        };
        const Index other = tree::nearestPointIf(tree_, middle, width_, is_beside).triangle;
        if (other != kNoIndex) found_.insert(found_.end(), {t, other});
      }
    }
  }

  const Surface& surface_;
  const tree::TriangleTree& tree_;
  double width_;
  std::vector<Index> found_, to_spread_;
  std::vector<std::uint8_t> cracked_;
};

/// Marked triangles that have an edge in common or face each other belong together.
mesh::DisjointSets joinedCracks(const tree::TriangleTree& tree, double width,
                                const std::vector<std::uint8_t>& cracked) {
  mesh::DisjointSets joined(cracked.size());
  for (Index t = 0; t < cracked.size(); ++t) {
    if (cracked[t] == 0) continue;
    for (const Index across : tree.records[t].neighbours) {
      if (across != kNoIndex && cracked[across] != 0) joined.unite(t, across);
    }
    const Index faced = facedFrom(tree, width, t, centreOf(tree.records[t]));
    if (faced != kNoIndex && cracked[faced] != 0) joined.unite(t, faced);
  }
  return joined;
}

/// Drops marks that are not cracks: next to where sheets pierce each other, where a point is a small sphere anyway, and
/// in the pits of creases, which are only a few widths long.
void dropOthers(const SurfaceGeometry& geometry, std::vector<std::uint8_t>& cracked) {
  constexpr double kMinLength = 8.0;  // of the width: 2 mm
  if (cracked.empty()) return;
  mesh::DisjointSets joined = joinedCracks(geometry.tree, crackWidth(geometry), cracked);
  std::vector<std::uint8_t> dropped(cracked.size(), 0);
  std::vector<Eigen::AlignedBox3d> boxes(cracked.size());
  for (Index t = 0; t < cracked.size(); ++t) {
    if (cracked[t] == 0) continue;
    const Index root = joined.root(t);
    for (const Vec3& corner : geometry.tree.records[t].corners) boxes[root].extend(corner);
    if (!geometry.entangled.empty() && geometry.entangled[t] != 0) dropped[root] = 1;
  }
  for (Index t = 0; t < cracked.size(); ++t) {
    if (cracked[t] == 0) continue;
    const Index root = joined.root(t);
    const bool is_pit = boxes[root].diagonal().norm() < kMinLength * crackWidth(geometry);
    if (dropped[root] != 0 || is_pit) cracked[t] = 0;
  }
  if (std::count(cracked.begin(), cracked.end(), 1) == 0) cracked.clear();
}

/// Whether the nearest skin is a crack's wall.
bool liesInCrack(const Surface& surface, const Vec3& tip) {
  const SurfaceGeometry& geometry = *surface.geometry;
  const tree::NearestPoint nearest = nearestPoint(geometry.tree, tip, crackWidth(geometry));
  return nearest.triangle != kNoIndex && isInCrack(geometry, nearest.triangle, nearest.closest.point);
}

}  // namespace

double crackWidth(const SurfaceGeometry& geometry) noexcept {
  return std::min(kCrackMm, kCrackShare * geometry.tree.diagonal);
}

std::vector<std::uint8_t> findCracked(const Surface& surface) {
  std::vector<std::uint8_t> cracked = CrackSearch(surface).find();
  dropOthers(*surface.geometry, cracked);
  return cracked;
}

bool isInCrack(const SurfaceGeometry& geometry, Index triangle, const Vec3& place) noexcept {
  if (geometry.cracked.empty() || geometry.cracked[triangle] == 0) return false;
  const double width = crackWidth(geometry);
  const Vec3 inwards = centreOf(geometry.tree.records[triangle]) - place;
  const double room = inwards.norm();
  const double share = room > 0.0 ? std::min(1.0, kOffTheRim * width / room) : 0.0;
  return facesAnything(geometry.tree, width, triangle, place + share * inwards);
}

Vec3 bankNormal(const Surface& surface, const SurfacePoint& rim) noexcept {
  const SurfaceGeometry& geometry = *surface.geometry;
  Vec3 sum = Vec3::Zero();
  const auto add = [&](Index t) {
    if (t != kNoIndex && !isInCrack(geometry, t, rim.position)) sum += faceNormal(geometry.tree.records[t]);
  };
  const TriangleRecord& record = geometry.tree.records[rim.triangle];
  if (tree::isCorner(rim.feature)) {
    visitFan(surface, rim.triangle, tree::indexOf(rim.feature), [&](Index t, int) { add(t); });
  } else {
    add(rim.triangle);
    if (tree::isEdge(rim.feature)) add(record.neighbours[tree::indexOf(rim.feature)]);
  }
  return sum.isZero(0.0) ? normalAt(surface, rim) : Vec3(sum.stableNormalized());
}

std::optional<SurfacePoint> otherBank(const Surface& surface, const SurfacePoint& rim, const Vec3& tip) noexcept {
  const SurfaceGeometry& geometry = *surface.geometry;
  const double reach = crackWidth(geometry);
  const Vec3 normal = bankNormal(surface, rim);
  std::optional<SurfacePoint> bank;
  double nearest = (tip - rim.position).squaredNorm();
  tree::visitNearTriangles(
      geometry.tree, rim.position, reach * reach, [&](Index t, const tree::ClosestOnTriangle& closest) {
        const double distance = (tip - closest.point).squaredNorm();
        const bool is_bank = distance < nearest && normal.dot(faceNormal(geometry.tree.records[t])) > 0.0 &&
                             !isInCrack(geometry, t, closest.point);
        if (is_bank) {
          nearest = distance;
          bank = SurfacePoint{closest.point, t, closest.feature};
        }
        return reach * reach;
      });
  return bank;
}

std::optional<SurfacePoint> findCrossedRim(const Surface& surface, const Vec3& from, const Vec3& tip,
                                           const tree::Crossing& entry) noexcept {
  const SurfaceGeometry& geometry = *surface.geometry;
  const bool enters = entry.triangle != kNoIndex;
  if (!(enters ? isInCrack(geometry, entry.triangle, entry.point) : liesInCrack(surface, tip))) return {};
  const double reach = (tip - from).norm() + crackWidth(geometry);
  const auto is_bank = [&](Index t, const tree::ClosestOnTriangle& closest) {
    return !isInCrack(geometry, t, closest.point);
  };
  const tree::NearestPoint nearest = nearestPointIf(geometry.tree, from, reach, is_bank);
  if (nearest.triangle == kNoIndex) return {};
  const SurfacePoint rim{nearest.closest.point, nearest.triangle, nearest.closest.feature};
  const bool is_shallow = !enters && (tip - rim.position).norm() <= crackWidth(geometry);
  if (is_shallow || (tip - rim.position).dot(bankNormal(surface, rim)) > releaseSlack(surface)) return {};
  return rim;
}

NarrowCracks countCracks(const SurfaceGeometry& geometry) {
  NarrowCracks cracks;
  const auto& records = geometry.tree.records;
  mesh::DisjointSets joined = joinedCracks(geometry.tree, crackWidth(geometry), geometry.cracked);
  std::vector<double> areas(geometry.cracked.size(), 0.0);
  std::vector<Vec3> moments(geometry.cracked.size(), Vec3::Zero());
  double largest = 0.0;
  for (Index t = 0; t < geometry.cracked.size(); ++t) {
    if (geometry.cracked[t] == 0) continue;
    const Index root = joined.root(t);
    const double area = mesh::areaVector2(records[t].corners[0], records[t].corners[1], records[t].corners[2]).norm();
    areas[root] += area;
    moments[root] += area * centreOf(records[t]);
    cracks.count += root == t ? 1 : 0;
    if (areas[root] < largest) continue;
    largest = areas[root];
    cracks.at = moments[root] / areas[root];
  }
  return cracks;
}

}  // namespace palpate::contact

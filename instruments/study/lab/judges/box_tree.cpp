// Built once a body, O(n log n); a query visits some tens of nodes and triangles, about a microsecond on 20,000.
// Data flow: repaired mesh -> here -> hunt_judge.h. The point of a triangle nearest to a place is
// surface_side.h's.
#include "lab/judges/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lab/judges/surface_side.h"

namespace palpate::lab {
namespace {

constexpr Index kMaxLeafTriangles = 4;
/// Median splits halve: 2^40 triangles are beyond any memory.
constexpr std::size_t kMaxDepth = 48;

/// Six times the volume of a tetrahedron.
double volume6(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return (b - a).cross(c - a).dot(d - a); }

bool segmentMeetsBox(const BoxNode& node, const Vec3& from, const Vec3& to) {
  const Vec3 low = from.cwiseMin(to), high = from.cwiseMax(to);
  return (low.array() <= node.high.array()).all() && (high.array() >= node.low.array()).all();
}

/// +1: from the front to the back, -1: the other way, 0: not at all.
int crossingOf(const std::array<Vec3, 3>& c, const Vec3& from, const Vec3& to, double& share) {
  const double above = volume6(c[0], c[1], c[2], from), below = volume6(c[0], c[1], c[2], to);
  if ((above > 0.0) == (below > 0.0)) return 0;
  const double u = volume6(from, to, c[0], c[1]), v = volume6(from, to, c[1], c[2]), w = volume6(from, to, c[2], c[0]);
  const bool all_up = u >= 0.0 && v >= 0.0 && w >= 0.0, all_down = u <= 0.0 && v <= 0.0 && w <= 0.0;
  if (!all_up && !all_down) return 0;
  share = above / (above - below);
  return above > 0.0 ? 1 : -1;
}

/// Calls visit(slot) for the triangles in the leaves whose boxes, and those above them, are met.
template <class Meets, class Visit>
void visitSlots(const std::vector<BoxNode>& nodes, Meets&& meets, Visit&& visit) {
  std::array<Index, 2 * kMaxDepth> open;
  std::size_t size = 0;
  open[size++] = 0;
  while (size > 0) {
    const Index at = open[--size];
    const BoxNode& node = nodes[at];
    if (!meets(node)) continue;
    if (node.right != 0) {
      open[size++] = node.right;
      open[size++] = at + 1;
      continue;
    }
    for (Index slot = node.first; slot < node.last; ++slot) visit(slot);
  }
}

}  // namespace

BoxTree::BoxTree(const mesh::TriangleMesh& mesh) : order_(mesh.triangles.size()), slots_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), Index{0});
  std::vector<Vec3> centres;
  centres.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) centres.push_back(mesh::centreOf(mesh, t));
  nodes_.reserve(mesh.triangles.size());
  build(0, triangles(), mesh, centres);
  corners_.reserve(order_.size());
  for (Index slot = 0; slot < triangles(); ++slot) {
    const Triangle& t = mesh.triangles[order_[slot]];
    corners_.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
    slots_[order_[slot]] = slot;
  }
}

Index BoxTree::build(Index first, Index last, const mesh::TriangleMesh& mesh, const std::vector<Vec3>& centres) {
  const auto self = static_cast<Index>(nodes_.size());
  Box3 bounds;
  for (Index i = first; i < last; ++i) {
    for (const Index v : mesh.triangles[order_[i]]) bounds.extend(mesh.positions[v]);
  }
  nodes_.push_back({bounds.min(), bounds.max(), first, last, 0});
  if (last - first <= kMaxLeafTriangles) return self;
  Box3 spread;
  for (Index i = first; i < last; ++i) spread.extend(centres[order_[i]]);
  int axis = 0;
  spread.diagonal().maxCoeff(&axis);
  const Index middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](Index a, Index b) { return centres[a][axis] < centres[b][axis]; });
  build(first, middle, mesh, centres);
  const Index right = build(middle, last, mesh, centres);
  nodes_[self].right = right;
  return self;
}

NearPoint BoxTree::nearest(const Vec3& place, double bound) const {
  NearPoint best;
  best.distance = bound;
  double best2 = bound * bound;
  std::array<std::pair<Index, double>, kMaxDepth> open;
  std::size_t size = 0;
  open[size++] = {0, distance2(nodes_[0], place)};
  while (size > 0) {
    auto [at, far2] = open[--size];
    if (far2 >= best2) continue;
    while (nodes_[at].right != 0) {  // down the nearer side, the other one for later
      Index near = at + 1, other = nodes_[at].right;
      double near2 = distance2(nodes_[near], place), other2 = distance2(nodes_[other], place);
      if (other2 < near2) std::swap(near, other), std::swap(near2, other2);
      if (other2 < best2) open[size++] = {other, other2};
      at = near;
      far2 = near2;
      if (far2 >= best2) break;
    }
    if (far2 >= best2 || nodes_[at].right != 0) continue;
    for (Index slot = nodes_[at].first; slot < nodes_[at].last; ++slot) {
      const Vec3 point = nearestOnTriangle(corners_[slot], place);
      const double d2 = (point - place).squaredNorm();
      if (d2 >= best2) continue;
      best2 = d2;
      best.point = point;
      best.triangle = order_[slot];
    }
  }
  if (best.triangle != kNoIndex) best.distance = std::sqrt(best2);
  return best;
}

void BoxTree::collectWithin(const Vec3& place, double reach, std::vector<Index>& triangles) const {
  triangles.clear();
  visitSlots(
      nodes_, [&](const BoxNode& node) { return distance2(node, place) <= reach * reach; },
      [&](Index slot) {
        if ((nearestOnTriangle(corners_[slot], place) - place).norm() <= reach) triangles.push_back(order_[slot]);
      });
}

BoxTree::Crossing BoxTree::crossing(const Vec3& from, const Vec3& to) const {
  Crossing result;
  double first_share = std::numeric_limits<double>::infinity();
  visitSlots(
      nodes_, [&](const BoxNode& node) { return segmentMeetsBox(node, from, to); },
      [&](Index slot) {
        double share = 0.0;
        const int way = crossingOf(corners_[slot], from, to, share);
        result.inwards += way;
        if (way > 0 && share < first_share) first_share = share;
      });
  if (first_share <= 1.0) result.entry = from + first_share * (to - from);
  return result;
}

}  // namespace palpate::lab

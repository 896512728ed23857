// Depth-first descent, nearer child first, boxes beyond the best distance skipped.
//
// Based on: Ericson, "Real-Time Collision Detection" (2005), section 5.1.5 (point and triangle) and 6.2 (median split).
#include "palpate/mesh/nearest.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpate::mesh {
namespace {

constexpr Index kLeafTriangles = 4;
// Median splits halve the count, so depth <= log2(2^32 / 4): a fixed stack is enough.
constexpr std::size_t kStack = 64;

// Branch-free, unlike Eigen's squaredExteriorDistance, which costs half of the search.
double squaredDistance(const Eigen::AlignedBox3d& box, const Vec3& p) {
  return (box.min() - p).cwiseMax(p - box.max()).cwiseMax(0.0).squaredNorm();
}

}  // namespace

Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

NearestTriangle::NearestTriangle(const TriangleMesh& mesh) {
  corners_.reserve(mesh.triangles.size());
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& i = mesh.triangles[t];
    corners_.push_back({mesh.positions[i[0]], mesh.positions[i[1]], mesh.positions[i[2]], t});
  }
  nodes_.reserve(corners_.size());
  if (!corners_.empty()) build(corners_, 0);
}

Index NearestTriangle::build(std::span<Corners> corners, Index offset) {
  const auto node = static_cast<Index>(nodes_.size());
  Eigen::AlignedBox3d box;
  Eigen::AlignedBox3d middles;
  for (const Corners& t : corners) {
    box.extend(t.a).extend(t.b).extend(t.c);
    middles.extend(t.a + t.b + t.c);
  }
  nodes_.push_back({box, offset, static_cast<Index>(corners.size())});
  if (corners.size() <= kLeafTriangles) return node;
  Eigen::Index axis = 0;
  middles.sizes().maxCoeff(&axis);
  const auto key = [axis](const Corners& t) { return t.a[axis] + t.b[axis] + t.c[axis]; };
  const std::size_t half = corners.size() / 2;
  std::nth_element(
      corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(half), corners.end(),
      [&](const Corners& p, const Corners& q) { return key(p) != key(q) ? key(p) < key(q) : p.triangle < q.triangle; });
  build(corners.first(half), offset);
  nodes_[node].first = build(corners.subspan(half), offset + static_cast<Index>(half));
  nodes_[node].count = 0;
  return node;
}

void NearestTriangle::scanLeaf(const Node& leaf, const Vec3& p, Hit& best) const {
  for (Index i = leaf.first; i < leaf.first + leaf.count; ++i) {
    const Corners& t = corners_[i];
    const Vec3 point = nearestOnTriangle(p, t.a, t.b, t.c);
    const double distance = (point - p).norm();
    if (distance < best.distance) best = {t.triangle, point, distance};
  }
}

NearestTriangle::Hit NearestTriangle::find(const Vec3& p, double reach) const {
  struct Pending {
    Index node;
    double distance2;
  };
  Hit best;
  best.distance = reach;
  std::array<Pending, kStack> stack;
  std::size_t size = 0;
  if (!nodes_.empty()) stack[size++] = {0, 0.0};
  while (size > 0) {
    const Pending pending = stack[--size];
    if (pending.distance2 >= best.distance * best.distance) continue;
    const Node& node = nodes_[pending.node];
    if (node.count > 0) {
      scanLeaf(node, p, best);
      continue;
    }
    Pending nearer{pending.node + 1, squaredDistance(nodes_[pending.node + 1].box, p)};
    Pending farther{node.first, squaredDistance(nodes_[node.first].box, p)};
    if (farther.distance2 < nearer.distance2) std::swap(nearer, farther);
    stack[size++] = farther;
    stack[size++] = nearer;
  }
  return best;
}

}  // namespace palpate::mesh

// Based on: Moeller and Trumbore, "Fast, minimum storage ray-triangle intersection", 1997; Ji, dissertation 2008, 2.2
// and 2.4 for the force.
#include "lab/measured/literal_process.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "palpate/tree/closest_on_triangle.h"

namespace palpate::study {

using bench::literal::Mesh;

namespace {

// The dissertation names no stiffness; any would do for the time that it takes.
constexpr double kStiffness = 0.5;  // N/mm
constexpr double kFriction = 0.44;

std::array<Vec3, 3> cornersOf(const Mesh& mesh, Index triangle) {
  const int* corners = mesh.triangles[triangle].corners;
  const auto at = [&](int i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(corners[i])].position; };
  return {at(0), at(1), at(2)};
}

// The fraction of the way at which it passes the front of the triangle, or something above 1.
double crossingFraction(const std::array<Vec3, 3>& corners, const Vec3& from, const Vec3& way) {
  constexpr double kMissed = 2.0;
  const Vec3 ab = corners[1] - corners[0];
  const Vec3 ac = corners[2] - corners[0];
  const Vec3 across = way.cross(ac);
  const double determinant = ab.dot(across);
  if (determinant <= 0.0) return kMissed;
  const Vec3 start = from - corners[0];
  const double u = start.dot(across);
  if (u < 0.0 || u > determinant) return kMissed;
  const Vec3 turned = start.cross(ab);
  const double v = way.dot(turned);
  if (v < 0.0 || u + v > determinant) return kMissed;
  const double fraction = ac.dot(turned) / determinant;
  return fraction >= 0.0 ? fraction : kMissed;
}

Vec3 nearestPoint(const Mesh& mesh, const RenderedLeaves& leaves, const Vec3& tip) {
  double nearest = std::numeric_limits<double>::infinity();
  Vec3 point = tip;
  for (const auto& leaf : leaves) {
    for (const Index t : leaf) {
      const auto closest = tree::closestOnTriangle(cornersOf(mesh, t), tip);
      if (closest.squared_distance >= nearest) continue;
      nearest = closest.squared_distance;
      point = closest.point;
    }
  }
  return point;
}

}  // namespace

RenderedLeaves wholeModel(const std::vector<Index>& all_triangles) { return {std::span(all_triangles)}; }

RenderedLeaves collectHitLeaves(const hdb::Partition& partition, const hdb::LeafHits& hits) {
  RenderedLeaves leaves;
  for (const Index leaf : hits.leaves) leaves.push_back(hdb::trianglesOf(partition, partition.nodes[leaf]));
  return leaves;
}

std::size_t countTriangles(const RenderedLeaves& leaves) {
  std::size_t count = 0;
  for (const auto& leaf : leaves) count += leaf.size();
  return count;
}

LiteralHit collide(const Mesh& mesh, const RenderedLeaves& leaves, const Vec3& from, const Vec3& to) {
  LiteralHit first;
  const Vec3 way = to - from;
  for (const auto& leaf : leaves) {
    for (const Index t : leaf) {
      const double fraction = crossingFraction(cornersOf(mesh, t), from, way);
      if (fraction > first.fraction) continue;
      first = {from + fraction * way, fraction, t};
    }
  }
  return first;
}

Vec3 touchForce(const Mesh& mesh, const RenderedLeaves& leaves, const Vec3& tip, const Vec3& anchor) {
  const Vec3 proxy = nearestPoint(mesh, leaves, tip);
  const Vec3 normal_force = kStiffness * (proxy - tip);
  const Vec3 drag = kStiffness * (anchor - proxy);
  const double most = kFriction * normal_force.norm();
  return normal_force + std::min(1.0, most / std::max(drag.norm(), 1e-300)) * drag;
}

}  // namespace palpate::study

// The textbook's tests of one triangle, for float and double: for a peer that only finds boxes, and for its oracle.
// Based on: Akenine-Moeller, "Fast 3D triangle-box overlap testing" (2001); Ericson, "Real-Time Collision Detection"
// (2005), 5.1.5.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace palpate::bench {

/// Whether a triangle itself, not only its box, meets a box around the origin: by its box, by its corners, and for what
/// is left by separating axes. Corners relative to the box's centre. Closed: touching counts.
template <class Real>
bool triangleMeetsBox(const std::array<Eigen::Matrix<Real, 3, 1>, 3>& corners, const Eigen::Matrix<Real, 3, 1>& half) {
  using Vector = Eigen::Matrix<Real, 3, 1>;
  const Vector low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
  const Vector high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
  if ((low.array() > half.array()).any() || (high.array() < -half.array()).any()) return false;
  for (const Vector& corner : corners) {  // most triangles that get here
    if ((corner.cwiseAbs().array() <= half.array()).all()) return true;
  }
  const auto apart = [&](const Vector& axis) {
    const Real a = axis.dot(corners[0]), b = axis.dot(corners[1]), c = axis.dot(corners[2]);
    const Real reach = axis.cwiseAbs().dot(half);
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
  };
  const std::array<Vector, 3> edges = {corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
  if (apart(edges[0].cross(edges[1]))) return false;
  for (const Vector& edge : edges) {
    for (int i = 0; i < 3; ++i) {
      if (apart(Vector::Unit(i).cross(edge))) return false;
    }
  }
  return true;
}

/// Squared distance of a point to a triangle; plain, without care for slivers.
template <class Real>
Real squaredDistance(const Eigen::Matrix<Real, 3, 1>& p, const Eigen::Matrix<Real, 3, 1>& a,
                     const Eigen::Matrix<Real, 3, 1>& b, const Eigen::Matrix<Real, 3, 1>& c) {
  using Vector = Eigen::Matrix<Real, 3, 1>;
  const Vector ab = b - a, ac = c - a, ap = p - a;
  const Real d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return ap.squaredNorm();
  const Vector bp = p - b;
  const Real d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return bp.squaredNorm();
  const Real vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - d1 / (d1 - d3) * ab).squaredNorm();
  const Vector cp = p - c;
  const Real d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return cp.squaredNorm();
  const Real vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - d2 / (d2 - d6) * ac).squaredNorm();
  const Real va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).squaredNorm();
  }
  const Real scale = 1 / (va + vb + vc);
  return (ap - vb * scale * ab - vc * scale * ac).squaredNorm();
}

}  // namespace palpate::bench

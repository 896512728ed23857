// Whether a triangle itself, not only its box, meets a box around the origin, for float and double: by its box, by its
// corners, and for what is left by separating axes.
// Based on: Akenine-Moeller, "Fast 3D triangle-box overlap testing" (2001).
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace palpate::bench {

/// Corners relative to the box's centre. Closed: touching counts.
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

}  // namespace palpate::bench

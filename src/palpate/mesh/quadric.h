// The sum of squared, area-weighted distances to a set of planes, as a symmetric 4x4 matrix.
//
// Based on: Garland and Heckbert, "Surface simplification using quadric error metrics" (1997).
#pragma once

#include <Eigen/LU>

#include "palpate/base/vec.h"

namespace palpate::mesh {

/// E(x) = x^T M x + 2 b^T x + c, mm^2 times the weight of the planes (mm^2).
struct Quadric {
  Mat3 m = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  double c = 0.0;

  static Quadric ofPlane(const Vec3& unit_normal, const Vec3& point, double weight) {
    const double offset = -unit_normal.dot(point);
    return {weight * unit_normal * unit_normal.transpose(), weight * offset * unit_normal, weight * offset * offset};
  }
  Quadric& operator+=(const Quadric& q) {
    m += q.m;
    b += q.b;
    c += q.c;
    return *this;
  }
  double at(const Vec3& x) const { return x.dot(m * x) + 2.0 * b.dot(x) + c; }

  /// The point of least error, held near `guess` by `stiffness` (a share of the mean eigenvalue): flat and straight
  /// regions leave directions free that would otherwise send the point anywhere.
  Vec3 best(const Vec3& guess, double stiffness) const {
    const double hold = stiffness * m.trace() / 3.0 + 1e-30;
    const Mat3 held = m + hold * Mat3::Identity();
    return held.inverse() * (hold * guess - b);
  }

  /// The same planes mirrored at x = 0.
  Quadric mirroredAtX0() const {
    Quadric q = *this;
    for (const int other : {1, 2}) {
      q.m(0, other) = -q.m(0, other);
      q.m(other, 0) = -q.m(other, 0);
    }
    q.b.x() = -q.b.x();
    return q;
  }
};

}  // namespace palpate::mesh

// How often a closed mesh winds around a point: 1 inside, 0 outside, by summing solid angles of all triangles.
//
// Based on: van Oosterom and Strackee, "The solid angle of a plane triangle" (1983). Slow and certain: a judge.
#pragma once

#include <cmath>
#include <numbers>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::support {

inline double windingNumber(const mesh::TriangleMesh& mesh, const Vec3& p) {
  double angle = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]] - p;
    const Vec3 b = mesh.positions[t[1]] - p;
    const Vec3 c = mesh.positions[t[2]] - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4.0 * std::numbers::pi);
}

}  // namespace palpate::support
